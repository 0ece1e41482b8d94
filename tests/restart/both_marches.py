#!/usr/bin/env python3
"""both_marches.py PROGRAM MPIRUN PARAMETER_FILES: a transient and a modal convolution in one file.

Each has the numbers of a file of its own; stopped in either march and resumed, the run has those of the whole one.
"""
import json, signal, subprocess, sys, time

from scene import Check, entries, program, section, table

step, end = 1e-5, 0.5
scene = "\n".join([
    "set Bodies = bar, stop",
    section("bar", "set Type = bar", section("Material", entries(Young_modulus=2e9, Density=2000)),
            section("Bar", entries(Length=1, Section=1e-3, Divisions=10)),
            section("Modes", entries(Count=6, Stiffness_damping=0))),
    section("stop", "set Type = rigid"),
    section("Output", entries(Figures="false", Cache_directory="cache"))])
march = entries(Time_step=step, End_time=end, Checkpoint_interval=1e-9, Error_estimate="false")
own = {"transient": section("Contact", entries(Friction_coefficient=0)) + "\n" + section("Rolling", entries(Speed=0, Hub_displacement=1e-4)) + "\n" + section("Transient", march),
       "modal convolution": section("Road", entries(Indentation=1e-4)) + "\n" + section("Modal convolution", march)}


def start(name, analyses, *options):
    with open(name + ".prm", "w") as file:
        file.write("\n".join([f"set Analyses = {analyses}", scene, *(own[one] for one in analyses.split(", "))]))
    return subprocess.Popen([program, name + ".prm", "--output", name, *options], stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)


def finish(process, expected=0):
    text = process.communicate()[0]
    if process.returncode != expected:
        sys.exit(f"FAILED: exit code {process.returncode} instead of {expected}\n{text}")


def numbers(folder, analysis):
    found = json.load(open(folder + "/results.json"))["analyses"][analysis]
    impulse = found["impulse_Ns"]
    return [found["steps"], impulse[0] if isinstance(impulse, list) else impulse]


begin = time.time()
finish(start("whole", "transient, modal convolution"))
duration = time.time() - begin
check = Check()
for analysis in ("transient", "modal convolution"):
    key = analysis.replace(" ", "_")
    finish(start(key, analysis))
    for what, one, other in zip(("steps", "impulse"), numbers(key, key), numbers("whole", key)):
        check.near(f"{analysis}, {what}", other, one, 1e-15)
names = [json.load(open("whole/results.json"))["analyses"][key]["histories"] for key in ("transient", "modal_convolution")]
check.near("files of histories", len(set(names)), 2, 1e-9)
check.near("rows of the table of the contact point", len(table("whole", "contact_point_0.csv")), end / step, 1e-9)
for share in (0.3, 0.8):
    folder = f"stopped_{share}"
    process = start(folder, "transient, modal convolution", "--quiet")
    time.sleep(duration * share)
    process.send_signal(signal.SIGTERM)
    process.communicate()
    if process.returncode == 0:
        continue  # already at its end
    finish(start(folder, "transient, modal convolution", "--resume"))
    for key in ("transient", "modal_convolution"):
        for what, one, other in zip(("steps", "impulse"), numbers("whole", key), numbers(folder, key)):
            check.near(f"{key} resumed after {share}, {what}", other, one, 1e-15)
check.end()

#!/usr/bin/env python3
"""both_marches.py PROGRAM MPIRUN PARAMETER_FILES: a transient and a modal convolution in one file.

Each has the numbers of a file of its own; stopped in either march and resumed, the run has those of the whole one.
"""
import json, os, signal, subprocess, sys, time

from scene import Check, entries, program, section, table

step, end = 1e-5, {"transient": 0.5, "modal convolution": 4}
scene = "\n".join([
    "set Bodies = bar, stop",
    section("bar", "set Type = bar", section("Material", entries(Young_modulus=2e9, Density=2000)),
            section("Bar", entries(Length=1, Section=1e-3, Divisions=10)),
            section("Modes", entries(Count=6, Stiffness_damping=0))),
    section("stop", "set Type = rigid"),
    section("Output", entries(Figures="false", Cache_directory="cache"))])
march = {one: entries(Time_step=step, End_time=end[one], Checkpoint_interval=1e-9, Error_estimate="false") for one in end}
own = {"transient": section("Contact", entries(Friction_coefficient=0)) + "\n" + section("Rolling", entries(Speed=0, Hub_displacement=1e-4)) + "\n" + section("Transient", march["transient"]),
       "modal convolution": section("Road", entries(Indentation=1e-4)) + "\n" + section("Modal convolution", march["modal convolution"])}


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


finish(start("whole", "transient, modal convolution"))
check = Check()
for analysis in ("transient", "modal convolution"):
    key = analysis.replace(" ", "_")
    finish(start(key, analysis))
    for what, one, other in zip(("steps", "impulse"), numbers(key, key), numbers("whole", key)):
        check.near(f"{analysis}, {what}", other, one, 1e-15)
names = [json.load(open("whole/results.json"))["analyses"][key]["histories"] for key in ("transient", "modal_convolution")]
check.near("files of histories", len(set(names)), 2, 1e-9)
check.near("rows of the table of the contact point", len(table("whole", "contact_point_0.csv")), end["modal convolution"] / step, 1e-9)
for stopped, checkpoint in (("transient", "checkpoint.h5"), ("modal convolution", "modal_convolution.h5")):
    folder = f"stopped_in_{stopped.replace(' ', '_')}"
    process = start(folder, "transient, modal convolution", "--quiet")
    while process.poll() is None and not os.path.exists(f"{folder}/{checkpoint}"):
        time.sleep(1e-3)
    process.send_signal(signal.SIGTERM)
    finish(process, 128 + signal.SIGTERM)
    finish(start(folder, "transient, modal convolution", "--resume"))
    for key in ("transient", "modal_convolution"):
        for what, one, other in zip(("steps", "impulse"), numbers("whole", key), numbers(folder, key)):
            check.near(f"{key} resumed after a stop in the {stopped}, {what}", other, one, 1e-15)
check.end()

#!/usr/bin/env python3
"""several_analyses.py PROGRAM MPIRUN PARAMETER_FILES: what becomes of the other analyses of a file where one does not converge.

They run all the same, results.json says of which each sentence is, and a resumed run says of an analysis that it computes again only
what is true then.
"""
import json, subprocess, sys

from scene import Check, entries, program, section

check = Check()


def scene(analyses, *sections):
    return "\n".join([
        "set Bodies = pad, plane", f"set Analyses = {analyses}",
        section("pad", "set Type = block", section("Material", entries(Young_modulus=70e9, Poisson_ratio=0.33, Density=2700)),
                section("Block", entries(Length=0.03, Width=0.02, Height=0.04, Divisions_x=6, Divisions_y=4, Divisions_z=6, Held="top",
                                         Contact_face="bottom")),
                section("Modes", entries(Count=6))),
        section("plane", "set Type = rigid"),
        section("Contact", entries(Friction_coefficient=0.7, Grid_spacing=5e-3, Half_length=15e-3, Half_width=10e-3)),
        section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Hub_displacement=2e-6)),
        section("Output", entries(Cache_directory="cache", Figures="false")), *sections])


def march(end):
    return section("Transient", entries(Time_step=1e-7, End_time=end, Perturbed_mode="pad:mode 2", Perturbation_velocity=0.1, Error_estimate="false"),
                   section("Signals", entries(Probes="side: pad 0.015 0 0.005 along x")))


def run(name, text, code, *options):
    """@return results.json, and what it says of analyses that did not converge, by analysis"""
    with open(name + ".prm", "w") as file:
        file.write(text)
    done = subprocess.run([program, name + ".prm", "--output", name, "--quiet", *options], capture_output=True, text=True)
    if done.returncode != code:
        sys.exit(f"FAILED: {name}: exit code {done.returncode} instead of {code}\n{done.stdout}{done.stderr}")
    results = json.load(open(name + "/results.json"))
    said = {}
    for one in results.get("not_converged", []):
        said.setdefault(one["analysis"], []).append(one["message"])
    return results, said


def check_said(what, said, analysis, text):
    check.near(f"{what}: analyses that failed", len(said), 1, 1e-12)
    check.near(f"{what}: sentences of {analysis}", len(said.get(analysis, [])), 1, 1e-12)
    check.near(f"{what}: {said}", any(text in one for one in said.get(analysis, [])), True, 1e-12)


# no root is low enough: by its only case, and by all cases of a sweep
LOW = {"one": section("Stability", entries(Upper_frequency=1e-3)),
       "swept": section("Stability", entries(Upper_frequency=1e-3),
                        section("Sweep", entries(Entry="Contact/Friction coefficient", Values="0.4, 0.7")))}
for name, low in LOW.items():
    found, said = run(name, scene("stability, transient", low, march(1e-4)), 2)
    check_said(name, said, "stability", "Stability/Upper frequency")
    check.near(name + ": steps of the transient", found["analyses"]["transient"]["steps"], 1000, 1e-12)
    check.near(name + ": complete", found["complete"], True, 1e-12)
    check.near(name + ": the transient came to its end", "transient" in found["finished"], True, 1e-12)
    # the transient goes on, what was said of stability stays or is said again
    found, said = run(name, scene("stability, transient", low, march(2e-4)), 2, "--resume")
    check_said(name + " resumed", said, "stability", "Stability/Upper frequency")
    check.near(name + ": further steps", found["analyses"]["transient"]["steps"], 2000, 1e-12)

# a march that is too short leads to no cycle; a longer one does, and nothing is left of the failure
CYCLE = section("Limit cycle", entries(Time_step=1e-7, Start="end of transient", Max_Newton_iterations=4, Error_estimate="false", Multipliers=0))
found, said = run("short", scene("transient, limit cycle", CYCLE, march(2e-5)), 2)
check_said("too short", said, "limit cycle", "No limit cycle was found")
found, said = run("short", scene("transient, limit cycle", CYCLE, march(4e-3)), 0, "--resume")
check.near("failures of the longer march", len(said), 0, 1e-12, 1)
check.near("cycles of the longer march", found["analyses"]["limit_cycle_search"]["cycles_found"], 1, 1e-12)
check.end()

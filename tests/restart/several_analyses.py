#!/usr/bin/env python3
"""several_analyses.py PROGRAM MPIRUN PARAMETER_FILES: what becomes of the other analyses of a file where one does not converge.

They run all the same, results.json says of which analysis each sentence is, and a resumed run says of an analysis that it computes
again only what is true then.
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


# no root is low enough
LOW = section("Stability", entries(Upper_frequency=1e-3))
found, said = run("low", scene("stability, transient", LOW, march(1e-4)), 2)
check_said("low", said, "stability", "Stability/Upper frequency")
check.near("steps of the transient", found["analyses"]["transient"]["steps"], 1000, 1e-12)
check.near("complete", found["complete"], True, 1e-12)
check.near("the transient came to its end", "transient" in found["finished"], True, 1e-12)
# the transient goes on, what was said of stability stays
found, said = run("low", scene("stability, transient", LOW, march(2e-4)), 2, "--resume")
check_said("resumed", said, "stability", "Stability/Upper frequency")
check.near("further steps", found["analyses"]["transient"]["steps"], 2000, 1e-12)

# a transient that has no beginning: what begins at its end is not run
SOLVER = section("Contact", section("Solver", entries(Max_Newton_iterations=1)))
CYCLE = section("Limit cycle", entries(Time_step=1e-7, Start="end of transient"))
found, said = run("nothing", scene("modes, transient, limit cycle", SOLVER, CYCLE, march(1e-4)), 2)
check.near("modes", len(found["analyses"]["modes"]["pad"]["frequencies_Hz"]), 6, 1e-12)
check.near(f"of the transient: {said}", "did not converge" in said["transient"][0], True, 1e-12)
check.near(f"of the cycle: {said}", said["limit cycle"][0].startswith("It begins at the end of the transient"), True, 1e-12)

# a cycle that begins at the end of a transient is found again when that goes on, and what is said of it is said once
found, said = run("longer", scene("transient, limit cycle", CYCLE, march(2e-5)), 0)
warnings = found.get("warnings", [])
found, said = run("longer", scene("transient, limit cycle", CYCLE, march(4e-3)), 0, "--resume")
check.near("failures", len(said), 0, 1e-12, 1)
check.near("cycles", found["analyses"]["limit_cycle_search"]["cycles_found"], 1, 1e-12)
check.near("end of the transient", found["analyses"]["limit_cycle_search"]["from_transient"]["end_s"], 4e-3, 1e-9)
check.near(f"warnings: {found.get('warnings')}", len(found.get("warnings", [])) <= max(1, len(warnings)), True, 1e-12)
check.end()

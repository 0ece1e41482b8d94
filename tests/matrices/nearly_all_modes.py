#!/usr/bin/env python3
"""nearly_all_modes.py PROGRAM MPIRUN PARAMETER_FILES: a small body that keeps all of its modes has no residual flexibility but rounding.

Stability then says so with exit code 2, with losses and without. With two or four modes less the root that grows is there, and moves by less than 1e-5.
"""
import json
import os
import subprocess
import sys
import tempfile

program, _, parameter_files = sys.argv[1:4]


def run(count, folder, *more):
    return subprocess.run(
        [program, os.path.join(parameter_files, "examples", "matrices.prm"), "--set", "Analyses=stability",
         "--set", f"block/Modes/Count={count}", "--set", "Output/Figures=false", "--output", folder, *more],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


with tempfile.TemporaryDirectory() as scratch:
    found = []
    for count in (32, 34):
        folder = os.path.join(scratch, str(count))
        end = run(count, folder)
        if end.returncode != 0:
            sys.exit(f"{count} modes end with {end.returncode}:\n{end.stdout}")
        with open(os.path.join(folder, "results.json"), encoding="utf-8") as results:
            roots = json.load(results)["analyses"]["stability"]["cases"][0]["unstable"]
        found.append(min(root["frequency_Hz"] for root in roots))
    print("32 and 34 modes:", found, "Hz")
    if abs(found[0] / found[1] - 1) > 1e-5:
        sys.exit("The root that grows depends on the last modes.")
    # a loss factor of 1 makes the flexibilities complex
    losses = ("--set", "block/Matrices/Structural damping=data/calculix/block_c3d8.sti", "--set", "Stability/Loss=hysteretic")
    for more in ((), losses):
        end = run(36, os.path.join(scratch, "all"), *more)
        if end.returncode != 2 or "leave no tangential flexibility" not in end.stdout:
            sys.exit(f"All modes end with {end.returncode}:\n{end.stdout}")

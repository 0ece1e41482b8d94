#!/usr/bin/env python3
"""lap_joint.py PROGRAM MPIRUN PARAMETER_FILES: a lap joint rings down as Masing's rule makes of its quasi-static loading.

Decrements of the march at two steps, whose error is of first order in the step, extrapolated: 2 %; periods: 1e-4.
"""
import os
import subprocess
import sys
from scene import Check

program, _, parameter_files = sys.argv[1:4]
sys.path.insert(0, os.path.join(parameter_files, "verification", "lap_joint"))
from masing import compared  # noqa: E402

check = Check()
cycles = []
for step in ("1e-6", "5e-7"):
    done = subprocess.run([program, os.path.join(parameter_files, "examples", "lap_joint.prm"), "--quiet", "--output", step,
                           "--set", "Transient/Time step=" + step, "--set", "Transient/End time=0.022",
                           "--set", "Transient/Signals/Table=true", "--set", "Output/Figures=false",
                           "--set", "Output/Cache directory=cache"], check=False)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}")
    cycles.append(compared(step, 1e4))
check.near("cycles", len(cycles[1]), 3, 1e-9)
for coarse, fine in zip(*cycles):
    errors = [row["decrement"] / row["decrement_masing"] - 1 for row in (coarse, fine)]
    check.near("extrapolated decrement", 1 + 2 * errors[1] - errors[0], 1, 0.02)
    check.near("period", fine["period_s"], fine["period_masing_s"], 1e-4)
    # each step adds to the damping, twice the step twice as much
    check.near("error by the step", errors[0] / errors[1], 2, 0.2)
check.end()

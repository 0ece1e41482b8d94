#!/usr/bin/env python3
"""lap_joint.py PROGRAM MPIRUN PARAMETER_FILES: a lap joint rings down as Masing's rule makes of its quasi-static loading.

Of every cycle, in time and without: energy that friction takes (of two steps, whose error is of first order in the step, extrapolated), period, and where the rule alone
would be by then. 18 of 31 points slip in the end, and others in the beginning.
"""
import os
import subprocess
import sys
from h5py_of_system import h5py  # noqa: F401
from scene import Check

program, _, parameter_files = sys.argv[1:4]
sys.path.insert(0, os.path.join(parameter_files, "verification", "lap_joint"))
from masing import alone, branch_errors, compared, cycles, error, loops, to_and_fro, vc  # noqa: E402

check = Check()


def run(folder, *settings):
    settings = ("Loading/Steps=2, 100", "Output/Figures=false", "Output/Cache directory=cache", *settings)
    done = subprocess.run([program, os.path.join(parameter_files, "examples", "lap_joint.prm"), "--quiet", "--output", folder]
                          + [word for one in settings for word in ("--set", one)], check=False)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}")


found = []
for step in ("4e-6", "2e-6"):
    run(step, "Transient/Time step=" + step, "Transient/End time=0.0162")
    found.append(cycles(compared(step)))
check.near("cycles", len(found[1]), 3, 1e-9)
for coarse, fine in zip(*found):
    both = [error(one, "loss_J") for one in (coarse, fine)]
    check.near("energy taken, extrapolated", 1 + 2 * both[1] - both[0], 1, 5e-3)
    # each step adds to the damping, twice the step twice as much
    check.near("error by the step", both[0] / both[1], 2, 0.3)
    check.near("period", fine["time_s"], fine["time_masing_s"], 1e-4)
    ahead = [error(one, "amplitude_m") for one in (coarse, fine)]
    check.near("amplitude by the rule alone, extrapolated", 1 + 2 * ahead[1] - ahead[0], 1, 1e-3)
# a joint without memory would be elsewhere by the third cycle
forgetful = abs(alone(vc.Results("2e-6"), 6, remembers=False)[1])
check.near("amplitude by a rule that forgets", (forgetful[4] + forgetful[5]) / 2 / found[1][2]["amplitude_masing_m"], 0.995, 2e-3)
# the same to and fro without time
run("loops", *to_and_fro(vc.Results("2e-6"), 7), "Transient/End time=2e-5")
still = cycles(loops("loops"))
check.near("quasi-static cycles", len(still), 3, 1e-9)
for row in still:
    check.near("energy taken quasi-statically", row["loss_J"], row["loss_masing_J"], 2e-3)
# between two opposite forces step by step
run("whole", "Loading/Force x=0, 1700, -1700, 1700", "Loading/Steps=2, 100, 100, 100", "Transient/End time=2e-5")
for worst in branch_errors("whole"):
    check.near("displacement of a branch", 1 + worst, 1, 1e-8)
# slip spreads from small amplitudes on: the rule is tried where it says much
slip = [step["slip_points"] for step in vc.Results("2e-6").analyses.quasi_static_loading.steps if step["part"] > 1]
check.near("points that slip in the end", slip[-1], 18, 0.01)
check.near("points that slip at a third of the pull", slip[len(slip) // 3], 4, 0.51)
check.near("the last cycle loses less", found[1][-1]["loss_J"] / found[1][0]["loss_J"], 0.27, 0.05)
check.end()

"""A march in time is watched, stopped on its way and resumed: its history is that of the one that nobody stopped.

usage: stop_and_resume.py [FOLDER]
"""
import sys
from pathlib import Path

import numpy as np
import vibrocontact as vc

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/stop_and_resume")
case = vc.Case.from_file(vc.EXAMPLES / "rolling_transient.prm", {"Transient/Time step": 8e-7, "Output/Figures": False})

run = case.start(folder / "stopped")
for line in run.progress():
    if line.percent is not None:  # said every second
        print(f"{line.percent:.0f} % of the march are done, {line.left_s} s are left")
        break
so_far = run.stop()
print("stopped:", so_far)

# resume=True is also the way on after a kill or a power cut
resumed = case.run(folder / "stopped", resume=True)
whole = case.run(folder / "whole")
one, other = (results.histories()["tangential_force_y_N"] for results in (resumed, whole))
print(f"lateral force at the end, resumed and in one go: {one[-1]:.9f} and {other[-1]:.9f} {one.unit}")
assert resumed.converged and len(one) == len(other) > 1000
assert np.abs(one - other).max() <= 1e-9 * np.abs(other).max()

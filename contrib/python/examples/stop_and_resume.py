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
forces = [one.histories()["tangential_force_y_N"] for one in (resumed, whole)]
print("lateral force at the end, resumed and in one go: {:.9f} and {:.9f} N".format(*(force[-1] for force in forces)))
assert resumed.converged and len(forces[0]) == len(forces[1]) > 1000
assert np.allclose(*forces, rtol=1e-9, atol=1e-9 * abs(forces[1]).max())

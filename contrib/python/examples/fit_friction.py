"""Friction and crown radius of a rail from four measured lateral forces: least squares by Gauss and Newton.

usage: fit_friction.py [FOLDER]
"""
import sys

import numpy as np
import vibrocontact as vc
from numpy.typing import NDArray

folder = sys.argv[1] if len(sys.argv) > 1 else "results/fit_friction"
case = vc.Case.from_file(vc.EXAMPLES / "half_space_rolling.prm", {"Contact/Grid spacing": 2e-3, "Rolling/Sweep/Lateral creepage": [3e-4, 6e-4, 2e-3, 2e-2]})


def forces(results: vc.Results) -> NDArray[np.float64]:
    """Lateral force at each creepage [N]."""
    return np.array([one.tangential_force_N[1] for one in results.analyses.quasi_static_rolling.cases])


model = vc.Objective(case, ["Contact/Friction coefficient", "rail/Half-space/Radius y"], forces, folder)
# stands for a measurement, good to 10 N
true = np.array([0.35, 0.25])
measured = np.round(model(true), -1)

found = np.array([0.3, 0.4])
for _ in range(6):
    at = model(found)
    # each unknown changed by 1 %
    slopes = np.array([(model(found * (1 + 0.01 * np.eye(2)[k])) - at) / 0.01 for k in range(2)]).T
    change = np.linalg.lstsq(slopes, measured - at, rcond=None)[0]
    found = found * (1 + change)
    print(f"friction {found[0]:.4f}, radius {found[1]:.4f} m, largest difference {np.abs(at - measured).max():7.1f} N")
    if np.abs(change).max() < 1e-3:
        break
assert np.abs(found / true - 1).max() < 0.02, "the unknowns are not found again"

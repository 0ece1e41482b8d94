"""Creep curves: two half-spaces roll on each other, over lateral creepage at three coefficients of friction.

usage: creep_curve.py [FOLDER]
"""
import sys

import numpy as np
import vibrocontact as vc

folder = sys.argv[1] if len(sys.argv) > 1 else "results/creep_curve"
case = vc.Case.from_file(vc.EXAMPLES / "half_space_rolling.prm", {"Contact/Grid spacing": 2e-3})
frictions, creepages = [0.1, 0.3, 0.6], [5e-4, 1e-3, 2e-3, 2e-2]
study = vc.sweep(case, {"Contact/Friction coefficient": frictions, "Rolling/Lateral creepage": creepages}, folder, check=False)

# |Ft| / (mu N): a row for each friction
utilisation = study.collect(lambda results: results.analyses.quasi_static_rolling.cases[0].utilisation)
print("creepage       " + "".join(f"{one:>10g}" for one in creepages))
for friction, row in zip(frictions, utilisation):
    print(f"friction {friction:4.1f}  " + "".join(f"{one:10.4f}" for one in row))

# more friction, less of it is used; at 2 % and friction 0.1 all points slide
assert not study.failed and np.all(np.diff(utilisation, axis=1) > 0) and np.all(np.diff(utilisation, axis=0) < 0)
assert abs(utilisation[0, -1] - 1) < 1e-3

patch = study[-1].results.table("contact_patch_0.csv")
pressure = patch["pressure_Pa"]
print(f"{study[-1].folder}: {np.count_nonzero(pressure)} points in contact, largest pressure {pressure.max() / 1e6:.0f} M{pressure.unit}")

"""A case of one's own from a dict: a bar thrown against a stop, its force in time from HDF5 against d'Alembert's solution.

usage: own_bar.py [FOLDER]
"""
import sys

import numpy as np
import vibrocontact as vc

folder = sys.argv[1] if len(sys.argv) > 1 else "results/own_bar"
E, rho, section, length, speed, gap = 900.0, 1.0, 1.0, 10.0, 10.0, 5.0
case = vc.Case({
    "Title": "Bar against a stop",
    "Bodies": ["bar", "stop"],
    "Analyses": "transient",
    "bar": {"Type": "bar", "Material": {"Young modulus": E, "Density": rho},
            "Bar": {"Length": length, "Section": section, "Divisions": 40, "Element degree": 4, "Far end": "free"},
            "Modes": {"Count": 20}},
    "stop": {"Type": "rigid"},
    "Contact/Friction coefficient": 0,
    "Rolling/Speed": 0,
    "Transient": {"Time step": 1e-3, "End time": 1.5, "Initial state": "undeformed", "Initial gap": gap, "Initial velocity": -speed},
    "Output": {"Figures": False, "Cache directory": folder + "/cache"},
})
print(case.check().strip().splitlines()[-1].strip())
results = case.run(folder)
histories = results.histories()
time, force = histories["time_s"], histories["normal_force_N"]

# the wave runs to the free end and back at c: rho c A v is what presses meanwhile
c = np.sqrt(E / rho)
begin, end = gap / speed, gap / speed + 2 * length / c
inside = (time > begin + 0.1 * (end - begin)) & (time < end - 0.1 * (end - begin))
mean, impulse = force[inside].mean(), results.analyses.transient.impulse_Ns
print(f"force {mean:.1f} {force.unit} (closed form {rho * c * section * speed:.1f}), impulse {impulse:.2f} N s (closed form {2 * rho * section * length * speed:.2f})")
assert abs(mean / (rho * c * section * speed) - 1) < 0.02 and abs(impulse / (2 * rho * section * length * speed) - 1) < 0.02

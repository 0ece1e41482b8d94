#!/usr/bin/env python3
"""oscillators.py PROGRAM MPIRUN PARAMETER_FILES: two oscillators that a preloaded spring keeps together, in closed form.

Compliances G_i = 1 / (k_i - m_i w^2 + j c_i w); the spring k between them carries f = k (u - gap), u = u_1 - u_2 downwards:
    u = (G_1 F) / (1 + k (G_1 + G_2)) at w,     u = u_0 - (G_1 + G_2) f at rest, u_0 by their weights.
"""
from math import pi, sqrt
from scene import Check, entries, run, section

bodies = {"upper": (2., 8e5, 0.02), "lower": (5., 3e5, 0.05)}
k, gap, F = 6e5, -4e-3, 300.
check = Check()


def compliance(name, w):
    mass, stiffness, ratio = bodies[name]
    return 1 / (stiffness - mass * w**2 + 2j * ratio * sqrt(stiffness * mass) * w)


for frequency in (37., 90., 210.):
    text = "\n".join([
        "set Bodies = upper, lower", "set Analyses = periodic",
        *(section(name, "set Type = oscillator",
                  section("Oscillator", entries(Mass=own[0], Stiffness=own[1], Damping_ratio=own[2])))
          for name, own in bodies.items()),
        section("Contact", entries(Friction_coefficient=0, Normal_law="linear spring", Penalty_amplitude=k,
                                   Penalty_exponent=1)),
        section("Periodic", entries(Number_of_functions=31, Frequency=frequency, Force=F, Gap=gap,
                                    Reference="true"))])
    found = run(f"oscillators_{frequency:.0f}", text)[0]["periodic"][0]
    w = 2 * pi * frequency
    amplitude = abs(compliance("upper", w) * F / (1 + k * (compliance("upper", w) + compliance("lower", w))))
    both = (compliance("upper", 0) + compliance("lower", 0)).real
    sag = 9.81 * (bodies["upper"][0] / bodies["upper"][1] - bodies["lower"][0] / bodies["lower"][1])
    mean = k * (sag - gap) / (1 + k * both)
    check.near("amplitude", (found["tip_max_m"] - found["tip_min_m"]) / 2, amplitude, 1e-5)
    check.near("mean", (found["tip_max_m"] + found["tip_min_m"]) / 2, sag - both * mean, 1e-5)
    check.near("impulse", found["impulse_Ns"][0], mean / frequency, 1e-9)
    check.near("distance to shooting", found["error_to_reference"], 0, 1e-6, 1)
check.end()

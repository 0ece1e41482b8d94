#!/usr/bin/env python3
"""Makes ring_at_rest.csv: radial receptances of the tyre paper's ring on an elastic foundation (doc/theory.md) between three points pi/100
apart, 0 to 1000 Hz by 1 Hz, circumferential orders |n| <= 400, 12 digits. Plain Python, 2 s."""
import math
import os

E, RHO, R, H, B, K_Z, K_THETA, P, XI = 1e8, 2280.0, 0.285, 0.01, 0.16, 1.64e6, 2.19e5, 2e5, 0.05
M = RHO * B * H
BENDING, MEMBRANE, TENSION = E * B * H**3 / 12 / R**4, E * B * H / R**2, P * B / R
POINTS = ("A", "B", "C")

orders = []
for n in range(401):
    tangential = (BENDING + MEMBRANE + TENSION) * n**2 + K_THETA
    radial = BENDING * n**4 + TENSION * n**2 + MEMBRANE + K_Z
    coupling = BENDING * n**3 + (MEMBRANE + TENSION) * n
    # the square root of the 2 x 2 system, for the same damping ratio of all modes
    root = math.sqrt(tangential * radial - coupling**2)
    orders.append((n, tangential, radial, coupling, root, 1 / math.sqrt(tangential + radial + 2 * root)))


def receptances(frequency):
    s = 2j * math.pi * frequency
    loss = 2 * XI * math.sqrt(M) * s
    sums = [0, 0, 0]
    for n, tangential, radial, coupling, root, scale in orders:
        a = M * s * s + loss * (tangential + root) * scale + tangential
        d = M * s * s + loss * (radial + root) * scale + radial
        c = coupling * (1 + loss * scale)
        value = (1 if n == 0 else 2) * a / (a * d - c * c) / (2 * math.pi * R)
        for i in range(3):
            sums[i] += value * math.cos(n * i * math.pi / 100)
    return sums


with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "ring_at_rest.csv"), "w") as file:
    pairs = [(i, j) for i in range(3) for j in range(i, 3)]
    file.write("# Receptances of the tyre paper's ring at rest, made by ring_at_rest.py\n"
               "# displacement of the first point under a unit force e^{+j w t} at the second, both radial, towards the axle\n")
    file.write(",".join(["frequency_Hz"] + [f"{POINTS[i]}_z_{POINTS[j]}_z_{part}_m_N" for i, j in pairs
                                            for part in ("real", "imag")]) + "\n")
    for frequency in range(1001):
        values = receptances(frequency)
        cells = [str(frequency)] + [f"{number:.11e}" for i, j in pairs
                                    for number in (values[j - i].real, values[j - i].imag)]
        file.write(",".join(cells) + "\n")

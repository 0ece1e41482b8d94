#!/usr/bin/env python3
"""all_modes.py PROGRAM MPIRUN PARAMETER_FILES: modes that leave nothing of a body out carry roots above them, too.

A node of two dofs slides on a spring whose normal force brings its friction: its roots are those of a matrix of two unknowns. The spring lifts
them above the frequencies of the free body.
"""
import cmath
import math

from scene import Check, entries, run, section, write_matrix

check = Check()
SPRING, FRICTION, DAMPING = 4.3e5, 0.5, 20.
STIFFNESS = ((1e6, 2e4), (2e4, 6e5))


write_matrix("K.mtx", STIFFNESS)
write_matrix("M.mtx", ((1., 0.), (0., 1.)))
write_matrix("C.mtx", ((DAMPING, 0.), (0., DAMPING)))
with open("dofs.csv", "w", encoding="utf-8") as file:
    file.write("node,x_m,y_m,z_m,direction\n1,0,0,0,x\n1,0,0,0,z\n")
with open("groups.csv", "w", encoding="utf-8") as file:
    file.write("group,node\nfoot,1\n")


def stability(n_modes):
    text = "\n".join([
        "set Bodies = body, plane", "set Analyses = stability",
        section("body", "set Type = matrices",
                section("Matrices", entries(Stiffness="K.mtx", Mass="M.mtx", Damping="C.mtx", Dofs="dofs.csv", Groups="groups.csv",
                                            Contact_group="foot", Contact_point="0,0,0")),
                section("Modes", entries(Count=n_modes))),
        section("plane", "set Type = rigid"),
        section("Contact", entries(Friction_coefficient=FRICTION, Grid_spacing=1e-3, Normal_law="linear spring",
                                   Penalty_amplitude=SPRING / 10, Penalty_exponent=10)),
        section("Rolling", entries(Hub_displacement=1e-3, Speed=0, Sliding_velocity_x=1))])
    found, _ = run(f"modes_{n_modes}", text, may_doubt=n_modes == 1)
    return found["stability"]["cases"][0]


case = stability(2)

(a, b), (c, d) = STIFFNESS[0], (STIFFNESS[1][0], STIFFNESS[1][1] + SPRING)
b -= FRICTION * SPRING
square = (a + d) / 2 + cmath.sqrt(((a - d) / 2)**2 + b * c)
root = -DAMPING / 2 + cmath.sqrt(DAMPING**2 / 4 - square)
check.near("it grows", len(case["unstable"]), 1, 1e-9)
check.near("growth", case["unstable"][0]["growth_1_s"], abs(root.real + DAMPING / 2) - DAMPING / 2, 1e-8)
check.near("frequency", case["unstable"][0]["frequency_Hz"], abs(root.imag) / (2 * math.pi), 1e-8)
check.near("all modes reach everywhere", "modes_reach_Hz" in case, False, 1e-9)
check.near("one of both does not", "modes_reach_Hz" in stability(1), True, 1e-9)
check.end()

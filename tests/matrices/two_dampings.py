#!/usr/bin/env python3
"""two_dampings.py PROGRAM MPIRUN PARAMETER_FILES: where H couples modes, hysteretic stability has the part of C of each mode on
the diagonal of H, 2 zeta w^2 = c w. A modal body with H and C has the roots of one whose H says so already."""
import math
from scene import Check, entries, run, section, write_matrix

check = Check()
omega, c = [3e4, 5e4, 7e4, 3e5, 4e5, 5e5], [40., 90., 130., 0., 0., 0.]
# three modes are kept; what the others lose is not known to either body
H = [[2e7, 5e6, 1e6], [5e6, 4e7, 8e6], [1e6, 8e6, 9e7]]
H = [[H[i][j] if max(i, j) < 3 else 0. for j in range(6)] for i in range(6)]


def diagonal(values):
    return [[value if i == j else 0. for j in range(len(values))] for i, value in enumerate(values)]


write_matrix("K.mtx", diagonal([w * w for w in omega]))
write_matrix("M.mtx", diagonal([1.] * 6))
write_matrix("C.mtx", diagonal(c))
write_matrix("H.mtx", H)
write_matrix("both.mtx", [[H[i][j] + (c[i] * omega[i] if i == j else 0) for j in range(6)] for i in range(6)])
write_matrix("T.mtx", [[1., 0.5, 0.3, 3., 1., -2.], [0.4, 1., -0.2, 1., 3., 0.5], [0.1, 0.2, 1., -1., 0.4, 3.]])
with open("dofs.csv", "w") as file:
    file.write("node,x_m,y_m,z_m,direction\n" + "".join(f"1,0,0,0,{d}\n" for d in "zxy"))
with open("groups.csv", "w") as file:
    file.write("group,node\ncontact,1\n")


def roots(name, structural, listed="stability", fails=False, **more):
    files = dict(Stiffness="K.mtx", Mass="M.mtx", Structural_damping=structural, Recovery="T.mtx", Dofs="dofs.csv",
                 Groups="groups.csv", Contact_group="contact", **more)
    text = "\n".join([
        f"set Bodies = part, plane\nset Analyses = {listed}",
        section("part", "set Type = matrices", section("Matrices", entries(**files)), section("Modes", entries(Count=3))),
        section("plane", "set Type = rigid"), section("Contact", entries(Friction_coefficient=0.4)),
        section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Normal_force=10)),
        section("Stability", entries(Loss="hysteretic")) if "stability" in listed else ""])
    return run(name, text, 1, may_doubt=True)


apart = roots("apart", "H.mtx", Damping="C.mtx")[0]["stability"]["cases"][0]
together = roots("together", "both.mtx")[0]["stability"]["cases"][0]
without = roots("without", "H.mtx")[0]["stability"]["cases"][0]
key = "nearest"
for one, other in ((apart, together),):
    for value in ("frequency_Hz", "growth_1_s"):
        check.near(value, one[key][value], other[key][value], 1e-9)
difference = abs(apart[key]["growth_1_s"] - without[key]["growth_1_s"])
check.near("C matters", float(difference > 0.03 * abs(without[key]["growth_1_s"])), 1, 0.1)
check.end()

#!/usr/bin/env python3
"""unreduced.py PROGRAM MPIRUN PARAMETER_FILES: models that take the contacts from the elements.

A block on two patches equals the block on one grid that holds both, in stability (finite elements by LAPACK and by SLEPc,
hub massless and held, rigid and yielding law) and in a transient of the finite
elements. The transient of nearly all modes, without mass in the contact, is near it.
"""
import math

from long_block import block, hollow_base, one_grid, two_patches
from scene import Check, entries, run, section, table

check = Check()
solver = section("Solver", entries(Tolerance=1e-13))


def contacts(listed, **more):
    own = dict(Friction_coefficient=0.3, **more)
    return two_patches(**own) + "\n" + section("Contact", solver) if listed else one_grid(solver, **own)


def both(name, analysis, more, ranks=1, body=None, law=None):
    found = []
    for form in (False, True):
        text = "\n".join(["set Bodies = block, base", "set Contacts = rear, front" if form else "",
                          f"set Analyses = {analysis}", body or block(1, 30), hollow_base, contacts(form, **(law or {})), more])
        found.append(run(f"{name}_{form}_{ranks}", text, ranks))
    return found


def sliding(**load):
    return section("Rolling", entries(Speed=0, Sliding_velocity_y=1, Sliding_velocity_x=0.3, **load))


def compare_roots(what, folders):
    roots = [table(folder, "stability.csv") for folder in folders]
    check.near(f"{what}: enough roots", len(roots[0]) >= 10, True, 1e-9)
    check.near(f"{what}: number of roots", len(roots[1]), len(roots[0]), 1e-9)
    for p, q in zip(*roots):
        size = 2 * math.pi * p["frequency_Hz"]
        check.near(f"{what}: frequency", q["frequency_Hz"], p["frequency_Hz"], 1e-8)
        check.near(f"{what}: growth", q["growth_1_s"], p["growth_1_s"], 1e-8, size)
    return roots[1]


spring = dict(Normal_law="linear spring", Penalty_amplitude=1e8, Penalty_exponent=1)
for name, hub, ranks, body, law in (
        ("elements", "massless", 1, None, None), ("elements", "massless", 2, None, None), ("held", "held", 1, None, None),
        ("springs", "held", 1, None, spring), ("sparse", "massless", 1, block(6, 30), None)):
    stability = section("Stability", entries(Model="finite elements", Number_of_roots=12))
    (_, one), (_, two) = both(name, "stability", sliding(Normal_force=60, Hub=hub) + "\n" + stability, ranks, body, law)
    compare_roots(f"{name} {ranks}", (one, two))
stability = section("Stability", entries(Model="attachment inertia"))
(_, one), (_, two) = both("inertia", "stability", sliding(Normal_force=60, Hub="held") + "\n" + stability)
for p, q, elements in list(zip(*[table(folder, "stability.csv") for folder in (one, two, "held_True_1")]))[:6]:
    size = 2 * math.pi * elements["frequency_Hz"]
    for found in (p, q):
        check.near("frequency with attachment inertia", found["frequency_Hz"], elements["frequency_Hz"], 1e-6)
        check.near("growth with attachment inertia", found["growth_1_s"], elements["growth_1_s"], 1e-6, size)

load = sliding()
transient = dict(Time_step=2e-7, End_time=4e-5, Normal_force="30 + 5*sin(2*pi*8e3*t)")
elements = load + "\n" + section("Transient", entries(Model="finite elements", Reaction="end of step", **transient),
                                 section("Signals", entries(Table="true")))
for ranks in (1, 2):
    (one, one_folder), (two, two_folder) = both("time", "transient", elements, ranks)
    a, b = one["transient"], two["transient"]
    check.near("impulse", b["impulse_Ns"], a["impulse_Ns"], 1e-10)
    check.near("impulse of the contacts", sum(c["impulse_Ns"] for c in b["contacts"].values()), a["impulse_Ns"], 1e-10)
    for p, q in zip(*[table(folder, "histories.csv") for folder in (one_folder, two_folder)]):
        for column in ("normal_force_N", "tangential_force_x_N", "tangential_force_y_N"):
            check.near(f"{column} at {p['time_s']} s", q[column], p[column], 1e-9, 60)
            check.near(f"sum of {column}", q["rear_" + column] + q["front_" + column], p[column], 1e-9, 60)
reduced = load + "\n" + section("Transient", entries(Model="reduced", **transient))
_, (modes, _) = both("modes", "transient", reduced, body=block(1, 200))
for name in ("rear", "front"):
    check.near(f"nearly all modes, {name}", modes["transient"]["contacts"][name]["impulse_Ns"],
               b["contacts"][name]["impulse_Ns"], 2e-3)
check.end()

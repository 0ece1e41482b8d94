#!/usr/bin/env python3
"""two_patches.py PROGRAM MPIRUN PARAMETER_FILES: a block on two patches equals the block on one grid that holds both.

The base is hollow across the direction of rolling, so that the block touches it on both sides and not between: once on
one grid of 7 rows, once on two of 3, under a given total normal force. Rolling, transient and stability, one rank and two.
"""
import json, math, os
from scene import Check, entries, run, section, table

row = 2e-3  # spacing of the contact points [m]
shape = section("Block", entries(Length=0.03, Width=0.014, Height=0.008, Divisions_x=15, Divisions_y=7,
                                 Divisions_z=2, Contact_face="bottom", Held="top"))
material = dict(Young_modulus="1e10", Poisson_ratio=0.3)
base = section("base", "set Type = rigid", section("Rigid", entries(Radius_x=0.3, Radius_y=-0.2)))
solver = section("Solver", entries(Tolerance=1e-13))
patch = dict(Grid_spacing=row, Half_length=5 * row)
single = section("Contact", entries(**patch, Half_width=3 * row), solver)
listed = "\n".join([
    section("left", entries(Bodies="block, base", Origin=f"0, {-2 * row}, 0", **patch, Half_width=row)),
    section("right", entries(Bodies="block, base", Origin=f"0, {2 * row}, 0", **patch, Half_width=row)),
    section("Contact", solver)])
creep = dict(Longitudinal_creepage=2e-4, Lateral_creepage=4e-4, Spin=0.1)
sliding = dict(Longitudinal_creepage=2e-2, Lateral_creepage=5e-2, Spin=1)
check = Check()


def text_of(analyses, contacts, names, rolling, *sections):
    moves = analyses != "quasi-static rolling"
    block = section("block", "set Type = block", shape,
                    section("Material", entries(**material, **(dict(Density=1500) if moves else {}))),
                    section("Modes", entries(Count=20)) if moves else "")
    return "\n".join(["set Bodies = block, base", f"set Analyses = {analyses}", names, block, base, contacts,
                      section("Rolling", entries(Normal_force=5000, Speed=10, **rolling)), *sections])


def both(name, analyses, rolling, *sections, ranks=1):
    results = []
    for form, contacts, names in (("single", single, ""), ("listed", listed, "set Contacts = left, right")):
        results.append(run(f"{name}_{form}_{ranks}", text_of(analyses, contacts, names, rolling, *sections), ranks))
    return results


def compare_patches(single_folder, folder):
    """Point by point, pressures and tractions over the largest pressure."""
    points = {(round(p["x_m"] / row), round(p["y_m"] / row)): p for p in table(single_folder, "contact_patch_0.csv")}
    largest = max(p["pressure_Pa"] for p in points.values())
    touching = 0
    for name, shift in (("left", -2), ("right", 2)):
        for p in table(folder, f"contact_patch_{name}_0.csv"):
            q = points[round(p["x_m"] / row), round(p["y_m"] / row) + shift]
            touching += p["pressure_Pa"] > 0
            for column in ("pressure_Pa", "traction_x_Pa", "traction_y_Pa"):
                check.near(f"{name} {column} at {p['x_m']}, {p['y_m']}", p[column], q[column], 1e-10, largest)
            check.near(f"{name} status", p["status"], q["status"], 0.5, 1)
    middle = [p["pressure_Pa"] for (i, j), p in points.items() if j == 0]
    check.near("pressure between the patches", max(middle), 0, 1e-300, 1)
    check.near("points in contact", touching, sum(p["pressure_Pa"] > 0 for p in points.values()), 1e-9)


steady = {name: value for name, value in creep.items() if name != "Lateral_creepage"}


def in_time(end):
    return section("Transient", entries(Time_step=5e-7, End_time=end, Lateral_creepage="4e-4 + 4e-3*sin(2*pi*2e4*t)"),
                   section("Signals", entries(Table="true", Patch_interval=1e-5)))


for ranks in (1, 2):
    (one, one_folder), (two, two_folder) = both("rolling", "quasi-static rolling", creep, ranks=ranks)
    a, b = one["quasi_static_rolling"]["cases"][0], two["quasi_static_rolling"]["cases"][0]
    for key in ("normal_force_N", "spin_moment_Nm", "utilisation", "approach_m", "max_pressure_Pa"):
        check.near(key, b[key], a[key], 1e-10)
    for key in ("contact_points", "stick_points", "slip_points"):
        check.near(key, b[key], a[key], 1e-9)
        check.near(f"{key}, enough of them", a[key] >= 4, True, 1e-9)
    parts = [two["quasi_static_rolling"]["contacts"][name]["cases"][0] for name in ("left", "right")]
    check.near("total normal force", sum(part["normal_force_N"] for part in parts), 5000, 1e-10)
    for d in range(2):
        check.near("tangential force", b["tangential_force_N"][d], a["tangential_force_N"][d], 1e-10)
        check.near("its parts", sum(part["tangential_force_N"][d] for part in parts), a["tangential_force_N"][d], 1e-10)
    compare_patches(one_folder, two_folder)

    (one, one_folder), (two, two_folder) = both("stability", "stability", sliding, ranks=ranks)
    roots = [table(folder, "stability.csv") for folder in (one_folder, two_folder)]
    check.near("number of roots", len(roots[1]), len(roots[0]), 1e-9)
    for p, q in zip(*roots):
        size = 2 * math.pi * p["frequency_Hz"]
        check.near("frequency", q["frequency_Hz"], p["frequency_Hz"], 1e-10)
        check.near("growth", q["growth_1_s"], p["growth_1_s"], 1e-10, size)

    (one, one_folder), (two, two_folder) = both(
        "transient", "transient", steady, in_time(5e-5), ranks=ranks)
    a, b = one["transient"], two["transient"]
    for key in ("impulse_Ns", "rms_normal_force_N"):
        check.near(key, b[key], a[key], 1e-10)
    check.near("impulse of the contacts", sum(c["impulse_Ns"] for c in b["contacts"].values()), a["impulse_Ns"], 1e-10)
    histories = [table(folder, "histories.csv") for folder in (one_folder, two_folder)]
    check.near("lines", len(histories[1]), len(histories[0]), 1e-9)
    for p, q in zip(*histories):
        for column in ("normal_force_N", "tangential_force_x_N", "tangential_force_y_N"):
            check.near(f"{column} at {p['time_s']} s", q[column], p[column], 1e-10, 5000)
            check.near(f"sum of {column}", q["left_" + column] + q["right_" + column], p[column], 1e-10, 5000)
        check.near("approach", q["approach_m"], p["approach_m"], 1e-10, 1e-5)

# stopped half-way and resumed: bit for bit the same
text = [text_of("transient", listed, "set Contacts = left, right", steady, in_time(end)) for end in (2.5e-5, 5e-5)]
run("resumed", text[0])
_, folder = run("resumed", text[1], 1, "--resume")
whole, parts = table("transient_listed_1", "histories.csv"), table(folder, "histories.csv")
check.near("lines of the resumed run", len(parts), len(whole), 1e-9)
for p, q in zip(whole, parts):
    for column in p:
        check.near(f"{column} of the resumed run", q[column], p[column], 1e-300, 1)
sums = [json.load(open(f + "/results.json"))["analyses"]["transient"]["contacts"] for f in ("transient_listed_1", folder)]
for name in ("left", "right"):
    check.near(f"impulse of {name}", sums[1][name]["impulse_Ns"], sums[0][name]["impulse_Ns"], 1e-300, 1)
    check.near(f"frames of {name}", os.path.exists(f"{folder}/patch_{name}.pvd"), True, 1e-9)
check.end()

#!/usr/bin/env python3
"""followed_map.py PROGRAM MPIRUN PARAMETER_FILES: a map by followed roots is the complete one, and derivatives of roots.

Lateral position (on and between grid points) x friction: every followed root is one of the complete solution, roots that grow are
the same by name, two ranks give the same. Derivatives by left and right vectors are the differences of the roots, with respect to
friction, load, position, damping, loss factor, pad stiffness, thickness of the wheel's web; draws scatter as the first order says.
"""
import math

from scene import Check, entries, run, section, table

check = Check()


def scene(*stability, modes=1200, **contact):
    return "\n".join([
        "set Bodies = wheel, rail", "set Analyses = stability",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2)),
                section("Modes", entries(Upper_frequency=modes))),
        section("rail", "set Type = beam rail", section("Material", entries(Loss_factor=0.02)),
                section("Beam rail", entries(Length=2.4, Contact_at="mid-span")), section("Modes", entries(Upper_frequency=modes))),
        section("Contact", entries(Grid_spacing=2e-3, Half_length=10e-3, Half_width=8e-3, **contact)),
        section("Rolling", entries(Hub_displacement=0.35e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Stability", *stability)])


def map_of(roots, **more):
    return scene(entries(Roots_of_a_sweep=roots, **more), section("Sweep", entries(
        Entry="Contact/Lateral position", Values="-10e-3, -9e-3", Second_entry="Contact/Friction coefficient",
        Second_range="0.05, 0.45, 0.02")))


(whole, folder), (one, folder_1), (two, folder_2) = [
    run(name, map_of(roots), ranks) for name, roots, ranks in (("complete", "complete", 2), ("followed", "followed", 1), ("two_ranks", "followed", 2))]
check.near("cases", len(one["stability"]["cases"]), 42, 1e-9)
check.near("most are followed", one["stability"]["followed"]["cases"], 42 - 2 * 3.5, 0.1)
for a, b in zip(table(folder_1, "stability.csv"), table(folder_2, "stability.csv")):
    check.near("a root on two ranks", b["growth_1_s"], a["growth_1_s"], 1e-15)
n = 0
complete = {}
for row in table(folder, "stability.csv"):
    complete.setdefault((row["case"], row["root"]), []).append(row)
for row in table(folder_1, "stability.csv"):
    same = complete[row["case"], row["root"]][0]
    check.near(f"growth of {row['root']} in case {row['case']}", row["growth_1_s"], same["growth_1_s"], 1e-3, 1)
    check.near("its frequency", row["frequency_Hz"], same["frequency_Hz"], 1e-7)
for a, b in zip(whole["stability"]["cases"], one["stability"]["cases"]):
    names = [sorted(root["root"] for root in found["unstable"]) for found in (a, b)]
    check.near(f"the same roots grow, {names}", names[0] == names[1], True, 1e-9)
    n += len(names[0])
check.near("roots grow", n > 10, True, 1e-9)

names = "Contact/Friction coefficient, Contact/Lateral position, Rolling/Hub displacement, wheel/Modes/Damping factor, rail/Material/Loss factor, rail/Beam rail/Pad stiffness z, wheel/Wheel/Web thickness change"
for loss, some in ("viscous", names.split(", ")[:3]), ("hysteretic", names.split(", ")[3:]):
    found, folder = run("derivatives_" + loss, scene(entries(Loss=loss), section("Derivatives", entries(
        Entries=", ".join(some), Standard_deviations=", ".join(["1e-6"] * len(some)))),
                                                     Friction_coefficient=0.3, Lateral_position=-10e-3))
    check.near("no draws, no columns of them", any("draws" in name for name in table(folder, "stability_scatter.csv")[0]), False, 1e-9)
    check.near("nor keys", any("draws" in name for name in found["stability"]["scatter"][0]), False, 1e-9)
    rows = table(folder, "stability_derivatives.csv")
    check.near("derivatives", len(rows) >= 4 * len(some), True, 1e-9)
    for row in rows:
        size = math.hypot(2 * math.pi * row["frequency_by_difference_Hz"], row["growth_by_difference_1_s"])
        text = f"{row['root']} by {row['entry']}"
        check.near("growth of " + text, row["growth_per_unit_1_s"], row["growth_by_difference_1_s"], 1e-4, size)
        check.near("frequency of " + text, 2 * math.pi * row["frequency_per_unit_Hz"], 2 * math.pi * row["frequency_by_difference_Hz"], 1e-4, size)

found, folder = run("scatter", scene(section("Derivatives", entries(
    Entries="Contact/Friction coefficient, Rolling/Hub displacement", Standard_deviations="2e-3, 2e-6", Draws=60)),
    Friction_coefficient=0.3, Lateral_position=-10e-3), 2)
for row in table(folder, "stability_scatter.csv"):
    if row["growth_deviation_1_s"] < 0.01:
        continue
    # the deviation of 60 draws is known to 9 %
    check.near(f"scatter of {row['root']}", row["deviation_of_draws_1_s"], row["growth_deviation_1_s"], 0.3)
check.end()

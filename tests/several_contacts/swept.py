#!/usr/bin/env python3
"""swept.py PROGRAM MPIRUN PARAMETER_FILES: sweeps of several contacts.

Every case of Stability/Sweep equals a single run, on one rank and two; the friction of one contact alone is swept, or that of both.
"""
import math

from scene import Check, entries, run, section, table

row = 2e-3
check = Check()


def text(right, lateral, *more, left=0.1):
    block = section("block", "set Type = block",
                    section("Block", entries(Length=0.03, Width=0.014, Height=0.008, Divisions_x=15, Divisions_y=7,
                                             Divisions_z=2, Contact_face="bottom", Held="top")),
                    section("Material", entries(Young_modulus="1e10", Poisson_ratio=0.3, Density=1500)),
                    section("Modes", entries(Count=20)))
    own = dict(Bodies="block, base", Grid_spacing=row, Half_length=5 * row, Half_width=row)
    return "\n".join(["set Bodies = block, base", "set Contacts = left, right", "set Analyses = stability", block,
                      section("base", "set Type = rigid", section("Rigid", entries(Radius_x=0.3, Radius_y=-0.2))),
                      section("left", entries(Origin=f"0, {-2 * row}, 0", Friction_coefficient=left, **own)),
                      section("right", entries(Origin=f"0, {2 * row}, 0", Friction_coefficient=right, **own)),
                      section("Rolling", entries(Normal_force=5000, Speed=10, Lateral_creepage=lateral)), *more])


frictions, creepages = (0.2, 0.4), (0.05, 0.08)
sweep = section("Stability", section("Sweep", entries(Entry="right/Friction coefficient", Values="0.2, 0.4",
                                                      Second_entry="Rolling/Lateral creepage", Second_values="0.05, 0.08")))
singles = []
for friction in frictions:
    for creepage in creepages:
        found, folder = run(f"single_{friction}_{creepage}", text(friction, creepage))
        singles.append((found["stability"], table(folder, "stability.csv")))
for ranks in (1, 2):
    found, folder = run(f"sweep_{ranks}", text(0.3, 0.05, sweep), ranks)
    found = found["stability"]
    check.near("cases", len(found["cases"]), len(singles), 1e-9)
    roots = table(folder, "stability.csv")
    for k, (single, own) in enumerate(singles):
        here = [root for root in roots if root["case"] == k]
        check.near("roots of a case", len(here), len(own), 1e-9)
        for p, q in zip(own, here):
            size = 2 * math.pi * p["frequency_Hz"]
            check.near("frequency", q["frequency_Hz"], p["frequency_Hz"], 1e-12)
            check.near("growth", q["growth_1_s"], p["growth_1_s"], 1e-12, size)
        for name in ("left", "right"):
            a, b = single["contacts"][name]["cases"][0], found["contacts"][name]["cases"][k]
            check.near(f"normal force of {name}", b["normal_force_N"], a["normal_force_N"], 1e-12)
            check.near(f"friction of {name}", b["friction"], a["friction"], 1e-12)

# both frictions moved together: a run with both at that value, of which roots above Upper frequency are counted alone
together = section("Stability", section("Sweep", entries(Entry="left/Friction coefficient, right/Friction coefficient", Values="0.1, 0.3")))
found, folder = run("together", text(0.2, 0.05, together))
own, own_folder = run("both_at_0.3", text(0.3, 0.05, left=0.3))
for name in ("left", "right"):
    check.near(f"{name} moves with the other", found["stability"]["contacts"][name]["cases"][1]["friction"], 0.3, 1e-12)
for p, q in zip(table(own_folder, "stability.csv"), [root for root in table(folder, "stability.csv") if root["case"] == 1]):
    check.near("growth", q["growth_1_s"], p["growth_1_s"], 1e-12, 2 * math.pi * p["frequency_Hz"])
roots = table(own_folder, "stability.csv")
limit = sorted(root["frequency_Hz"] for root in roots)[len(roots) // 2] + 1
low, low_folder = run("up_to", text(0.3, 0.05, section("Stability", entries(Upper_frequency=limit)), left=0.3))
above = low["stability"]["cases"][0]["above_upper_frequency"]
check.near("roots above", above["roots"], sum(root["frequency_Hz"] > limit for root in roots), 1e-9)
check.near("growing above", above["growing"], sum(root["frequency_Hz"] > limit and root["growth_1_s"] > 1e-6 * root["frequency_Hz"]
                                                 for root in roots), 1e-9)
check.near("roots below", len(table(low_folder, "stability.csv")), sum(root["frequency_Hz"] <= limit for root in roots), 1e-9)
check.near("the right friction matters", abs(singles[0][0]["contacts"]["right"]["cases"][0]["tangential_force_N"][1]) <
           0.6 * abs(singles[2][0]["contacts"]["right"]["cases"][0]["tangential_force_N"][1]), True, 1e-9)
check.end()

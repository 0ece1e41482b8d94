#!/usr/bin/env python3
"""wheel_dampers.py PROGRAM MPIRUN PARAMETER_FILES: dampers on a wheel by harmonics in its contact.

Absorbers of hardly any mass change hardly anything, none changes the equilibrium. The roots near the modes of the wheel that a sweep
follows are those of the complete eigenproblem, on one rank and two.
"""
import math

from scene import Check, entries, run, section, table

check = Check()


light, both = 1e-9, "absorbers, rim"


def wheel(name, ranks=1, roots="all", sweep="", dampers="", mass=light, layer=0.002, options=()):
    text = "\n".join([
        "set Bodies = wheel, crown", "set Analyses = stability",
        section("wheel", "set Type = wheel",
                section("Wheel", entries(Model="harmonics", Element_degree=2, Dampers=dampers),
                        section("Damper",
                                *([section("absorbers", entries(Mass=mass, Frequency=620, Loss_factor=0.1, Axial_position=0.06, Radius=0.4, Number=3, First_angle=20))] if "absorbers" in dampers else []),
                                section("rim", entries(Kind="layer", Loss_factor=layer, Inner_radius=0.38))) if dampers else ""),
                section("Modes", entries(Upper_frequency=1500))),
        section("crown", "set Type = rigid", section("Rigid", entries(Radius_y=0.3))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2e-3, Lateral_position=15e-3)),
        section("Rolling", entries(Hub_displacement=0.05e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Stability", entries(Loss="hysteretic", Roots=roots), sweep)])
    return run(name, text, ranks, *options, may_doubt=True)


def masses(values):
    return section("Sweep", "set Entry = wheel/Wheel/Damper/absorbers/Mass", f"set Values = {values}")


def divergence(root):
    return root["growth_1_s"] / (2 * math.pi * max(root["frequency_Hz"], 1))


def nearest(root, rows):
    return min(rows, key=lambda r: math.hypot(2 * math.pi * (r["frequency_Hz"] - root["frequency_Hz"]), r["growth_1_s"] - root["growth_1_s"]))


bare, bare_folder = wheel("bare")
massless, massless_folder = wheel("massless", dampers=both, sweep=masses(f"{light}, 0.5, 2"))
rows = table(massless_folder, "stability.csv")
column = [name for name in rows[0] if name.startswith("mass")][0]
fast = {ranks: table(wheel(f"fast_{ranks}", ranks, "of body 1", masses(f"{light}, 0.5, 2"), both)[1], "stability.csv") for ranks in (1, 2)}
for mass in (light, 0.5, 2):
    complete, followed, on_two = [[r for r in t if r[column] == mass] for t in (rows, fast[1], fast[2])]
    check.near("number of roots on two ranks", len(on_two), len(followed), 1e-9)
    for a, b in zip(followed, on_two):
        check.near("growth on two ranks", b["growth_1_s"], a["growth_1_s"], 1e-9, 2 * math.pi * a["frequency_Hz"])
    # both ways: none is missed, and none is another's
    for a in [r for r in complete if divergence(r) > -4e-3]:
        b, size = nearest(a, followed), 2 * math.pi * a["frequency_Hz"]
        check.near("frequency of a root that is followed", b["frequency_Hz"], a["frequency_Hz"], 1e-8)
        check.near("its growth", b["growth_1_s"], a["growth_1_s"], 1e-8, size)
        check.near("the root of one", nearest(b, complete)["growth_1_s"], a["growth_1_s"], 1e-12)
# where all decays fast there are roots as well
complete, followed = [[r for r in table(wheel(f"heavy_{roots[:2]}", 1, roots, masses("0.5"), both, layer=1.0)[1], "stability.csv") if r["frequency_Hz"] > 0]
                      for roots in ("all", "of body 1")]
check.near("as many as wanted", len(followed), 12, 1e-9)
check.near("most of them decay fast", sum(divergence(r) < -5e-3 for r in followed) > 6, True, 1e-9)
for b in followed:
    a = nearest(b, complete)
    check.near("frequency of one that decays fast", b["frequency_Hz"], a["frequency_Hz"], 1e-8)
    check.near("its growth", b["growth_1_s"], a["growth_1_s"], 1e-8, 2 * math.pi * a["frequency_Hz"])

cases = massless["stability"]["cases"]
for case in cases:
    check.near("force with dampers", case["normal_force_N"], bare["stability"]["cases"][0]["normal_force_N"], 1e-9)

# the layer alone adds a damping. On springs of loss factor eta 9 masses m change s by m b^2 / (2 eta) at most, b^2 < 1/kg as no mode moves less than 1 kg
# An option that lists the layer alone leaves the file its section of the absorbers.
folder = wheel("alone", dampers=both, options=["--set", "wheel/Wheel/Dampers=rim"])[1]
for a in table(folder, "stability.csv"):
    b = nearest(a, [r for r in rows if r[column] == light])
    check.near("a root with absorbers of hardly any mass", b["growth_1_s"], a["growth_1_s"], 9 * light / (2 * 0.1), 2 * math.pi * a["frequency_Hz"])
check.end()

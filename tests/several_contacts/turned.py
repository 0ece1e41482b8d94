#!/usr/bin/env python3
"""turned.py PROGRAM MPIRUN PARAMETER_FILES: a contact in a frame of its own equals the same contact in the usual one.

The same block, lying: the contact is on its front, the normal along y, so that x = e_x and y = -e_z there. It is pressed by an
overlap in place of the hub, and creeps by the contact's own creepages. Rolling and stability.
"""
import math
from scene import Check, entries, run, section, table

length, width, height, pressed = 0.03, 0.014, 0.008, 5e-5
material = section("Material", entries(Young_modulus="2.1e11", Poisson_ratio=0.3, Density=7800))
modes = section("Modes", entries(Count=15))
base = section("base", "set Type = rigid", section("Rigid", entries(Radius_x=0.3, Radius_y=0.2)))
patch = dict(Grid_spacing=2e-3, Half_length=1e-2, Half_width=6e-3)
creep = dict(Longitudinal_creepage=2e-2, Lateral_creepage=5e-2, Spin=1)
analyses = "set Bodies = block, base\nset Analyses = quasi-static rolling, stability\n"
solver = section("Solver", entries(Tolerance=1e-13))
upright = analyses + "\n".join([
    section("block", "set Type = block",
            section("Block", entries(Length=length, Width=width, Height=height, Divisions_x=15, Divisions_y=7,
                                     Divisions_z=2, Contact_face="bottom", Held="top")), material, modes),
    base, section("Contact", entries(**patch), solver),
    section("Rolling", entries(Hub_displacement=pressed, Speed=10, **creep))])
lying = analyses + "\n".join([
    "set Contacts = front",
    section("block", "set Type = block",
            section("Block", entries(Length=length, Width=height, Height=width, Divisions_x=15, Divisions_y=2,
                                     Divisions_z=7, Contact_face="bottom", Held="back")), material, modes),
    base,
    section("front", entries(Bodies="block, base", Origin=f"0, {-height / 2}, {width / 2}", Origin_on_body_2="0, 0, 0",
                             Normal="0, 2, 0", Gap=-pressed, **patch, **creep)),
    section("Contact", solver), section("Rolling", entries(Hub_displacement=1e-9, Speed=10))])
check = Check()
one, one_folder = run("upright", upright)
two, two_folder = run("lying", lying)
a = one["quasi_static_rolling"]["cases"][0]
b = two["quasi_static_rolling"]["contacts"]["front"]["cases"][0]
for key in ("normal_force_N", "spin_moment_Nm", "utilisation", "max_pressure_Pa"):
    check.near(key, b[key], a[key], 1e-9)
for d in range(2):
    check.near("tangential force", b["tangential_force_N"][d], a["tangential_force_N"][d], 1e-9)
check.near("points in contact", b["contact_points"], a["contact_points"], 1e-9)
check.near("enough of them", a["contact_points"] >= 9, True, 1e-9)
check.near("force on the block along z", two["quasi_static_rolling"]["cases"][0]["normal_force_N"],
           -b["tangential_force_N"][1], 1e-12)
roots = [table(folder, "stability.csv") for folder in (one_folder, two_folder)]
check.near("number of roots", len(roots[1]), len(roots[0]), 1e-9)
for p, q in zip(*roots):
    check.near("frequency", q["frequency_Hz"], p["frequency_Hz"], 1e-8)
    check.near("growth", q["growth_1_s"], p["growth_1_s"], 1e-8, 2 * math.pi * p["frequency_Hz"])
check.end()

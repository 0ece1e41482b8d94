#!/usr/bin/env python3
"""strip.py PROGRAM MPIRUN PARAMETER_FILES: a strip between two bars, against the compliances of the three bodies.

The bars have the compliance c each, the strip, held at its ends, the same a at both points and b between them:
(c + a) N1 - b N2 = d at the upper contact, pressed by d, and (c + a) N2 - b N1 = 0 at the lower one, so that
d / N1 = (c + a) (1 - (N2 / N1)^2). The upper contact alone gives c + a = d / N1.
"""
import os

from scene import Check, entries, run, section

pressed = 1e-5
area = 1.6e-5
steel = section("Material", entries(Young_modulus="2.1e11"))


def bar(name):
    return section(name, "set Type = bar", section("Bar", entries(Length=0.05, Section=area, Divisions=4)), steel)


strip = section("strip", "set Type = block",
                section("Block", entries(Length=0.06, Width=0.02, Height=0.004, Divisions_x=20, Divisions_y=6,
                                         Divisions_z=2, Contact_face="top", Held="left, right")), steel)
upper = section("upper", entries(Bodies="post, strip", Friction_coefficient=0))
lower = section("lower", entries(Bodies="strip, foot", Friction_coefficient=0, Origin="0, 0, -0.004",
                                 Origin_on_body_2="0, 0, 0"))
rolling = section("Rolling", entries(Hub_displacement=pressed, Speed=0))
check = Check()


def forces(name, contacts, bodies, *sections, ranks=1):
    text = "\n".join([f"set Bodies = {bodies}", f"set Contacts = {contacts}", "set Analyses = quasi-static rolling",
                      section("Contact", section("Solver", entries(Tolerance=1e-13))), rolling, *sections])
    found, _ = run(name, text, ranks)
    found = found["quasi_static_rolling"]
    return found["cases"][0], {c: found["contacts"][c]["cases"][0]["normal_force_N"] for c in contacts.split(", ")}


_, alone = forces("alone", "upper", "post, strip", bar("post"), strip, upper)
of_both = pressed / alone["upper"]
for ranks, order in ((1, "upper, lower"), (1, "lower, upper"), (2, "upper, lower")):
    total, N = forces(f"strip_{ranks}_{order[0]}", order, "post, strip, foot", bar("post"), strip, bar("foot"), upper,
                      lower, ranks=ranks)
    ratio = N["lower"] / N["upper"]
    check.near("share of the foot between 5 and 95 %", ratio, 0.5, 0.45, 1)
    check.near("force of the post", N["upper"], pressed / (of_both * (1 - ratio**2)), 1e-9)
    check.near("force on body 1", total["normal_force_N"], N["upper"], 1e-12)

# bodies that are not in the first contact are probed as well, and what the modes leave out of their damping is that of
# the bodies there
lossy = section("Material", entries(Young_modulus="2.1e11", Density=7800, Loss_factor=0.1))
modes = section("Modes", entries(Count=3))
bodies = [part.replace(steel, lossy)[:-len("end")] + modes + "\nend" for part in (bar("post"), strip, bar("foot"))]
text = "\n".join(["set Bodies = post, strip, foot", "set Contacts = upper, lower", "set Analyses = transient", rolling,
                  *bodies, upper, lower,
                  section("Transient", entries(Time_step=1e-6, End_time=2e-5),
                          section("Signals", entries(Probes="head: post 0 0 0.05 along z; toe: foot 0 0 0 along z")))])
found, folder = run("probed", text)
with open(os.path.join(folder, "log.txt")) as log:
    said = log.read()
for probe in ("head", "toe"):
    check.near(f"probe {probe} is placed", float(f"probe {probe}:" in said), 1, 1e-12)
check.end()

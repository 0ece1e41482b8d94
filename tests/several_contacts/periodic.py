#!/usr/bin/env python3
"""periodic.py PROGRAM MPIRUN PARAMETER_FILES: periodic motion with several contacts.

A block on two patches equals the block on one grid that holds both, with friction at rigid stops. A bar between two stops at
one node pushes both alike. A bar on two stops with two laws, and two bars that meet at two places, against their transients
until they repeat. A list of one contact has the response curve of section Contact.
"""
from long_block import block, hollow_base, one_grid, two_patches
from scene import Check, entries, run, section, table

check = Check()


def on_patches(name, contacts, names="", ranks=1, **gap):
    return run(name, "\n".join(["set Bodies = block, base", names, "set Analyses = periodic", block(Loss_factor=0.02), hollow_base,
                                contacts,
                                section("Periodic", entries(Number_of_functions=31, Frequency=15000, Force=12, Samples=512,
                                                            Force_point="0.006, 0, 0, 0.3, 0, 1", **gap))]), ranks)


one, one_folder = on_patches("one_grid", one_grid(Friction_coefficient=0.2), Gap=3.6e-6)
single = one["periodic"][0]
check.near("nothing between the patches", single["impulse_Ns"][3], 0, 1e-300, 1)
for ranks in (1, 2):
    two, folder = on_patches(f"two_grids_{ranks}", two_patches(Friction_coefficient=0.2, Gap=1e-6),
                             "set Contacts = rear, front", ranks, Gap=2.6e-6)
    found = two["periodic"][0]
    apart = single["impulse_Ns"][:3] + single["impulse_Ns"][4:]
    for p, (a, b) in enumerate(zip(apart, found["impulse_Ns"])):
        check.near(f"impulse of point {p}", b, a, 1e-10, max(apart))
    check.near("impulse of the rear", found["contacts"]["rear"]["impulse_Ns"], sum(apart[:3]), 1e-10)
    check.near("impulse of the front", found["contacts"]["front"]["impulse_Ns"], sum(apart[3:]), 1e-10)
    check.near("both carry", min(found["contacts"][c]["impulse_Ns"] for c in ("rear", "front")) > 1e-5, True, 1e-9)
    rows = [table(f, "periodic_0.csv") for f in (one_folder, folder)]
    for what in ("displacement_m", "tangential_force_1_N"):
        # the last point: number 6 on one grid, 5 on two
        names = [f"point_{p}_{what}" for p in (6, 5)]
        size = max(abs(line[names[0]]) for line in rows[0])
        worst = max(abs(a[names[0]] - b[names[1]]) for a, b in zip(*rows))
        check.near(f"{what} of the last point", worst, 0, 1e-10, size)
    check.near("something rubs there", size > 0.1, True, 1e-9)
smooth = on_patches("smooth_front", two_patches({"Friction_coefficient": 0}, Friction_coefficient=0.2, Gap=1e-6),
                    "set Contacts = rear, front", Gap=2.6e-6)[1]
forces = [max(abs(line[f"{p}tangential_force_1_N"]) for line in table(smooth, "periodic_0.csv")) for p in ("", "point_5_")]
check.near("friction of the rear", forces[0] > 0.1, True, 1e-9)
check.near("none in front", forces[1], 0, 1e-12, forces[0])

# bars
frequency, force, preload = 700., 2e5, 1e-5


def bar(name, length, modulus):
    return section(name, "set Type = bar", section("Material", entries(Young_modulus=modulus, Density=2700)),
                   section("Bar", entries(Length=length, Section=25e-4, Divisions=12, Element_degree=1)),
                   section("Modes", entries(Count=6, Stiffness_damping=1e-4)))


def rigid(name):
    return section(name, "set Type = rigid")


def contact(name, bodies, stiffness=None, **more):
    law = dict(Normal_law="linear spring", Penalty_amplitude=stiffness, Penalty_exponent=1) if stiffness else {}
    return section(name, entries(Bodies=bodies, Friction_coefficient=0, **law, **more))


def periodic(name, scene, ranks=1, *more, **changed):
    own = dict(Number_of_functions=101, Frequency=frequency, Force=force, Samples=8192, Gap=-preload,
               Model="finite elements")
    text = "\n".join(["set Analyses = periodic", *scene, section("Periodic", entries(**{**own, **changed}), *more)])
    return run(name, text, ranks)


def in_time(name, scene, steps, **changed):
    """Impulses of the last period, by contact."""
    impulses = []
    for periods in (15, 16):
        own = dict(Model="finite elements", Reaction="end of step", Initial_state="undeformed",
                   Time_step=f"{1 / frequency / steps:.17g}", End_time=f"{periods / frequency:.17g}",
                   Exciting_force=f"-{force}*sin(2*pi*{frequency}*t)", History_interval=1 / frequency)
        text = "\n".join(["set Analyses = transient", *scene, section("Rolling", entries(Speed=0, Hub_displacement=preload)),
                          section("Transient", entries(**{**own, **changed}))])
        impulses.append(run(f"{name}_{steps}_{periods}", text)[0]["transient"]["contacts"])
    return {name: impulses[1][name]["impulse_Ns"] - impulses[0][name]["impulse_Ns"] for name in impulses[0]}


def against_time(name, scene):
    found = periodic(name, scene)[0]["periodic"][0]["contacts"]
    coarse, fine = in_time(name, scene, 4000), in_time(name, scene, 8000)
    for one in fine:
        # reactions at the end of the step: first order
        check.near(f"{name}: impulse of {one}", found[one]["impulse_Ns"], 2 * fine[one] - coarse[one], 2e-5)
    reduced = [periodic(f"{name}_{ranks}", scene, ranks, Model="reduced")[0]["periodic"][0]["contacts"] for ranks in (1, 2)]
    for one in fine:
        check.near(f"{name}: fewer modes, {one}", reduced[0][one]["impulse_Ns"], found[one]["impulse_Ns"], 1e-3)
        check.near(f"{name}: two ranks, {one}", reduced[1][one]["impulse_Ns"], reduced[0][one]["impulse_Ns"], 1e-12)


upper, lower = bar("upper", 1., 70e9), bar("lower", 0.7, 40e9)
against_time("stops", ["set Bodies = upper, floor, shelf", "set Contacts = foot, middle", upper, rigid("floor"),
                       rigid("shelf"), contact("foot", "upper, floor", 2e8, Gap=1e-4),
                       contact("middle", "upper, shelf", 4e8, Gap=2e-4, Origin="0, 0, 0.5", Origin_on_body_2="0, 0, 0")])
against_time("two_bars", ["set Bodies = upper, lower", "set Contacts = foot, side", upper, lower,
                          contact("foot", "upper, lower", 2e8, Gap=1e-4),
                          contact("side", "upper, lower", 4e8, Gap=2e-4, Origin="0, 0, 0.5",
                                  Origin_on_body_2="0, 0, -0.35")])

# a rigid stop beside a spring; the forces of 63 functions at a rigid stop are good for some thousandths
mixed = ["set Bodies = upper, floor, shelf", "set Contacts = foot, middle", upper, rigid("floor"), rigid("shelf"),
         contact("foot", "upper, floor", Gap=1e-4),
         contact("middle", "upper, shelf", 4e8, Gap=3e-5, Origin="0, 0, 0.5", Origin_on_body_2="0, 0, 0")]
found = periodic("mixed", mixed, Model="reduced", Number_of_functions=63)[0]["periodic"][0]
check.near("laws", found["law"] == "signorini, linear", True, 1e-9)
time = in_time("mixed", mixed, 2000, Model="reduced", Reaction="as other forces", Integrator="exact propagator")
for one in time:
    check.near(f"mixed: impulse of {one}", found["contacts"][one]["impulse_Ns"], time[one], 3e-3, sum(time.values()))

# stops on both sides of one node
for law in (2e8, None):
    between = ["set Bodies = upper, floor, lid", "set Contacts = below, above", upper, rigid("floor"), rigid("lid"),
               contact("below", "upper, floor", law, Gap=1e-4), contact("above", "lid, upper", law, Gap=1e-4)]
    found = periodic(f"between_{bool(law)}", between, Model="reduced", Gap=0)[0]["periodic"][0]
    check.near("stops of a symmetric motion", found["contacts"]["above"]["impulse_Ns"],
               found["contacts"]["below"]["impulse_Ns"], 1e-10)
    history = table(f"between_{bool(law)}", "periodic_0.csv")
    half = len(history) // 2
    size = max(line["displacement_m"] for line in history)
    check.near("half a period later", max(abs(a["displacement_m"] + b["displacement_m"])
                                          for a, b in zip(history[:half], history[half:])), 0, 1e-10, size)

# a list of one
curve = section("Continuation", entries(Parameter="frequency", First_value=1180, Last_value=1350))
curves = []
for name, head, own in (("section", "set Bodies = upper, floor", section("Contact", entries(
        Friction_coefficient=0, Normal_law="linear spring", Penalty_amplitude=2e8, Penalty_exponent=1))),
                        ("list", "set Bodies = upper, floor\nset Contacts = foot",
                         contact("foot", "upper, floor", 2e8))):
    folder = periodic("curve_" + name, [head, upper, rigid("floor"), own], 1, curve, Gap=1e-4, Number_of_functions=31)[1]
    curves.append(table(folder, "response.csv"))
check.near("points of the curve", len(curves[1]), len(curves[0]), 1e-12)
for a, b in zip(*curves):
    for column in a:
        if column not in ("kind", "seconds"):
            check.near(f"{column} of the curve", b[column], a[column], 1e-12, max(abs(a[column]), 1e-12))
check.end()

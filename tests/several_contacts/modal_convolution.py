#!/usr/bin/env python3
"""modal_convolution.py PROGRAM MPIRUN PARAMETER_FILES: modal convolution of a body with several contacts.

A block on two patches equals the block on one grid that holds both, with friction and without. A bar on two stops with two
laws moves as in the transient of the same file.
"""
from long_block import block, one_grid, two_patches
from scene import Check, entries, run, section, table

check = Check()
# the road is hollow: the ends of the block touch, its middle does not
road = dict(Profile="expression", Expression="0.1*s*s", Indentation=-1.5e-6, Loading_time=2e-5)


def on_patches(name, listed, friction, ranks=1):
    contacts = (two_patches if listed else one_grid)(Friction_coefficient=0.3)
    own = dict(road, Sliding_speed=1) if friction else road
    text = "\n".join(["set Bodies = block, base", "set Contacts = rear, front" if listed else "",
                      "set Analyses = modal convolution", block(Loss_factor=0.02), section("base", "set Type = rigid"),
                      contacts,
                      section("Road", entries(**own)),
                      section("Modal convolution", entries(Time_step=5e-7, End_time=2e-4, Friction=str(friction).lower(),
                                                           Force_shape="constant"))])
    # forces that ring are of no concern here
    found, folder = run(name, text, ranks, may_doubt=True)
    return found["modal_convolution"], folder


for friction in (False, True):
    one, one_folder = on_patches(f"one_grid_{friction}", False, friction)
    check.near("nothing between the patches", one["impulse_Ns"][3], 0, 1e-300, 1)
    for ranks in (1, 2):
        two, folder = on_patches(f"two_grids_{friction}_{ranks}", True, friction, ranks)
        for key in ("impulse_Ns", "tangential_impulse_Ns")[:1 + friction]:
            apart = one[key][:3] + one[key][4:]
            size = max(abs(value) for value in one[key])
            for p, (a, b) in enumerate(zip(apart, two[key])):
                check.near(f"{key} of point {p}", b, a, 1e-10, size)
            check.near(f"{key} of the rear", two["contacts"]["rear"][key], sum(apart[:3]), 1e-10, size)
            check.near(f"{key} of the front", two["contacts"]["front"][key], sum(apart[3:]), 1e-10, size)
        check.near("both carry", min(two["contacts"][c]["impulse_Ns"] for c in ("rear", "front")) > 0.1 * sum(
            two["impulse_Ns"]), True, 1e-9)
        check.near("rms of the force", two["rms_force_N"], one["rms_force_N"], 1e-10)

# two points of a bar with two laws, against the transient of the same file
down = 2e-4
material = section("Material", entries(Young_modulus=70e9, Density=2700))
text = "\n".join([
    "set Bodies = bar, floor, shelf", "set Contacts = foot, middle", "set Analyses = transient, modal convolution",
    section("bar", "set Type = bar", material,
            section("Bar", entries(Length=1, Section=25e-4, Divisions=12, Element_degree=1)),
            section("Modes", entries(Count=6, Stiffness_damping=1e-5))),
    section("floor", "set Type = rigid"), section("shelf", "set Type = rigid"),
    section("foot", entries(Bodies="bar, floor", Friction_coefficient=0, Normal_law="linear spring", Penalty_amplitude=2e8,
                            Penalty_exponent=1)),
    section("middle", entries(Bodies="bar, shelf", Friction_coefficient=0, Gap=4e-5, Origin="0, 0, 0.5",
                              Origin_on_body_2="0, 0, 0")),
    section("Contact", section("Solver", entries(Tolerance=1e-13))),
    section("Rolling", entries(Speed=0, Hub_displacement=down)),
    section("Road", entries(Indentation=down)),
    section("Transient", entries(Time_step=1e-6, End_time=4e-3, Initial_state="undeformed", Integrator="exact propagator")),
    section("Modal convolution", entries(Time_step=1e-6, End_time=4e-3, Force_shape="linear"))])
for ranks in (1, 2):
    # the rigid point of the middle rings a little after impacts
    found, folder = run(f"bar_{ranks}", text, ranks, may_doubt=True)
    for name in ("foot", "middle"):
        check.near(f"impulse of {name}", found["modal_convolution"]["contacts"][name]["impulse_Ns"],
                   found["transient"]["contacts"][name]["impulse_Ns"], 1e-10)
check.near("the middle carries more", found["transient"]["contacts"]["middle"]["impulse_Ns"] > 100, True, 1e-9)
check.end()

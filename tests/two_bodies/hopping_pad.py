#!/usr/bin/env python3
"""hopping_pad.py PROGRAM MPIRUN: a pad on a suspended hub that rocks and hops on a plane that slides.

In flight it turns about the edge that is nearest to the plane: points that are far from it come down, fast, while those that are nearby hardly
move. No touch is missed, so the energy is accounted for.
"""
from scene import Check, entries, run, section

check = Check()


def scene(spacing):
    return "\n".join([
        "set Bodies = pad, plane", "set Analyses = transient",
        section("pad", "set Type = block", section("Material", entries(Young_modulus=70e9, Poisson_ratio=0.33, Density=2700)),
                section("Block", entries(Length=0.03, Width=0.02, Height=0.04, Divisions_x=6, Divisions_y=4, Divisions_z=6, Held="top",
                                         Contact_face="bottom")),
                section("Modes", entries(Count=6))),
        section("plane", "set Type = rigid"),
        section("Contact", entries(Friction_coefficient=0.7, Grid_spacing=spacing, Half_length=15e-3, Half_width=10e-3)),
        section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Normal_force=3000, Hub="suspended"),
                section("Suspension", entries(Unsprung_mass=0.5, Stiffness_x=1e6, Stiffness_y=1e6, Stiffness_z=1e6))),
        section("Transient", entries(Time_step=2e-7, End_time=1.9e-3, Error_estimate="false", Perturbed_mode="pad:mode 2",
                                     Perturbation_velocity=0.25))])


# 12 points, all of which are nearby always, and 24
for spacing in (7.5e-3, 5e-3):
    energy = run(f"hop_{spacing}", scene(spacing), may_doubt=True)[0]["transient"]["energy"]
    check.near(f"energy that is not accounted for, {spacing} m", energy["imbalance_J"], 0, 1e-4, energy["stored_J"])

check.end()

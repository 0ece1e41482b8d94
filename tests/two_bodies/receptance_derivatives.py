#!/usr/bin/env python3
"""receptance_derivatives.py PROGRAM MPIRUN PARAMETER_FILES: derivatives of receptances at a contact against what they have to be.

Receptances are 1 / (stiffness - w^2 mass), so that over all stiffnesses and densities p of both bodies

    sum of p dG/dp = -G,

and a material knows E (1 + j eta) alone: dG/deta = j E / (1 + j eta) dG/dE.
"""
from scene import Check, entries, run, section, table

check = Check()
E, rho, eta = 2.1e11, 7800., 0.1
young, loss = [f"wheel/Material/{entry}" for entry in ("Young modulus", "Loss factor")]
values = {f"{body}/Material/{entry}": value for body in ("wheel", "rail") for entry, value in (("Young modulus", E), ("Density", rho))}
values.update({f"rail/Beam rail/Pad stiffness {axis}": value for axis, value in (("x", 36e6), ("y", 40e6), ("z", 180e6))})
undamped = {f"Damping ratio {n}": 0 for n in ("0 nodal diameters", "1 nodal diameter", "2 nodal diameters")}
found, folder = run("receptance_derivatives", "\n".join([
    "set Bodies = wheel, rail", "set Analyses = stability",
    section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Harmonics=20)),
            section("Material", entries(Young_modulus=E, Density=rho, Loss_factor=eta)), section("Modes", entries(Upper_frequency=1200, **undamped))),
    section("rail", "set Type = beam rail", section("Material", entries(Young_modulus=E, Density=rho)),
            section("Beam rail", entries(Length=2.4, Pad_stiffness_x=36e6, Pad_stiffness_y=40e6, Pad_stiffness_z=180e6)),
            section("Modes", entries(Upper_frequency=1200))),
    section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2e-3, Half_length=10e-3, Half_width=8e-3, Lateral_position=-10e-3)),
    section("Rolling", entries(Hub_displacement=0.3e-3, Speed=10, Lateral_creepage=-0.01)),
    section("Stability", entries(Loss="hysteretic"), section("Derivatives", entries(Entries=", ".join([*values, loss]))))]))
of = {}
for row in table(folder, "receptance_derivatives.csv"):
    one = of.setdefault((row["frequency_Hz"], row["direction"]), {})
    one[row["entry"]] = complex(row["derivative_re_m_N"], row["derivative_im_m_N"])
    one["G"] = complex(row["receptance_re_m_N"], row["receptance_im_m_N"])
check.near("receptances", len(of) >= 6, True, 1e-9)
for (frequency, direction), one in of.items():
    text = f"{direction} at {frequency:.1f} Hz"
    parts = [value * one[entry] for entry, value in values.items()]
    check.near("by stiffness and density, " + text, abs(sum(parts) + one["G"]), 0, 1e-5, max(map(abs, parts)))
    check.near("by loss, " + text, abs(one[loss] - 1j * E / (1 + 1j * eta) * one[young]), 0, 1e-5, abs(E * one[young]))
check.end()

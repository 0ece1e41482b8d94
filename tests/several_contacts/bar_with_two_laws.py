#!/usr/bin/env python3
"""bar_with_two_laws.py PROGRAM MPIRUN PARAMETER_FILES: two points of one bar with two laws, by hand.

The bar, held at its top, is pressed by d on a linear spring k at its end and on a rigid stop, a gap g below it, at its
middle. With s = L / (2 E A), the compliance of each half:  N_end = k (d - s (N_mid + N_end) - s N_end),
d - g = s (N_mid + N_end). In time: the same forces from the equilibrium, which stays.
"""
from scene import Check, entries, run, section

E, A, L, k, d, g = 2.1e11, 1e-4, 0.5, 4e7, 1e-4, 2e-5
s = L / 2 / (E * A)
both = (d - g) / s
end = k * (d - s * both) / (1 + k * s)
check = Check()
text = "\n".join([
    "set Bodies = bar, floor, shelf", "set Contacts = foot, middle", "set Analyses = quasi-static rolling, transient",
    section("bar", "set Type = bar", section("Bar", entries(Length=L, Section=A, Divisions=8)),
            section("Material", entries(Young_modulus=E, Density=7800)),
            section("Modes", entries(Count=5))),
    section("floor", "set Type = rigid"), section("shelf", "set Type = rigid"),
    section("foot", entries(Bodies="bar, floor", Friction_coefficient=0, Normal_law="linear spring",
                            Penalty_amplitude=k, Penalty_exponent=1)),
    section("middle", entries(Bodies="bar, shelf", Friction_coefficient=0, Origin=f"0, 0, {L / 2}", Gap=g)),
    section("Contact", section("Solver", entries(Tolerance=1e-13))),
    section("Rolling", entries(Hub_displacement=d, Speed=0)),
    section("Transient", entries(Time_step=1e-6, End_time=1e-4))])
for ranks in (1, 2):
    found, _ = run(f"bar_{ranks}", text, ranks)
    rolling = found["quasi_static_rolling"]
    check.near("force at the end", rolling["contacts"]["foot"]["cases"][0]["normal_force_N"], end, 1e-9)
    check.near("force at the middle", rolling["contacts"]["middle"]["cases"][0]["normal_force_N"], both - end, 1e-9)
    check.near("force on the bar", rolling["cases"][0]["normal_force_N"], both, 1e-9)
    for name, force in (("foot", end), ("middle", both - end)):
        last = found["transient"]["contacts"][name]
        check.near(f"{name} in time", last["last"]["normal_force_N"], force, 1e-8)
        check.near(f"{name}, impulse", last["impulse_Ns"], force * 1e-4, 1e-8)
check.end()

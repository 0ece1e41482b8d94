#!/usr/bin/env python3
"""periodic_rail.py PROGRAM MPIRUN PARAMETER_FILES: a wheel by harmonics on a rail without ends.

The roots are those of the rail's exact receptance: those of other poles near it, from which they are sought, end at the same. One
rank and two give the same. The rail gives way as the elastic one does, whatever poles stand for it.
"""
import json
import math

from scene import Check, entries, run, section, table

check = Check()


def wheel(name, pairs, ranks=1, **rolling):
    text = "\n".join([
        "set Bodies = wheel, rail", "set Analyses = quasi-static rolling, stability",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2)),
                section("Modes", entries(Upper_frequency=4000))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Contact_at="support", Pole_pairs=pairs))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=10, Lateral_creepage=-0.01, **rolling)),
        section("Stability", entries(Loss="hysteretic"))])
    return run(name, text, ranks, may_doubt=True)


(one, folder), (other, folder_o) = wheel("few_pairs", 24), wheel("more_pairs", 32)
(two, folder_2) = wheel("two_ranks", 24, 2)


def force(found):
    return found["quasi_static_rolling"]["cases"][-1]["normal_force_N"] if "cases" in found["quasi_static_rolling"] else found[
        "quasi_static_rolling"]["normal_force_N"]


def nearest(folder, count):
    """The roots next to instability, which the exact receptance has."""
    rows = [row for row in table(folder, "stability.csv") if row["frequency_Hz"] > 0]
    rows.sort(key=lambda row: row["growth_1_s"] / row["frequency_Hz"], reverse=True)
    return sorted(rows[:count], key=lambda row: row["frequency_Hz"])


check.near("force on two ranks", force(two), force(one), 1e-10)
check.near("force with other poles", force(other), force(one), 1e-9)
check.near("loss", one["stability"]["loss"] == "hysteretic", True, 1e-9)
unstable = sum(row["growth_1_s"] > 0 for row in nearest(folder, 6))
check.near("axial (0,2) and (0,3) grow", unstable >= 2, True, 1e-9)
for a, b, c in zip(nearest(folder, 6), nearest(folder_o, 6), nearest(folder_2, 6)):
    size = 2 * math.pi * a["frequency_Hz"]
    check.near("frequency with other poles", b["frequency_Hz"], a["frequency_Hz"], 1e-7)
    check.near("growth with other poles", b["growth_1_s"], a["growth_1_s"], 1e-7, size)
    check.near("frequency on two ranks", c["frequency_Hz"], a["frequency_Hz"], 1e-9)
    check.near("growth on two ranks", c["growth_1_s"], a["growth_1_s"], 1e-9, size)
check.end()

#!/usr/bin/env python3
"""wheel_responses.py PROGRAM MPIRUN PARAMETER_FILES: frequency responses of a wheel by harmonics that turns, and of one with dampers.

One rank and two give the same, modes the same as direct solutions. The peak of a pair of modes becomes those of two waves,
n V / (2 pi r) to either side, and the tables have both directions of each transfer. An absorber tuned to a mode takes its peak.
"""
import math

from scene import Check, entries, run, section, table

check = Check()
SPEED, RADIUS = 20, 0.46


def wheel(name, ranks=1, shape={}, dampers="", **response):
    text = "\n".join([
        "set Bodies = wheel", "set Analyses = modes, frequency response",
        section("wheel", "set Type = wheel",
                section("Wheel", entries(Model="harmonics", Element_degree=2, Harmonics=8, **shape), dampers),
                section("Modes", entries(Upper_frequency=700))),
        section("Frequency response", entries(Points="side: 0, 0, y; tread: 0.1, 0, z", Quantity="receptance",
                                              Check_frequencies="150, 300, 420", **response)),
        section("Rolling", entries(Speed=SPEED)) if "Rotation" in shape else ""])
    found, folder = run(name, text, ranks)
    return found["frequency_response"]["bodies"]["wheel"], folder


def value(row, response, force):
    return complex(*(row[f"{response}_{force}_{part}_m_N"] for part in ("real", "imag")))


def same(what, folders, pairs):
    for a, b in zip(*(table(folder, "frequency_response_wheel.csv") for folder in folders)):
        for i, j in pairs:
            size = math.sqrt(abs(value(a, i, i)) * abs(value(a, j, j)))
            check.near(f"{what}: {i} under {j}", abs(value(b, i, j) - value(a, i, j)), 0, 1e-9, size)


def modes_are_direct(found, tolerance):
    for each in found["checks"]:
        if each["method"] == "hysteretic":
            check.near(f"{each['response']} under {each['force']}, modes against direct solutions", each["error"], 0, tolerance, 1)


ALL = [(i, j) for i in ("side_y", "tread_z") for j in ("side_y", "tread_z")]
near_pair = dict(First_frequency=300, Last_frequency=370, Number_of_frequencies=60, Refined_frequencies=80)
still, folder = wheel("still", **near_pair)
(turning, folder_t), (_, folder_2) = [wheel(f"turning_{n}", n, dict(Rotation="true"), **near_pair) for n in (1, 2)]
same("two ranks", (folder_t, folder_2), ALL)
modes_are_direct(still, 2e-3)
modes_are_direct(turning, 2e-3)
check.near("rotation", turning["rotation_rad_s"], SPEED / RADIUS, 2e-3)
check.near("no rotation", "rotation_rad_s" in still, False, 1e-9, 1)
peaks, = [[m["frequency_Hz"] for m in still["maxima"] if m["point"] == "side_y"]]
waves = [m["frequency_Hz"] for m in turning["maxima"] if m["point"] == "side_y"]
check.near("peaks of a pair and of two waves", (len(peaks), len(waves)) == (1, 2), True, 1e-9)
# an axial pattern is carried along but for the little that it lags
check.near("two waves", waves[-1] - waves[0], 2 * 2 * SPEED / (2 * math.pi * RADIUS), 0.05)
check.near("their middle", (waves[-1] + waves[0]) / 2, peaks[0], 2e-3)
rows, at_rest = table(folder_t, "frequency_response_wheel.csv"), table(folder, "frequency_response_wheel.csv")
check.near("both directions while it turns", "tread_z_side_y_real_m_N" in rows[0], True, 1e-9)
check.near("one direction at rest", "tread_z_side_y_real_m_N" in at_rest[0], False, 1e-9, 1)
lost = max(abs(value(row, *ALL[1]) - value(row, *ALL[2])) / math.sqrt(abs(value(row, "side_y", "side_y") * value(row, "tread_z", "tread_z")))
           for row in rows)
check.near("reciprocity is lost", lost > 0.1, True, 1e-9)

# dampers: absorbers couple waves, a ring does not, a layer is loss
absorbers = section("Damper", section("blocks", entries(Mass=1, Frequency=round(peaks[0], 1), Loss_factor=0.1, Axial_position=0.06, Radius=0.40, Number=4)),
                    section("rim", entries(Kind="ring", Mass=5, Axial_position=0.06, Radius=0.40)),
                    section("sheet", entries(Kind="layer", Loss_factor=0.005, Inner_radius=0.38)))
(damped, folder_d), (_, folder_d2) = [wheel(f"damped_{n}", n, dict(Dampers="blocks, rim, sheet"), absorbers, **near_pair) for n in (1, 2)]
same("dampers on two ranks", (folder_d, folder_d2), [ALL[0], ALL[1], ALL[3]])
modes_are_direct(damped, 2e-3)
for each in damped["checks"]:
    if each["method"] == "time domain" and each["frequency_Hz"] == 150:
        check.near("the damped wheel's modes against direct solutions", each["error"], 0, 0.05, 1)
highest = [max(abs(value(row, "side_y", "side_y")) for row in table(f, "frequency_response_wheel.csv")) for f in (folder, folder_d)]
check.near("absorbers take the peak", highest[1] < 0.1 * highest[0], True, 1e-9)
check.end()

#!/usr/bin/env python3
"""turning_block.py PROGRAM MPIRUN PARAMETER_FILES: a block that hardly turns, in every analysis that takes Coriolis forces.

By poles it does what it does by real modes without them: rolling, stability, transient, modal convolution, periodic motion. At
a speed that matters one rank and two agree.
"""
from scene import Check, entries, run, section, table

check = Check()


def block(face, held, coriolis, speed=1e-3, axis="0, 0, 1", modes=entries(Count=6, Stiffness_damping=1e-7)):
    return "\n".join(["set Type = block", section("Material", entries(Loss_factor=0.01)),
                      section("Block", entries(Length=0.08, Width=0.08, Height=0.04, Divisions_x=4, Divisions_y=4,
                                               Divisions_z=1, Contact_face=face, Held=held)),
                      section("Rotation", entries(Speed=speed, Coriolis=coriolis, Axis=axis)),
                      section("Modes", modes)])


def rolled(name, coriolis, speed=1e-3, ranks=1):
    text = "\n".join([
        "set Bodies = upper, lower", "set Analyses = quasi-static rolling, stability, transient",
        section("upper", "set Type = half-space", section("Half-space", entries(Radius_x=10, Radius_y=10))),
        section("lower", block("top", "bottom", coriolis, speed)),
        section("Contact", entries(Grid_spacing=0.01, Half_length=0.03, Half_width=0.03, Friction_coefficient=0.3)),
        section("Rolling", entries(Hub_displacement=1e-5, Speed=10, Lateral_creepage=0.01)),
        section("Transient", entries(Time_step=2e-6, End_time=1e-4, Lateral_creepage="0.01+0.005*t/2e-5"))])
    found, folder = run(name, text, ranks, "--set", f"Output/Cache directory=cache_{ranks}", may_doubt=True)
    return found, table(folder, "stability.csv")


def same(what, one, two, tolerance):
    for k in range(2):
        check.near(what + ", rolling", *(a["quasi_static_rolling"]["cases"][0]["tangential_force_N"][k] for a in (one[0], two[0])),
                   tolerance)
    check.near(what + ", transient", one[0]["transient"]["impulse_Ns"], two[0]["transient"]["impulse_Ns"], tolerance)
    check.near(what + ", number of roots", len(one[1]), len(two[1]), 1e-9)
    for a, b in zip(one[1], two[1]):
        scale = abs(complex(b["frequency_Hz"], b["growth_1_s"]))
        for part in ("frequency_Hz", "growth_1_s"):
            check.near(what + ", root", a[part], b[part], tolerance, scale)


same("hardly turning", rolled("hardly", "true"), rolled("real", "false"), 1e-8)
fast = rolled("fast", "true", 4000)
same("two ranks", rolled("fast_2", "true", 4000, 2), fast, 1e-8)
without = rolled("fast_real", "false", 4000)
if not abs(fast[1][0]["frequency_Hz"] / without[1][0]["frequency_Hz"] - 1) > 1e-3:
    check.near("Coriolis forces are felt", 0, 1, 0)


def alone(name, coriolis, analysis, *sections):
    text = "\n".join(["set Bodies = block" + (", stop" if analysis == "periodic" else ""), "set Analyses = " + analysis,
                      section("block", block("bottom", "top", coriolis, axis="0, 1, 0")), *sections])
    return run(name, text)[0]


def receptances(name, coriolis, speed, ranks=1, method="modal"):
    text = "\n".join(["set Bodies = block", "set Analyses = frequency response",
                      section("block", block("bottom", "top", coriolis, speed, "0, 1, 0", entries(Count=40))),
                      section("Frequency response", entries(Points="a: 0.02, 0.02, 0, z; b: 0.02, 0, 0, x", First_frequency=2000,
                                                            Last_frequency=9000, Number_of_frequencies=4, Method=method))])
    found, folder = run(name, text, ranks, "--set", f"Output/Cache directory=cache_{ranks}")
    return table(folder, "frequency_response_block.csv")


def mobilities(row):
    """Complex mobilities of a row by <response>_<force>."""
    return {key[:-len("_real_m_Ns")]: complex(row[key], row[key.replace("real", "imag")]) for key in row if key.endswith("_real_m_Ns")}


def same_mobilities(what, one, two, tolerance):
    for row, other in zip(one, two):
        row, other = mobilities(row), mobilities(other)
        scale = max(map(abs, other.values()))
        for key in row.keys() & other.keys():
            check.near(f"{what}, {key}", abs(row[key] - other[key]), 0, tolerance, scale)


same_mobilities("hardly turning", receptances("shaken_hardly", "true", 1e-3), receptances("shaken_real", "false", 1e-3), 1e-6)
turning, other_sense = receptances("shaken", "true", 4000), receptances("shaken_back", "true", -4000)
same_mobilities("two ranks", turning, receptances("shaken_2", "true", 4000, 2), 1e-8)
same_mobilities("modes beside all dofs", turning, receptances("shaken_direct", "true", 4000, 1, "direct"), 1e-3)
same_mobilities("all dofs, two ranks", receptances("shaken_direct_2", "true", 4000, 2, "direct"),
                receptances("shaken_direct", "true", 4000, 1, "direct"), 1e-8)
# what one sense does from a to b the other does from b to a
for row, back in zip(map(mobilities, turning), map(mobilities, other_sense)):
    check.near("reciprocity", abs(row["a_z_b_x"] - back["b_x_a_z"]), 0, 1e-8, abs(row["a_z_b_x"]))
    if abs(row["a_z_b_x"] - row["b_x_a_z"]) < 1e-3 * abs(row["a_z_b_x"]):
        check.near("Coriolis forces are felt", 0, 1, 0)


grid = section("Contact", entries(Grid_spacing=0.01, Half_length=0.01, Half_width=0.01))
road = [grid, section("Road", entries(Profile="expression", Expression="1e-6*sin(2*pi*s/0.05)", Speed=100, Indentation=1e-6,
                                      Loading_time=1e-5)),
        section("Modal convolution", entries(Time_step=1e-6, End_time=1e-4))]
impulses = [alone("road_" + c, c, "modal convolution", *road)["modal_convolution"]["impulse_Ns"] for c in ("true", "false")]
for a, b in zip(*impulses):
    check.near("modal convolution", a, b, 1e-8, max(map(abs, impulses[1])))
stop = [section("stop", "set Type = rigid"), section("Contact", entries(Friction_coefficient=0)),
        section("Periodic", entries(Number_of_functions=31, Frequency=5000, Force=1e4, Gap=1e-8, Stop_direction="-z", Law="signorini",
                                    Contact_points="corner: 0.04, 0.04, 0"))]
motions = [alone("stop_" + c, c, "periodic", *stop)["periodic"][0] for c in ("true", "false")]
for key in ("tip_max_m", "tip_min_m"):
    check.near("periodic motion", motions[0][key], motions[1][key], 1e-8)
check.end()

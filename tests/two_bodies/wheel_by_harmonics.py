#!/usr/bin/env python3
"""wheel_by_harmonics.py PROGRAM MPIRUN PARAMETER_FILES: a wheel wave by wave around its axle, on a rigid crown.

One rank and two give the same. The wheel of solid elements with the same section has the same equilibrium, modes and roots,
as far as its coarse cells around the axle let it; its transient is that of the same growing motion. Receptances by modes are those of
direct solutions, and those of the solid wheel.
"""
import math

from scene import Check, entries, run, section, table

check = Check()


def wheel(name, model, ranks=1, analyses="modes, frequency response, quasi-static rolling, stability, transient", **more):
    shape = dict(Model=model, Element_degree=2, **more)
    if model == "solid":
        shape.update(Contact_division=0.014, Coarse_division=0.15, Growth=4)
    else:
        shape.setdefault("Harmonics", 20)
    response = dict(Points="tread: 0, 0, z; side: 0, 0, y; along: 0, 0, x; behind: 0.1, 0, z; web: 0.2, -0.015, 0.259, y",
                    Frequencies="60, 100, 165, 250, 420", Quantity="receptance")
    if model == "harmonics":
        response["Check_frequencies"] = "150, 510"
    text = "\n".join([
        "set Bodies = wheel, crown", f"set Analyses = {analyses}",
        section("wheel", "set Type = wheel", section("Wheel", entries(**shape)),
                section("Loads", entries(Gravity=9.81)), section("Modes", entries(Upper_frequency=700))),
        section("crown", "set Type = rigid", section("Rigid", entries(Radius_y=0.3))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2e-3, Lateral_position=15e-3)),
        section("Frequency response", entries(**response)) if "response" in analyses else "",
        section("Rolling", entries(Hub_displacement=0.05e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Transient", entries(Time_step=4e-6, End_time=1e-3), section("Signals", entries(Table="true"))) if "transient" in analyses else ""])
    return run(name, text, ranks, may_doubt=True)


(one, folder), (two, folder_2) = wheel("one_rank", "harmonics"), wheel("two_ranks", "harmonics", 2)
(solid, folder_s) = wheel("solid", "solid", 2)


def force(found):
    return found["quasi_static_rolling"]["cases"][-1]["normal_force_N"] if "cases" in found["quasi_static_rolling"] else found[
        "quasi_static_rolling"]["normal_force_N"]


check.near("force on two ranks", force(two), force(one), 1e-10)
check.near("force of solid elements", force(solid), force(one), 0.01)
for a, b in zip(table(folder, "stability.csv"), table(folder_2, "stability.csv")):
    size = 2 * math.pi * a["frequency_Hz"]
    check.near("frequency on two ranks", b["frequency_Hz"], a["frequency_Hz"], 1e-9)
    check.near("growth on two ranks", b["growth_1_s"], a["growth_1_s"], 1e-9, size)
modes = [table(f, "modes_wheel.csv") for f in (folder, folder_s)]
check.near("number of modes", len(modes[1]), len(modes[0]), 1e-9)
for a, b in zip(*modes):
    check.near("a mode's frequency", b["frequency_Hz"], a["frequency_Hz"], 2e-3)
    check.near("its damping", b["damping_ratio"], a["damping_ratio"], 1e-9)
    check.near(f"{a['label']} by name", b["label"].split("#")[0] == a["label"].split("#")[0], True, 1e-9)
def direct_checks(found):
    return [c for c in found["frequency_response"]["bodies"]["wheel"]["checks"] if c["method"] == "hysteretic"]


roots = [table(f, "stability.csv") for f in (folder, folder_s)]
check.near("number of roots", len(roots[1]), len(roots[0]), 1e-9)
for a, b in zip(*roots):
    if a["growth_1_s"] > -0.02 * 2 * math.pi * a["frequency_Hz"]:
        check.near("a root's frequency", b["frequency_Hz"], a["frequency_Hz"], 3e-3)
        check.near("its growth", b["growth_1_s"], a["growth_1_s"], 3e-3, 2 * math.pi * a["frequency_Hz"])
histories = [table(f, "histories.csv") for f in (folder, folder_s)]
for a, b in list(zip(*histories))[::20]:
    check.near("normal force in time", b["normal_force_N"], a["normal_force_N"], 0.01)
responses = [table(f, "frequency_response_wheel.csv") for f in (folder, folder_2, folder_s)]
for row, row_2, row_s in zip(*responses):
    def of(values, response, force):
        return complex(*(values[f"{response}_{force}_{part}_m_N"] for part in ("real", "imag")))

    for words in (key.split("_") for key in row if key.endswith("_real_m_N")):
        a, b = "_".join(words[:2]), "_".join(words[2:4])
        # of transfers the geometric mean of both driving points
        size = math.sqrt(abs(of(row, a, a)) * abs(of(row, b, b)))
        check.near(f"{a} under {b} on two ranks", abs(of(row_2, a, b) - of(row, a, b)), 0, 1e-9, size)
        # the node of a web is another one there, up to half a cell around the axle away
        if "web" not in a + b:
            check.near(f"{a} under {b} of solid elements at {row['frequency_Hz']} Hz", abs(of(row_s, a, b) - of(row, a, b)), 0, 0.05, size)
for each in direct_checks(one):
    check.near("modes against a direct solution", each["error"], 0, 2e-3, 1)
# more waves move the force by what is left out
more = wheel("more_waves", "harmonics", 1, "quasi-static rolling, stability", Harmonics=120)[0]
check.near("force with more waves", force(more), force(one), 2e-3)
check.end()

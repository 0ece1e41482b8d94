#!/usr/bin/env python3
"""periodic_rail.py PROGRAM MPIRUN PARAMETER_FILES: a wheel by harmonics on a rail without ends.

The roots are those of the rail's exact receptance: those of other poles near it, from which they are sought, end at the same. One
rank and two give the same. The rail gives way as the elastic one does, whatever poles stand for it. Limit cycles are the same by steps of
time and by harmonics.
"""
import json
import math

from scene import Check, entries, run, section, table

check = Check()


def wheel(name, pairs, ranks=1, contact={"Contact_at": "support"}, sweep=(), march=0, swept_entry="rail/Rail/Contact offset",
          friction=0.3, cycles=False):
    swept = [section("Sweep", f"set Entry = {swept_entry}", f"set Values = {', '.join(map(str, sweep))}")] if sweep else []
    analyses = "limit cycle" if cycles else "transient" if march else "stability" if sweep else "quasi-static rolling, stability"
    text = "\n".join([
        "set Bodies = wheel, rail", "set Analyses = " + analyses,
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2)),
                section("Modes", entries(Upper_frequency=4000))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Pole_pairs=pairs, **contact))),
        section("Contact", entries(Friction_coefficient=friction, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Limit cycle", entries(Time_step=5e-6, Roots=920, Harmonics="5, 20")) + "\n" +
        section("Transient", entries(Integrator="exact propagator")) if cycles
        else section("Transient", entries(Time_step=1e-5, End_time=march, Perturbed_mode="wheel:axial(0,2)", Perturbation=1e-9)) if march
        else section("Stability", entries(Loss="hysteretic"), *swept)])
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


# in time: poles that take energy at all frequencies, right about the roots that grow; what starts grows as they do
moving, folder_t = wheel("in_time", 24, march=0.03)
with open(f"{folder_t}/results.json", encoding="utf-8") as file:
    fit = json.load(file)["reductions"]["rail"]["fit"]["in_time"]
check.near("passive", fit["passive"], True, 1e-9)
check.near("error in the bands below 1.5 %", fit["worst_error_in_bands"] < 0.015, True, 1e-9)
roots = moving["transient"]["roots_beside_rail"]
check.near("roots that grow", len(roots), sum(row["growth_1_s"] > 0 for row in nearest(folder, 6)), 1e-9)
for root in roots:
    check.near(f"growth of {root['label']} in time", root["growth_in_time_1_s"], root["growth_1_s"], 0.03)
check.near("the equilibrium holds", moving["transient"]["impulse_Ns"] / 0.03, force(one), 1e-4)
energy = moving["transient"]["energy"]
check.near("energy imbalance", energy["imbalance_J"], 0, 1e-3, energy["friction_J"])

# where the fastest root ends, without time going by, with poles in time as well, on one rank and on two; with few points of 2.5 mm,
# longer steps may miss the bound on a disturbance along the motion
for ranks in (1, 2):
    search, _ = wheel(f"cycle_{ranks}", 16, ranks, cycles=True)
    cycle = search["limit_cycle"][0]
    if ranks == 1:
        alone = cycle
    check.near("cycle on two ranks", cycle["frequency_Hz"], alone["frequency_Hz"], 1e-9)
    check.near("its amplitude on two ranks", cycle["amplitude_m_s"], alone["amplitude_m_s"], 1e-6)
check.near("the cycle has the pitch of its root", cycle["frequency_Hz"], cycle["root"]["frequency_Hz"], 3e-3)
check.near("it is louder than nothing", cycle["amplitude_m_s"] > 1e-3, True, 1e-9)
check.near("trivial multiplier", cycle["stability"]["trivial_multiplier_error"], 0, 1e-3, 1)
for balanced, of_frequency, of_first in zip(cycle["harmonic_balance"], (5e-4, 1e-4), (0.03, 0.02)):
    check.near(f"frequency by {balanced['harmonics']} harmonics", balanced["frequency_difference"], 0, of_frequency, 1)
    check.near(f"first harmonic by {balanced['harmonics']} harmonics", balanced["first_harmonic_difference"], 0, of_first, 1)
check.near("roots beside the rail", len(search["limit_cycle_search"]["roots_beside_rail"]) > 0, True, 1e-9)

# a root that hardly grows is too much for few poles: the march is kept, but its result is refused
_, folder_f = wheel("too_few_pairs", 5, march=1e-4, friction=0.283)
with open(f"{folder_f}/results.json", encoding="utf-8") as file:
    refused = json.load(file).get("not_converged", [])
check.near("too few poles are refused", any("change the rail's Pole pairs" in one["message"] for one in refused), True, 1e-9)

# each case of a sweep over the pairs has poles of its own
pairs, folder_p = wheel("swept_pairs", 24, sweep=[24, 32], swept_entry="rail/Rail/Pole pairs")
for case, alone in enumerate((folder, folder_o)):
    by_poles, expected = [sorted(row["growth_1_s"] for row in table(f, "stability.csv") if row["case"] == number and row["receptance"] == "poles")
                          for f, number in ((folder_p, case), (alone, 0))]
    check.near("roots by poles", len(by_poles), len(expected), 1e-9)
    for a, b in zip(by_poles, expected):
        check.near("growth by poles of its own", a, b, 1e-9, 1e4)

# a contact half a span beyond mid-span stands over a support
offset, _ = wheel("offset", 24, contact={"Contact_at": "mid-span", "Contact_offset": 0.3})
found = sorted(root["growth_1_s"] for root in offset["stability"]["unstable"])
over_support = sorted(root["growth_1_s"] for root in one["stability"]["unstable"])
check.near("growth with an offset", sum(abs(a - b) for a, b in zip(found, over_support)), 0, 1e-6)
check.near("number with an offset", len(found), len(over_support), 1e-9)

# the contact moves along the tread, not on the crown; near the flange the wheel has fewer points in contact than the rail
lateral, _ = wheel("lateral", 24, sweep=[-17.5e-3, -10e-3], swept_entry="Contact/Lateral position")
cases = [sorted(root["growth_1_s"] for root in case["unstable"]) for case in lateral["stability"]["cases"]]
check.near("number of roots that grow", len(cases[1]), len(over_support), 1e-9)
for a, b in zip(cases[1], over_support):
    # cells are halved along the whole band: others than under one contact
    check.near("growth in a sweep of the lateral position", a, b, 5e-4, max(over_support))
check.near("growth nearer the flange", max(cases[0]) > 1.2 * max(cases[1]), True, 1e-9)
# the mean over the sweep is that of its cases
paths = [{root["root"]: root["growth_1_s"] for root in case["unstable"]} for case in lateral["stability"]["cases"]]
means = {root["root"]: root["growth_1_s"] for root in lateral["stability"]["mean_growth"]}
both = [path for path in paths[0] if path in paths[1]]
check.near("paths that grow in both cases", len(both) > 0, True, 1e-9)
for path in both:
    check.near("mean growth", means[path], (paths[0][path] + paths[1][path]) / 2, 1e-12)
check.end()

#!/usr/bin/env python3
"""limit_cycle.py PROGRAM MPIRUN PARAMETER_FILES: the limit cycle of a pad that slides on a plane, from its unstable root.

A march in time with the same steps settles on the same motion. One rank and two agree. A sweep over the friction has a row per
case, also where nothing grows; what is not taken is refused.
"""
import math, os, subprocess, sys
from scene import Check, entries, program, run, section, table

check = Check()


def scene(analyses, *sections, friction=0.7, hub="held"):
    return "\n".join([
        "set Bodies = pad, plane", f"set Analyses = {analyses}",
        section("pad", "set Type = block", section("Material", entries(Young_modulus=70e9, Poisson_ratio=0.33, Density=2700)),
                section("Block", entries(Length=0.03, Width=0.02, Height=0.04, Divisions_x=6, Divisions_y=4, Divisions_z=6, Held="top",
                                         Contact_face="bottom")),
                section("Modes", entries(Count=6))),
        section("plane", "set Type = rigid"),
        section("Contact", entries(Friction_coefficient=friction, Grid_spacing=5e-3, Half_length=15e-3, Half_width=10e-3)),
        section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Hub_displacement=2e-6, Hub=hub)), *sections])


PROBES = section("Transient", section("Signals", entries(Probes="side: pad 0.015 0 0.005 along x")))
STEPS = section("Limit cycle", entries(Time_step=1e-7))
BALANCED = section("Limit cycle", entries(Time_step=1e-7, Multipliers=0, Harmonics="1, 5, 20"))
found, folder = run("cycle", scene("limit cycle", STEPS, PROBES))
cycle = found["limit_cycle"][0]
check.near("cycles", len(found["limit_cycle"]), 1, 1e-12)
check.near("residual", cycle["residual"], 0, 1e-9, 1)
check.near("trivial multiplier", cycle["stability"]["trivial_multiplier_error"], 0, 1e-4, 1)
check.near("stable", cycle["stable"], True, 1e-12)
check.near("amplitude", cycle["amplitude_m_s"], next(one for one in cycle["signals"] if one["name"] == "side_velocity_m_s")["amplitude"], 1e-12)
check.near("start", cycle["start"] == "pad:mode 2", True, 1e-12)
check.near("what Newton's method began from", cycle["started_by"] in ("harmonic balance", "a few periods"), True, 1e-12)

# powers over a period: what the motion of the plane brings is taken by friction and by the damping of the modes
check.near("power", cycle["creepage_power_W"], cycle["friction_power_W"], 0.02)

two = run("cycle_2", scene("limit cycle", STEPS, PROBES), 2)[0]["limit_cycle"][0]
for key in ("frequency_Hz", "friction_power_W"):
    check.near("two ranks, " + key, two[key], cycle[key], 1e-9)
check.near("two ranks, growth", two["multipliers"][0]["growth_1_s"], cycle["multipliers"][0]["growth_1_s"], 1e-6)

# harmonic balance, a second way to the same motion: the more harmonics the nearer, the same on two ranks
by_balance, folder_of_balance = run("balanced", scene("limit cycle", BALANCED, PROBES))
by_balance = by_balance["limit_cycle"][0]["harmonic_balance"]
check.near("numbers of harmonics", [one["harmonics"] for one in by_balance] == [1, 5, 20], True, 1e-12)
for one, of_frequency, of_first in zip(by_balance, (2e-2, 1e-3, 1e-4), (0.3, 3e-2, 1e-2)):
    check.near(f"frequency by {one['harmonics']} harmonics", one["frequency_Hz"], cycle["frequency_Hz"], of_frequency)
    check.near(f"first harmonic by {one['harmonics']}", one["first_harmonic"],
               next(signal for signal in cycle["signals"] if signal["name"] == one["signal"])["first_harmonic"], of_first)
rows = [line for line in open(os.path.join(folder_of_balance, "limit_cycle_harmonic_balance.csv")) if line.startswith("1,")]
check.near("rows of the table", [row.split(",")[1:3] for row in rows] == [["1", "converged"], ["5", "converged"], ["20", "converged"]], True, 1e-12)
on_two = run("balanced_2", scene("limit cycle", BALANCED, PROBES), 2)[0]["limit_cycle"][0]["harmonic_balance"]
for one, other in zip(on_two, by_balance):
    check.near("balanced on two ranks", one["frequency_Hz"], other["frequency_Hz"], 1e-9)

# what the steps change: near what a cycle in steps of a quarter says, the same on two ranks
quarter = run("quarter", scene("limit cycle", section("Limit cycle", entries(Time_step=2.5e-8, Error_estimate="false")), PROBES))[0]["limit_cycle"][0]
check.near("without an estimate", any("estimate" in key for key in quarter), False, 1e-12, 1)
# 4 / 3 of that in first order, 16 / 5 in second; here both matter
check.near("estimated error of the frequency", cycle["estimated_error_frequency"] / abs(cycle["frequency_Hz"] / quarter["frequency_Hz"] - 1), 2.2, 0.4)
# this amplitude is exact by chance: its error is said to be no less than half of that of all harmonics
check.near("estimated error", cycle["estimated_error_amplitude"] / abs(cycle["amplitude_m_s"] / quarter["amplitude_m_s"] - 1), 4, 0.7)
check.near("estimated error on two ranks", two["estimated_error_amplitude"], cycle["estimated_error_amplitude"], 1e-6)

# amplitudes of the table are those of the period
rows = table(folder, "limit_cycle_1.csv")
harmonics = table(folder, "limit_cycle_1_harmonics.csv")
steps = len(rows)
check.near("steps", steps, cycle["steps_per_period"], 1e-12)
force = [row["normal_force_N"] for row in rows]
first = abs(sum(f * complex(math.cos(2 * math.pi * k / steps), -math.sin(2 * math.pi * k / steps)) for k, f in enumerate(force))) * 2 / steps
check.near("first harmonic", harmonics[1]["normal_force_N"], first, 1e-10)

march = section("Transient", entries(Time_step=cycle["time_step_s"], End_time=0.02, Perturbed_mode="pad:mode 2", Perturbation_velocity=0.1,
                                     Error_estimate="false"),
                section("Signals", entries(Probes="side: pad 0.015 0 0.005 along x", Spectrum_duration=0.01)))
found, folder_of_march = run("march", scene("transient", march), may_doubt=True)
settled = found["transient"]
side = next(one for one in settled["signals"] if one["name"] == "side_velocity")
of_cycle = next(one for one in cycle["signals"] if one["name"] == "side_velocity_m_s")
check.near("frequency of the march", side["cycle"]["frequency_Hz"], cycle["frequency_Hz"], 1e-5)
check.near("amplitude of the march", side["cycle"]["amplitude"], of_cycle["amplitude"], 2e-3)

# the motion that a march ends with leads to the same cycle: from its folder, and, long before it has settled, in one file
FROM_MARCH = section("Limit cycle", entries(Time_step=1e-7, Start="end of transient", Transient_folder=folder_of_march))
IN_ONE = section("Limit cycle", entries(Time_step=1e-7, Start="end of transient"))
short = march.replace("set End time = 0.02", "set End time = 0.004").replace("set Spectrum duration = 0.01", "")
for name, text, ranks in (("from_march", scene("limit cycle", FROM_MARCH, PROBES), 1), ("in_one", scene("transient, limit cycle", IN_ONE, short), 2)):
    found = run(name, text, ranks, may_doubt=True)[0]
    check.near(name + ": cycles", len(found["limit_cycle"]), 1, 1e-12)
    check.near(name + ": start", found["limit_cycle"][0]["start"].startswith("end of transient"), True, 1e-12)
    check.near(name + ": began from", found["limit_cycle"][0]["started_by"] in ("harmonic balance", "the motion given"), True, 1e-12)
    check.near(name + ": frequency", found["limit_cycle"][0]["frequency_Hz"], cycle["frequency_Hz"], 1e-7)
    check.near(name + ": friction power", found["limit_cycle"][0]["friction_power_W"], cycle["friction_power_W"], 1e-6)

# nearly the trapezoidal rule of what the modes leave out: a fraction of the error, the same motion as that of a march, the same on two ranks
def by_residual_theta(theta, step, ranks=1):
    taken = section("Transient", entries(Residual_theta=theta), section("Signals", entries(Probes="side: pad 0.015 0 0.005 along x")))
    return run(f"theta_{theta}_{step}_{ranks}", scene("limit cycle", section("Limit cycle", entries(Time_step=step)), taken), ranks)[0]["limit_cycle"][0]


def side_of(one):
    return next(signal for signal in one["signals"] if signal["name"] == "side_velocity_m_s")["amplitude"]


fine = by_residual_theta(0.6, 5e-8)
backward, near_trapezoidal = cycle, by_residual_theta(0.6, 1e-7)
print(f"amplitude off by {side_of(backward) / side_of(fine) - 1:.2e}, with a residual theta of 0.6 by {side_of(near_trapezoidal) / side_of(fine) - 1:.2e}; "
      f"frequency {backward['frequency_Hz'] / fine['frequency_Hz'] - 1:.2e}, {near_trapezoidal['frequency_Hz'] / fine['frequency_Hz'] - 1:.2e}")
check.near("a fraction of the error", abs(side_of(near_trapezoidal) - side_of(fine)) < 0.3 * abs(side_of(backward) - side_of(fine)), True, 1e-12)
check.near("residual theta on two ranks", by_residual_theta(0.6, 1e-7, 2)["frequency_Hz"], near_trapezoidal["frequency_Hz"], 1e-9)
marched = march.replace("set End time", "set Residual theta = 0.6\nset End time").replace(
    f"set Time step = {cycle['time_step_s']}", f"set Time step = {near_trapezoidal['time_step_s']}")
by_theta = run("march_theta", scene("transient", marched), may_doubt=True)[0]["transient"]
side = next(one for one in by_theta["signals"] if one["name"] == "side_velocity")
check.near("amplitude of the march by residual theta", side["cycle"]["amplitude"], side_of(near_trapezoidal), 2e-3)
check.near("what the rate takes, 2 theta - 1 of that of backward differences", by_theta["energy"]["numerical_rate_J"] / settled["energy"]["numerical_rate_J"], 0.2, 0.1)

# basins need two cycles; what was found is kept
alone = scene("limit cycle", section("Limit cycle", entries(Time_step=1e-7), section("Basins", entries(Starts=1, Time_step=1e-7))))
with open("alone.prm", "w") as file:
    file.write(alone)
done = subprocess.run([program, "alone.prm", "--output", "alone"], capture_output=True, text=True)
check.near("basins of one cycle", done.returncode == 2 and "between two cycles, but one was found" in done.stdout, True, 1e-12)

swept = run("swept", scene("limit cycle", section("Limit cycle", entries(Time_step=1e-7, Multipliers=0),
                                                   section("Sweep", entries(Entry="Contact/Friction coefficient", Values="0.4, 0.7"))), PROBES))
rows = list(open(os.path.join(swept[1], "limit_cycle_sweep.csv")))
cases = swept[0]["limit_cycle_sweep"]["cases"]
check.near("nothing grows at 0.4", len(cases[0]["limit_cycle"]), 0, 1e-12)
check.near("the same in a sweep", cases[1]["limit_cycle"][0]["frequency_Hz"], cycle["frequency_Hz"], 1e-9)

# followed over the friction: its ends are those of the range, its points are cycles of their own, the same on two ranks
BRANCH = section("Limit cycle", entries(Time_step=1e-7), section("Branch", entries(Entry="Contact/Friction coefficient", Range="0.69, 0.71")))
followed, folder = run("branch", scene("limit cycle", BRANCH, PROBES))
branch = followed["limit_cycle"][0]["branch"]
points = branch["points"]
for end, value in (("begin", 0.69), ("end", 0.71)):
    check.near(end, branch[end]["value"], value, 1e-12)
    check.near(end + " at the range", branch[end]["kind"] == "end of the range", True, 1e-12)
check.near("points are in turn", [point["value"] for point in points] == sorted(point["value"] for point in points), True, 1e-12)
check.near("the first cycle is one of them", min(abs(point["frequency_Hz"] / cycle["frequency_Hz"] - 1) for point in points), 0, 1e-9, 1)
rows = table(folder, "limit_cycle_branch.csv")
check.near("rows of the table", len(rows), len(points), 1e-12)
last = run("at_the_end", scene("limit cycle", STEPS, PROBES, friction=0.71))[0]["limit_cycle"][0]
check.near("a cycle from its root", points[-1]["frequency_Hz"], last["frequency_Hz"], 1e-6)
check.near("amplitude from its root", rows[-1]["side_velocity_m_s_amplitude"],
           next(one for one in last["signals"] if one["name"] == "side_velocity_m_s")["amplitude"], 1e-5)
again = run("branch_2", scene("limit cycle", BRANCH, PROBES), 2)[0]["limit_cycle"][0]["branch"]["points"]
check.near("points on two ranks", len(again), len(points), 1e-12)
for one, other in zip(again, points):
    check.near("value on two ranks", one["value"], other["value"], 1e-9)
    check.near("frequency on two ranks", one["frequency_Hz"], other["frequency_Hz"], 1e-9)

# a map of one swept and the followed entry: what is followed from a swept value is what is followed from it alone
MAP = BRANCH.replace("set Entry = Contact/Friction coefficient", "set Entry = Rolling/Sliding velocity x").replace("0.69, 0.71", "0.095, 0.105").replace(
    "set Time step", "set Multipliers = 0\nset Time step")
MAP = MAP.rpartition("end")[0] + section("Sweep", entries(Entry="Contact/Friction coefficient", Values="0.69, 0.71")) + "\nend"
mapped, folder = run("map", scene("limit cycle", MAP, PROBES), 2)
cases = mapped["limit_cycle_sweep"]["cases"]
check.near("cases of the map", [case["status"] for case in cases] == ["converged", "converged"], True, 1e-12)
other_way = next(point for point in cases[1]["limit_cycle"][0]["branch"]["points"] if abs(point["value"] - 0.1) < 1e-12)
check.near("both ways meet", other_way["frequency_Hz"], points[-1]["frequency_Hz"], 1e-6)
drawn = subprocess.run([sys.executable, os.path.join(os.path.dirname(sys.argv[3]), "contrib", "plot_results.py"), folder]).returncode
without_matplotlib = drawn == 4
check.near("picture of the map", without_matplotlib or os.path.getsize(os.path.join(folder, "figures", "limit_cycle_map.png")) > 5000, True, 1e-12)

# fewer points than the range needs: said as such, with exit code 2
few = scene("limit cycle", BRANCH.replace("0.69, 0.71", "0.4, 0.9").replace("set Entry", "set Most points = 2\nset Entry"), PROBES)
with open("few.prm", "w") as file:
    file.write(few)
done = subprocess.run([program, "few.prm", "--output", "few"], capture_output=True, text=True)
check.near("most points", done.returncode == 2 and "Most points were found" in done.stdout, True, 1e-12)

# a pad that hardly turns moves by poles, and in the same cycle
below = scene("limit cycle", STEPS).replace("Bodies = pad, plane", "Bodies = plane, pad").replace("Held = top", "Held = bottom").replace(
    "Contact face = bottom", "Contact face = top")
turning = below.replace("set Type = block", "set Type = block\nsubsection Rotation\nset Speed = 1e-3\nend")
by_modes, by_poles = (run(name, text)[0]["limit_cycle"][0] for name, text in (("below", below), ("turning", turning)))
check.near("frequency of the turning pad", by_poles["frequency_Hz"], by_modes["frequency_Hz"], 1e-6)
check.near("friction power of the turning pad", by_poles["friction_power_W"], by_modes["friction_power_W"], 1e-3)
check.near("growth of disturbances", by_poles["multipliers"][0]["growth_1_s"], by_modes["multipliers"][0]["growth_1_s"], 1e-3)

suspended = scene("limit cycle", STEPS, hub="suspended").replace("set Hub = suspended", "set Hub = suspended\n" +
                                                                 section("Suspension", entries(Unsprung_mass=100, Stiffness_x=1e6, Stiffness_y=1e6, Stiffness_z=1e6)))
for name, text, said in (("suspended", suspended, "which does not take a hub with mass"),
                         ("other_root", scene("limit cycle", section("Limit cycle", entries(Time_step=1e-7, Roots=5000))), "are at 100"),
                         ("outside", scene("limit cycle", BRANCH, friction=0.5), "leaves out 0.5"),
                         ("no_speed", scene("limit cycle", BRANCH.replace("Contact/Friction coefficient", "Rolling/Spin").replace("0.69, 0.71", "-1, 1")),
                          "Rolling/Speed is 0"),
                         ("other_load", scene("limit cycle", BRANCH.replace("Contact/Friction coefficient", "Rolling/Normal force").replace("0.69, 0.71", "1, 9")),
                          "the load is Rolling/Hub displacement"),
                         ("negative", scene("limit cycle", BRANCH).replace("0.69, 0.71", "-0.1, 0.71"), "has to lie between 0 and 10"),
                         ("one_value", scene("limit cycle", BRANCH).replace("0.69, 0.71", "0.71, 0.69"), "two values, the smaller one first"),
                         ("no_transient", scene("limit cycle", FROM_MARCH.replace(folder_of_march, ".")), "has no checkpoint.h5"),
                         ("other_bodies", scene("limit cycle", FROM_MARCH).replace("set Count = 6", "set Count = 7"), "belongs to other bodies"),
                         ("not_listed", scene("limit cycle", IN_ONE), "lists no transient"),
                         ("basins_of_one", scene("transient, limit cycle", IN_ONE.replace("set Start", "subsection Basins\nset Starts = 1\nend\nset Start"), march),
                          "leads to one cycle"),
                         ("not_judged", alone.replace("set Starts", "set Longest time = 1\nset Starts").replace("set Time step = 1e-07\n", "set Time step = 1e-07\nset Multipliers = 0\n", 1),
                          "Multipliers is 0"),
                         ("too_short", alone.replace("set Starts", "set Longest time = 1e-3\nset Starts"), "known after 40 periods"),
                         ("coarse", alone.replace("set Time step = 1e-07\nend", "set Time step = 1e-4\nend"),
                          "more than an eighth of a period"),
                         ("no_friction", scene("limit cycle", STEPS, friction=0), "Friction coefficient is 0")):
    with open(name + ".prm", "w") as file:
        file.write(text)
    done = subprocess.run([program, name + ".prm", "--quiet", "--output", name], capture_output=True, text=True)
    check.near(name + ": " + done.stderr.strip(), done.returncode == 1 and said in done.stderr, True, 1e-12)
check.end()

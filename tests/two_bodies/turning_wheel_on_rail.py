#!/usr/bin/env python3
"""turning_wheel_on_rail.py PROGRAM MPIRUN PARAMETER_FILES: a wheel that turns on a rail without ends.

Hardly turning, and without damping, which the two settings mean differently, it has the roots of the wheel at rest. At 10 m/s the
roots are those of the rail's exact receptance: other poles to start from, and two ranks, end at the same. The two waves of a pair
grow by less than the pair, and stand apart by the rotation. Each wave has a limit cycle, the same by steps of time and by harmonics.
"""
import math

from scene import Check, entries, run, section, table

check = Check()


def wheel(name, rotation, speed, pairs=24, ranks=1, damping=1):
    text = "\n".join([
        "set Bodies = wheel, rail", "set Analyses = stability",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Rotation=rotation)),
                section("Modes", entries(Upper_frequency=2000, Damping_factor=damping))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Pole_pairs=pairs, Contact_at="support"))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=speed, Lateral_creepage=-0.01)),
        section("Stability", entries(Loss="hysteretic"))])
    return [row for row in table(run(name, text, ranks, may_doubt=True)[1], "stability.csv") if row["receptance"] == "exact"]


# With few contact points of 2.5 mm, rounding decides whether steps of 1e-5 s keep the bound on a disturbance along the motion; 16 pairs of poles follow
# the rail in time better than 24.
def cycles_of_waves(name, roots):
    text = "\n".join([
        "set Bodies = wheel, rail", "set Analyses = limit cycle",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Rotation="true")),
                section("Modes", entries(Upper_frequency=2000))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Pole_pairs=16, Contact_at="support"))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Limit cycle", entries(Time_step=5e-6, Roots=roots, Harmonics="5, 20"), section("Basins", entries(Starts=1, Border=1, Time_step=2e-5))),
        section("Transient", entries(Integrator="exact propagator"))])
    return run(name, text)


def same(what, found, expected, tolerance):
    check.near(f"number of roots, {what}", len(found), len(expected), 1e-9)
    for a, b in zip(found, expected):
        size = 2 * math.pi * b["frequency_Hz"]
        check.near(f"frequency, {what}", a["frequency_Hz"], b["frequency_Hz"], tolerance)
        check.near(f"growth, {what}", a["growth_1_s"], b["growth_1_s"], tolerance, size)


same("hardly turning", wheel("hardly", "true", 1e-4, damping=0), wheel("at_rest", "false", 1e-4, damping=0), 1e-7)
turning, still = wheel("turning", "true", 10), wheel("still", "false", 10)
same("other poles", wheel("more_pairs", "true", 10, 32)[:len(turning)], turning, 1e-7)
same("two ranks", wheel("two_ranks", "true", 10, ranks=2), turning, 1e-9)
growth = {row["label"].split(":")[1].replace(";", ","): row for row in turning}
waves = [growth[f"axial(0,2) {sense}"] for sense in ("forward", "backward")]
pair = max(row["growth_1_s"] for row in still if "axial(0;2)" in row["label"])
check.near("a pair that grows", pair > 1, True, 1e-9)
for wave in waves:
    check.near("a wave has about half of the growth of its pair", wave["growth_1_s"], pair / 2, 0.2, pair)
faster = [growth[f"axial(0,3) {sense}"] for sense in ("backward", "forward")]
found, folder = cycles_of_waves("cycles", ", ".join(f"{wave['frequency_Hz']:.1f}" for wave in faster))
for cycle, wave in zip(found["limit_cycle"], faster):
    label = cycle["root"]["label"]
    check.near(f"cycle of {label}", label == wave["label"].replace(";", ","), True, 1e-9)
    check.near(f"pitch of {label}", cycle["frequency_Hz"], wave["frequency_Hz"], 3e-3)
    check.near(f"trivial multiplier of {label}", cycle["stability"]["trivial_multiplier_error"], 0, 1e-3, 1)
    for balanced, of_frequency, of_force in zip(cycle["harmonic_balance"], (5e-4, 1e-4), (0.03, 0.02)):
        check.near(f"{label} by {balanced['harmonics']} harmonics", balanced["frequency_difference"], 0, of_frequency, 1)
        check.near(f"force of {label} by {balanced['harmonics']} harmonics", balanced["first_harmonic_difference"], 0, of_force, 1)
# of a motion with half of both waves one is left, of its own size
start, = found["limit_cycle_basins"]["starts"]
check.near("between the waves", start["between"] == [1, 2] and start["decided"], True, 1e-9)
check.near("part of the wave that wins", start["parts"][start["winner"] - 1], 1, 0.1)
row, = table(folder, "limit_cycle_basins.csv")
check.near("winner in the table", row["winner"], start["winner"], 1e-9)
check.near("its frequency", row["winner_frequency_Hz"], found["limit_cycle"][start["winner"] - 1]["frequency_Hz"], 1e-12)
path = table(folder, "limit_cycle_basin_paths.csv")
check.near("end of the path", path[-1]["time_s"], start["time_s"], 1e-12)
check.near("windows of the path", len(path), start["time_s"] / found["limit_cycle_basins"]["window_s"], 1e-9)
apart = waves[0]["frequency_Hz"] - waves[1]["frequency_Hz"]
check.near("two waves", apart, 2 * 2 * 10 / (2 * math.pi * 0.46), 0.05)
check.end()

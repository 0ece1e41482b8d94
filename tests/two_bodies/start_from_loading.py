#!/usr/bin/env python3
"""start_from_loading.py PROGRAM MPIRUN PARAMETER_FILES: a march that starts where quasi-static loading ends.

With nothing that acts the forces stay, whatever the hub does, on one rank and two. A hub of mass M whose tangential force is taken
off swings on the joint that all points stick in: from F / k to -F / k with sqrt(k / M), k of the loading itself.
"""
import math
from scene import Check, entries, run, section, table

check = Check()
SUSPENSION = section("Suspension", entries(Unsprung_mass=200, Stiffness_x=1, Stiffness_y=1, Stiffness_z=1))


def scene(name, analysis, friction=0.3, hub="held", ranks=1, **transient):
    text = "\n".join([
        "set Bodies = block, base", "set Analyses = " + analysis,
        section("block", "set Type = block",
                section("Block", entries(Length=0.04, Width=0.04, Height=0.02, Divisions_x=4, Divisions_y=4, Divisions_z=2,
                                         Contact_face="bottom", Held="top")),
                section("Modes", entries(Count=12)) if analysis == "transient" else ""),
        section("base", "set Type = half-space"),
        section("Contact", entries(Grid_spacing=5e-3, Half_length=20e-3, Half_width=20e-3, Friction_coefficient=friction)),
        section("Loading", entries(Normal_force=1000, Force_x="0, 200", Steps="5, 10")),
        section("Rolling", entries(Speed=0, Hub=hub), SUSPENSION if hub == "suspended" else "") if analysis == "transient" else "",
        section("Transient", entries(Initial_state="quasi-static loading", **transient), section("Signals", entries(Table="true"))) if analysis == "transient" else ""])
    return run(name, text, ranks, may_doubt=True)


def histories(folder):
    """Columns of the histories."""
    rows = table(folder, "histories.csv")
    return {name: [row[name] for row in rows] for name in rows[0]}


marching = dict(Time_step=1e-6, End_time=2e-4, Error_estimate="false")
for hub in ("held", "massless", "suspended"):
    for ranks in (1, 2):
        found = histories(scene(f"{hub}_{ranks}", "transient", hub=hub, ranks=ranks, **marching)[1])
        for name, force in (("normal_force_N", 1000), ("tangential_force_x_N", -200)):
            check.near(f"{hub}, {ranks} ranks, {name}", max(abs(value - force) for value in found[name]), 0, 1e-9, abs(force))
        check.near(f"{hub}, {ranks} ranks, tangential_force_y_N", max(map(abs, found["tangential_force_y_N"])), 0, 1e-9, 200)

loading = scene("loading", "quasi-static loading", friction=3)[0]["quasi_static_loading"]
amplitude = loading["steps"][-1]["displacement_m"][0]
period = 2 * math.pi * math.sqrt(200 * amplitude / 200)
released = histories(scene("released", "transient", friction=3, hub="suspended", Release="true", Time_step=period / 640,
                           End_time=1.1 * period, Error_estimate="false")[1])
place = [amplitude + displacement for displacement in released["hub_x_displacement_m"]]
first, half = place.index(min(place)), len(place) // 2
back = half + place[half:].index(max(place[half:]))
check.near("turning point", place[first], -amplitude, 1e-2)
check.near("half a period", released["time_s"][first], period / 2, 5e-3)
check.near("a whole one", released["time_s"][back], period, 5e-3)
check.near("normal force", max(released["normal_force_N"]), 1000, 1e-9)
check.end()

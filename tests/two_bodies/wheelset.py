#!/usr/bin/env python3
"""wheelset.py PROGRAM MPIRUN PARAMETER_FILES: a wheel by harmonics on an axle with a second wheel.

On an axle that does not give way, on springs that do not either, the wheel has the roots of a held hub. Modes of two and more nodal
diameters hardly notice a usual axle. Beside a rail without ends the roots are those of its exact receptance, dampers of the axle
boxes included: other poles end at the same, and so do two ranks. In time its energy is balanced.
"""
from scene import Check, entries, run, section, table

check = Check()
STEEL = {"Length": 1.5, "Radius": 0.085, "Box_distance": 0.25, "Box_mass": 100}
SPRINGS = {"Stiffness_x": 1e7, "Stiffness_y": 5e6, "Stiffness_z": 1e6, "Damping_x": 1e4, "Damping_z": 2e4}


def scene(name, axle=None, springs=None, rail="beam rail", pairs=24, ranks=1, march=0, loss="hysteretic"):
    hub = [section("Axle", entries(**{k: v for k, v in axle.items() if k != "Young_modulus"}),
                   *([section("Material", entries(Young_modulus=axle["Young_modulus"]))] if "Young_modulus" in axle else [])),
           section("Suspension", entries(**springs))] if axle else []
    on = section("Rail", entries(Model="periodic", Pole_pairs=pairs, Contact_at="support")) if rail == "rail" else section(
        "Modes", entries(Upper_frequency=2500))
    text = "\n".join([
        "set Bodies = wheel, rail", "set Analyses = " + ("transient" if march else "stability"),
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2)),
                section("Modes", entries(Upper_frequency=2000))),
        section("rail", f"set Type = {rail}", section("Material", entries(Loss_factor=0.02)), on),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=10, Lateral_creepage=-0.01, Hub="axle" if axle else "held"), *hub),
        section("Transient", entries(Time_step=1e-5, End_time=march, Perturbed_mode="wheel:axial(0,2)", Perturbation=1e-9)) if march
        else section("Stability", entries(Loss=loss))])
    return run(name, text, ranks, may_doubt=True)


def unstable(found):
    return [(root["label"], root["frequency_Hz"], root["growth_1_s"]) for root in found["stability"]["cases"][0]["unstable"]
            if root["frequency_Hz"] > 1]


def same(what, found, expected, tolerance, of_growth):
    check.near("number of roots that grow, " + what, len(found), len(expected), 1e-9)
    for a, b in zip(found, expected):
        check.near(f"{a[0]}, {what}", a[1], b[1], tolerance)
        check.near(f"growth of {a[0]}, {what}", a[2], b[2], of_growth)


held, _ = scene("held")
rigid, _ = scene("rigid", {"Length": 1.5, "Radius": 1, "Young_modulus": 2.5e12, "Box_mass": 1e12}, dict.fromkeys(
    ("Stiffness_x", "Stiffness_y", "Stiffness_z"), 1e6))
same("rigid and heavy", unstable(rigid), unstable(held), 1e-8, 1e-5)
one, folder = scene("axle", STEEL, SPRINGS)
check.near("hub", one["stability"]["hub"] == "axle", True, 1e-9)
grown = [root for root in unstable(one) if root[0].startswith("wheel:axial(0,2)")]
check.near("axial (0,2) grows", len(grown), 1, 1e-9)
labels = {row["label"] for row in table(folder, "stability.csv")}
for name in ("axle:x(3)", "axle:z(3)", "axle:torsion(2)"):
    check.near(name, name in labels, True, 1e-9)

exact, _ = scene("endless", STEEL, SPRINGS, "rail")
other, _ = scene("endless_32", STEEL, SPRINGS, "rail", 32)
two, _ = scene("endless_two", STEEL, SPRINGS, "rail", ranks=2)
same("with other poles", unstable(other), unstable(exact), 1e-7, 1e-5)
same("on two ranks", unstable(two), unstable(exact), 1e-9, 1e-7)

for rail in ("beam rail",):
    moving, _ = scene("in_time_" + rail.replace(" ", "_"), STEEL, SPRINGS, rail, march=0.02)
    check.near("hub", moving["transient"]["hub"] == "axle", True, 1e-9)
    energy = moving["transient"]["energy"]
    check.near("energy imbalance", energy["imbalance_J"], 0, 1e-3, energy["friction_J"])

check.end()

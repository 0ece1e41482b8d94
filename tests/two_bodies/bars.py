#!/usr/bin/env python3
"""bars.py PROGRAM MPIRUN PARAMETER_FILES: two bars that are driven apart and against each other, against time integration.

The periodic motion of both, by elements and reduced, on one and two ranks; the transient of the same two bars from its
equilibrium until it repeats, whose last period is what a run one period longer adds.
"""
from scene import Check, entries, run, section, table

frequency, force, preload = 700., 2e5, 1e-3
check = Check()


def bar(name, length, modulus):
    return section(name, "set Type = bar",
                   section("Material", entries(Young_modulus=modulus, Density=2700)),
                   section("Bar", entries(Length=length, Section=25e-4, Divisions=12, Element_degree=1)),
                   section("Modes", entries(Count=6, Stiffness_damping=1e-4)))


bodies = "\n".join(["set Bodies = upper, lower", bar("upper", 1., 70e9), bar("lower", 0.7, 40e9)])
law = entries(Friction_coefficient=0, Normal_law="linear spring", Penalty_amplitude=2e8, Penalty_exponent=1)


def periodic(name, model, ranks=1):
    text = "\n".join([bodies, "set Analyses = periodic", section("Contact", law),
                      section("Periodic", entries(Number_of_functions=101, Frequency=frequency, Force=force, Gap=-preload,
                                                  Model=model, Samples=8192, Reference="true"))])
    found, folder = run(name, text, ranks)
    forces = [row["contact_force_N"] for row in table(folder, "periodic_0.csv")]
    check.near("parts for a share of the period, " + name, forces.count(0.) / len(forces), 0.25, 0.2)
    return found["periodic"][0]


def transient(periods):
    steps = 4000
    text = "\n".join([bodies, "set Analyses = transient", section("Contact", law),
                      section("Rolling", entries(Speed=0, Hub_displacement=preload)),
                      section("Transient", entries(Model="finite elements", Reaction="end of step",
                                                   Time_step=f"{1 / frequency / steps:.17g}",
                                                   End_time=f"{periods / frequency:.17g}",
                                                   Exciting_force=f"-{force}*sin(2*pi*{frequency}*t)"))])
    found = run(f"transient_{periods}", text)[0]["transient"]
    return found["impulse_Ns"], found["rms_normal_force_N"]**2 * periods / frequency


elements, reduced = periodic("elements", "finite elements"), periodic("reduced", "reduced")
check.near("distance to shooting", elements["error_to_reference"], 0, 1e-3, 1)
check.near("fewer modes", reduced["impulse_Ns"][0], elements["impulse_Ns"][0], 2e-3)
check.near("two ranks", periodic("two_ranks", "reduced", 2)["impulse_Ns"][0], reduced["impulse_Ns"][0], 1e-12)
before, after = transient(12), transient(13)
check.near("impulse in time", elements["impulse_Ns"][0], after[0] - before[0], 2e-5)
check.end()

#!/usr/bin/env python3
"""two_rates.py PROGRAM MPIRUN PARAMETER_FILES: what few modes leave out relaxes, in two bars at two rates, C = beta K each.

Two bars that are driven apart and against each other: the periodic motion of all their modes, where nothing is left out, against
that of four modes and their rests, by balance (poles) and in time. A bar that its weight drops on the road: modal convolution against
transient. One and two ranks.
"""
from scene import Check, entries, run, section

frequency, force, preload = 700., 2e5, 1e-3
check = Check()


def bar(name, length, modulus, beta, count):
    return section(name, "set Type = bar",
                   section("Material", entries(Young_modulus=modulus, Density=2700)),
                   section("Bar", entries(Length=length, Section=25e-4, Divisions=12, Element_degree=1)),
                   section("Modes", entries(Count=count, Stiffness_damping=beta)))


def bodies(count=4, betas=(1e-5, 4e-5)):
    return "\n".join(["set Bodies = upper, lower", bar("upper", 1., 70e9, betas[0], count),
                      bar("lower", 0.7, 40e9, betas[1], count)])


law = section("Contact", entries(Friction_coefficient=0, Normal_law="linear spring", Penalty_amplitude=2e8,
                                 Penalty_exponent=1))


def periodic(name, scene, model="reduced", ranks=1):
    text = "\n".join([scene, "set Analyses = periodic", law,
                      section("Periodic", entries(Number_of_functions=101, Frequency=frequency, Force=force, Gap=-preload,
                                                  Model=model, Samples=8192))])
    return run(name, text, ranks)[0]["periodic"][0]["impulse_Ns"][0]


def transient(periods, scene, ranks=1):
    steps = 2000
    text = "\n".join([scene, "set Analyses = transient", law,
                      section("Rolling", entries(Speed=0, Hub_displacement=preload)),
                      section("Transient", entries(Time_step=f"{1 / frequency / steps:.17g}",
                                                   End_time=f"{periods / frequency:.17g}",
                                                   Exciting_force=f"-{force}*sin(2*pi*{frequency}*t)"))])
    found = run(f"transient_{periods}_{ranks}", text, ranks)[0]["transient"]
    check.near("relaxation is taken", found["residual_damping"]["taken"], True, 0.5)
    check.near("energy is accounted for", found["energy"]["imbalance_J"], 0, 1e-3, found["energy"]["damping_J"])
    return found["impulse_Ns"]


few = periodic("few", bodies())
elements = periodic("elements", bodies(), "finite elements")
elastic = periodic("one_rate", bodies(betas=(4e-5, 4e-5)))
print(f"impulse of a period: all modes {elements:.9g} N s, four and rests {few:.9g}, both at the slower rate {elastic:.9g}")
check.near("few modes and all", few, elements, 1e-2)
check.near("two ranks", periodic("two_ranks", bodies(), ranks=2), few, 1e-12)
long, longer = transient(30, bodies()), transient(31, bodies())
print(f"in time {longer - long:.9g}")
check.near("impulse in time", longer - long, few, 1e-5)
check.near("two ranks in time", transient(30, bodies(), 2), long, 1e-12)


def dropped(analysis, count=5, beta=2e-3, ranks=1):
    text = "\n".join([
        "set Bodies = bar" + (", stop" if analysis == "transient" else ""), f"set Analyses = {analysis}",
        section("bar", "set Type = bar", section("Material", entries(Young_modulus=900, Density=1)),
                section("Bar", entries(Length=10, Section=1, Divisions=20, Element_degree=2)),
                section("Loads", entries(Gravity=10)),
                section("Modes", entries(Count=count, Stiffness_damping=beta))),
        section("Contact", entries(Friction_coefficient=0)) + "\n" + section("Rolling", entries(Speed=0)) if analysis == "transient" else section("Road", entries(Indentation=0)),
        section("stop", "set Type = rigid") if analysis == "transient" else "",
        section("Transient", entries(Time_step=2.5e-4, End_time=4, Initial_state="undeformed"))
        if analysis == "transient" else
        section("Modal convolution", entries(Force_shape="linear", Time_step=2.5e-4, End_time=4, Initial_state="at rest"))])
    name = f"{analysis.replace(' ', '_')}_{count}_{beta}_{ranks}"
    found = run(name, text, ranks, may_doubt=True)[0][analysis.replace(" ", "_")]
    impulse = found["impulse_Ns"]
    return impulse[0] if isinstance(impulse, list) else impulse


road, step = dropped("modal convolution"), dropped("transient")
print(f"dropped bar: modal convolution {road:.9g} N s, transient {step:.9g}")
check.near("modal convolution and transient", road, step, 1e-5)
check.near("modal convolution, two ranks", dropped("modal convolution", ranks=2), road, 1e-12)
check.end()

#!/usr/bin/env python3
"""rolling_elements.py PROGRAM MPIRUN: a rolling ring of elements goes as the analytic one does, in all analyses.

The analytic ring has its poles order by order in the frame that turns with it (rolling_ring.py holds it to sums of its own);
that of elements moves by the modes of a ring at rest. With divisions and modes the two come together. A solid ring is softer in
shear: it is compared with itself on a finer mesh, and with the thin ring from afar. Two ranks do what one does.
"""
import math, re

from scene import Check, entries, run, section, table

check = Check()
rigid = section("road", "set Type = rigid")
V, depth = 30., 1e-3
tread = dict(Tread_stiffness=3e5, Contact_spacing=1e-2, Rolling="true")
rubs = dict(Tread_tangential_stiffness=3e5)


def analytic(points, **own):
    return section("tyre", "set Type = ring", section("Ring", entries(Highest_order=150, Contact_points=points, **tread, **own)))


def elements(points, model="beam elements", divisions=208, frequency=4000, **own):
    return section("tyre", "set Type = ring",
                   section("Ring", entries(Model=model, Divisions=divisions, Contact_points=points, **tread, **own)),
                   section("Modes", entries(Upper_frequency=frequency)))


def contact(friction):
    return section("Contact", entries(Friction_coefficient=friction), section("Solver", entries(Tolerance=1e-12)))


def rolling(creep):
    return section("Rolling", entries(Hub_displacement=depth, Speed=V, Longitudinal_creepage=creep))


def steady(name, body, creep, mu, ranks=1):
    """Equilibrium, its roots, and a motion that begins undeformed."""
    text = "\n".join([
        "set Bodies = tyre, road", "set Analyses = quasi-static rolling, stability, transient", body, rigid, contact(mu),
        rolling(creep), section("Stability", entries(Linearise_sticking_points="true")),
        section("Transient", entries(Time_step=1e-4, End_time=0.02, Initial_state="undeformed"))])
    # of another name, so that it is not found in the cache
    found, folder = run(name, text if ranks == 1 else text.replace("tyre", "wheel"), ranks, may_doubt=True)
    case = found["quasi_static_rolling"]["cases"][0]
    return {"normal force": case["normal_force_N"], "tangential force": case["tangential_force_N"][0],
            "impulse": found["transient"]["impulse_Ns"],
            "roots": [complex(row["growth_1_s"], 2 * math.pi * row["frequency_Hz"])
                      for row in table(folder, "stability.csv")]}


def compare(what, found, exact, forces, roots, stretched):
    """Relative errors: of normal force and impulse, of roots up to 160 Hz, of the tangential force."""
    for key, tolerance in (("normal force", forces), ("impulse", forces), ("tangential force", stretched)):
        check.near(f"{key}, {what}", found[key], exact[key], tolerance)
    lowest = [root for root in exact["roots"] if root.imag < 1000]
    check.near(f"some roots, {what}", len(lowest) > 10, True, 0.5, 1)
    for root in lowest:
        error = min(abs(other - root) for other in found["roots"]) / abs(root)
        check.near(f"root at {root.imag / (2 * math.pi):.2f} Hz, {what}", error, 0, roots, 1)


# the force of a sticking point follows from the stretch, which jumps under it: waves beyond the modes make a part of the jump
for points, name, mu, creep, stretched in ((1, "stick", 0.5, 1e-3, 0.02), (1, "slip", 0.1, 0.2, 1e-4),
                                           (9, "nine points", 0.3, 2e-3, 0.005)):
    exact = steady("exact_" + name.split()[0], analytic(points, **rubs), creep, mu)
    found = steady("beams_" + name.split()[0], elements(points, **rubs), creep, mu)
    compare("beams, " + name, found, exact, 1e-4, 1e-3, stretched)
    if points > 1:
        both = steady("two_ranks", elements(points, **rubs), creep, mu, 2)
        compare("two ranks", both, found, 1e-10, 1e-10, 1e-10)
        again = steady("again", elements(points, **rubs), creep, mu)
        compare("from the cache", again, found, 1e-14, 1e-14, 1e-14)
        solid = [steady(f"solid_{divisions}", elements(points, "solid elements", divisions, 1500, **rubs), creep, mu)
                 for divisions in (120, 240)]
        compare("solid, finer", solid[0], solid[1], 1e-3, 2e-4, 1e-3)
        compare("solid", solid[1], exact, 3e-3, 5e-3, 0.03)

# modal convolution, with and without friction
for friction, own in (("false", {}), ("true", rubs)):
    moved = [run(f"{name}_{friction}", "\n".join([
        "set Bodies = tyre", "set Analyses = modal convolution", body, contact(0.3) if friction == "true" else "",
        section("Road", entries(Profile="ISO 8608", Indentation=depth, Speed=V),
                entries(Sliding_speed=-0.05) if friction == "true" else ""),
        section("Modal convolution", entries(Method="modal recursion", Force_shape="constant", Time_step=1e-4, End_time=0.2,
                                             Friction=friction))]), may_doubt=True)[0]["modal_convolution"]
             for name, body in (("exact", analytic(9, **own)), ("beams", elements(9, **own)))]
    for point in range(9):
        check.near(f"impulse of point {point}, friction {friction}", moved[1]["impulse_Ns"][point],
                   moved[0]["impulse_Ns"][point], 1e-4, sum(moved[0]["impulse_Ns"]))
        if friction == "true":
            check.near(f"tangential impulse of point {point}", moved[1]["tangential_impulse_Ns"][point],
                       moved[0]["tangential_impulse_Ns"][point], 2e-3, sum(map(abs, moved[0]["tangential_impulse_Ns"])))

# periodic motion
pushed = [run("periodic_" + name, "\n".join([
    "set Bodies = tyre, road", "set Analyses = periodic", re.sub("set Contact spacing.*", "", body), rigid,
    section("Contact", entries(Friction_coefficient=0)), section("Road", entries(Speed=V)),
    section("Periodic", entries(Number_of_functions=31, Frequency=40, Force=200, Gap=1e-5, Law="linear"))]))[0]["periodic"][0]
          for name, body in (("exact", analytic(1)), ("beams", elements(1)))]
for key in ("tip_max_m", "tip_min_m"):
    check.near("periodic, " + key, pushed[1][key], pushed[0][key], 1e-4)
check.near("periodic, impulse", pushed[1]["impulse_Ns"][0], pushed[0]["impulse_Ns"][0], 1e-4)

check.end()

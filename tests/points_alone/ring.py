#!/usr/bin/env python3
"""ring.py PROGRAM MPIRUN PARAMETER_FILES: a ring in rolling, stability and the transient, at rest and rolling.

Its receptance G(s) is summed order by order (tests/ring_order.py). Pressed down by d on a rigid plane, N = d / (G(0) + S)
with S of the orders beyond and the tread; the roots about it are those of G(s) + S = 0. In time it goes as modal convolution
has it, step by step.
"""
import math, os

from ring_order import R, k_theta, m, order
from scene import Check, entries, run, section, table

highest, last, tread, d = 8, 400, 3e5, 1e-3
check = Check()


def inward(s, Omega):
    """G(s) + S of one point; a force that stands still is seen by order n at n Omega."""
    moving = sum(order(n, s + 1j * n * Omega, Omega)[1][1] for n in range(-highest, highest + 1))
    still = 2 * sum(order(n, 1j * n * Omega, Omega)[1][1].real for n in range(highest + 1, last + 1))
    return moving + still + 1 / tread


def ring(**own):
    values = dict(Highest_order=highest, Residual_order=last, Contact_points=1, Tread_stiffness=tread)
    values.update(own)
    return section("tyre", "set Type = ring", section("Ring", entries(**values)),
                   section("Modes", entries(Upper_frequency=800)) if "elements" in own.get("Model", "") else "")


rigid = section("road", "set Type = rigid")
smooth = section("Contact", entries(Friction_coefficient=0), section("Solver", entries(Tolerance=1e-13)))

# statics and roots
for V in (0, 30):
    Omega = -V / R
    own = ring(Rolling="true") if V else ring()
    moving = entries(Speed=V) if V else entries(Speed=0, Sliding_velocity_x=1)
    found, folder = run(f"ring_{V}", "\n".join([
        "set Bodies = tyre, road", "set Analyses = quasi-static rolling, stability", own, rigid, smooth,
        section("Rolling", entries(Hub_displacement=d), moving)]))
    check.near(f"force at {V} m/s", found["quasi_static_rolling"]["cases"][0]["normal_force_N"],
               d / inward(0, Omega).real, 1e-9)
    roots = table(folder, "stability.csv")
    check.near("roots", len(roots), 4 * highest + 2, 0.5, 1)
    n_free = 0
    for row in roots:
        s = complex(row["growth_1_s"], 2 * math.pi * row["frequency_Hz"])
        value, step = inward(s, Omega), 1e-5 * abs(s)
        slope = (inward(s + step, Omega) - inward(s - step, Omega)) / (2 * step)
        # the distance to the root; a motion that does not move the point inward stays a pole
        is_free = abs(value) > 1e3 * abs(inward(0, 0))
        turns = V == 0 and abs(abs(s) / math.sqrt(k_theta / m) - 1) < 1e-9
        n_free += is_free or turns
        if turns:
            continue
        error = abs(inward(0, 0) / value) if is_free else abs(value / slope / s)
        check.near(f"root at {row['frequency_Hz']:.3f} Hz, {V} m/s", error, 0, 1e-6, 1)
    check.near("motions without a share in the point", n_free, 0 if V else 2 * highest + 1, 0.5, 1)

# elements against the closed form
found, _ = run("elements", "\n".join([
    "set Bodies = tyre, road", "set Analyses = quasi-static rolling",
    section("tyre", "set Type = ring", section("Ring", entries(Model="beam elements", Contact_points=1, Tread_stiffness=tread))),
    rigid, smooth, section("Rolling", entries(Hub_displacement=d, Speed=0, Sliding_velocity_x=1))]))
check.near("force, elements", found["quasi_static_rolling"]["cases"][0]["normal_force_N"], d / inward(0, 0).real, 1e-3)

# in time: three points on a flat road, as modal convolution has it
poles = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "periodic", "identified_stop.csv")
end, step = 0.02, 5e-5
for name, body, V, depth in (
        ("at rest", ring(Contact_points=3), 0, d), ("elements", ring(Model="beam elements", Contact_points=3), 0, d),
        ("rolling", ring(Contact_points=3, Rolling="true"), 30, d),
        ("identified", section("tyre", "set Type = identified",
                               section("Identified", entries(Poles_file=poles, Tread_stiffness=tread))), 0, d)):
    if "elements" in body:
        body = body.replace("set Highest order = 8\n", "").replace("set Residual order = 400\n", "")
    scheme = entries(Time_step=step, End_time=end, Theta=0.6)
    pushed, _ = run("pushed", "\n".join([
        "set Bodies = tyre, road", "set Analyses = transient", body, rigid, smooth,
        section("Rolling", entries(Hub_displacement=depth, Speed=V)),
        section("Transient", scheme, entries(Initial_state="undeformed"))]), may_doubt=True)
    convolved, _ = run("convolved", "\n".join([
        "set Bodies = tyre", "set Analyses = modal convolution", body,
        section("Road", entries(Indentation=depth), entries(Speed=V) if V else ""),
        section("Modal convolution", scheme, entries(Method="theta method", Force_shape="linear"))]), may_doubt=True)
    check.near(f"impulse, {name}", pushed["transient"]["impulse_Ns"],
               sum(convolved["modal_convolution"]["impulse_Ns"]), 1e-10)

check.end()

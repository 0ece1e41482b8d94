#!/usr/bin/env python3
"""rolling_ring.py PROGRAM MPIRUN: a rolling ring with friction in rolling, stability, transient and modal convolution.

The tread of a ring that nothing bends is a row of bristles: the brush model. Of one point G(s) and the stretch of the material
that flows through it are summed order by order (tests/ring_order.py; doc/theory.md, "Friction on a rolling ring"); forces,
roots and motions follow.
"""
import cmath, math

from ring_order import R, b, order
from scene import Check, entries, run, section, table

highest, last, spacing = 8, 400, 2e-3
check = Check()
rigid = section("road", "set Type = rigid")


def contact(friction, scheme="second-order upwind", *more):
    return section("Contact", entries(Friction_coefficient=friction, Creep_scheme=scheme),
                   section("Solver", entries(Tolerance=1e-13)), *more)


# the brush: E, foundations and orders that leave the band in its place; deflection = creep times way until mu p
n, way, depth = 41, 1e-3, 2e-4
normal, tangential = 4e4, 3e4
stiff = section("tyre", "set Type = ring", section("Ring", entries(
    Young_modulus=1e13, Radial_foundation_stiffness=1e14, Circumferential_foundation_stiffness=1e14, Highest_order=1,
    Residual="false", Contact_points=n, Contact_spacing=way, Tread_stiffness=normal, Tread_tangential_stiffness=tangential,
    Rolling="true")))
N = [max(0., normal * (depth - R * (1 - math.cos((i - n // 2) * way / R)))) for i in range(n)]
for mu, creep in ((10, 1e-3), (0.1, 1e-3), (0.1, -4e-4), (0.02, 1e-2)):
    found, folder = run(f"brush_{mu}_{creep}", "\n".join([
        "set Bodies = tyre, road", "set Analyses = quasi-static rolling", stiff, rigid, contact(mu, "first-order upwind"),
        section("Rolling", entries(Hub_displacement=depth, Speed=20, Longitudinal_creepage=creep))]))
    rows = table(folder, "contact_patch_0.csv")
    deflection = 0
    for i, row in enumerate(rows):
        # from the leading edge on; what slips lies on mu N
        deflection = 0 if N[i] == 0 else deflection - creep * way
        if abs(deflection) > mu * N[i] / tangential:
            deflection = math.copysign(mu * N[i] / tangential, deflection)
        check.near(f"bristle {i}, mu {mu}", row["traction_x_Pa"] * way * b, deflection * tangential, 1e-6, 0.1)
        check.near(f"normal force {i}", row["pressure_Pa"] * way * b, N[i], 1e-6, 1)


tread = 3e5
scheme = (1.5, -2., 0.5)


def point(s, V):
    """Of one point: (inward, forward, stretch) per (inward, forward) force."""
    Omega = -V / R
    rows = [[0j, 0j], [0j, 0j], [0j, 0j]]
    for n in range(-last, last + 1):
        moves = abs(n) <= highest
        H = order(n, (s if moves else 0) + 1j * n * Omega, Omega)
        for column, (c, sign) in enumerate(((1, -1), (0, 1))):  # inward is against w, forward is along v
            v, w = sign * H[0][c], sign * H[1][c]
            rows[0][column] -= w
            rows[1][column] += v
            if moves:
                stretch = 1j * n * v + w
            else:  # the material comes from theta > 0
                stretch = w - R / spacing * sum(c * v * cmath.exp(1j * n * i * spacing / R) for i, c in enumerate(scheme))
            rows[2][column] += stretch / R
    rows[0][0] += 1 / tread
    rows[1][1] += 1 / tread
    rows[2][1] -= scheme[0] / spacing / tread
    return rows


one = dict(Highest_order=highest, Residual_order=last, Contact_points=1, Contact_spacing=spacing, Tread_stiffness=tread,
           Tread_tangential_stiffness=tread)
ring = section("tyre", "set Type = ring", section("Ring", entries(Rolling="true", **one)))
still = ring.replace("set Rolling = true", "").replace(f"set Contact spacing = {spacing}", "")
d, V = 1e-3, 30.


def steady(mu, W):
    """Forces inward and forward at u = d, slip = W - V stretch; -> also whether it sticks."""
    (a, c), _, (e, f) = ([x.real for x in row] for row in point(0, V))
    det = a * (-V * f) + c * V * e
    N, T = (d * -V * f + c * W) / det, (-a * W + V * e * d) / det
    if abs(T) <= mu * N:
        return N, T, True
    for sign in (1, -1):
        N = d / (a + sign * mu * c)
        if (W - V * (e * N + sign * mu * f * N)) * sign <= 0:
            return N, sign * mu * N, False


for name, mu, creep in (("stick", 0.5, 1e-3), ("slip", 0.1, 0.2), ("back", 0.1, -0.2)):
    N, T, sticks = steady(mu, -V * creep)
    check.near("sticks", sticks, name == "stick", 0.5, 1)
    rolling = section("Rolling", entries(Hub_displacement=d, Speed=V, Longitudinal_creepage=creep))
    found, folder = run("steady_" + name, "\n".join([
        "set Bodies = tyre, road", "set Analyses = quasi-static rolling, stability, transient", ring, rigid, contact(mu), rolling,
        section("Stability", entries(Linearise_sticking_points="true")),
        section("Transient", entries(Time_step=1e-4, End_time=0.01))]), may_doubt=True)
    case = found["quasi_static_rolling"]["cases"][0]
    check.near(f"normal force, {name}", case["normal_force_N"], N, 1e-9)
    check.near(f"tangential force, {name}", case["tangential_force_N"][0], -T, 1e-9)
    # the transient stays in its equilibrium
    check.near(f"impulse, {name}", found["transient"]["impulse_Ns"], N * 0.01, 1e-8)

    def residual(s):
        (a, c), (g, f), (e, q) = point(s, V)
        if sticks:
            return a * (s * f - V * q) - c * (s * g - V * e)
        return a + T / N * c

    n_free = 0
    for row in table(folder, "stability.csv"):
        s = complex(row["growth_1_s"], 2 * math.pi * row["frequency_Hz"])
        value, step = residual(s), 1e-5 * abs(s)
        slope = (residual(s + step) - residual(s - step)) / (2 * step)
        is_free = abs(value) > 1e3 * abs(residual(100j))
        n_free += is_free
        if not is_free:
            check.near(f"root at {row['frequency_Hz']:.3f} Hz, {name}", abs(value / slope / s), 0, 1e-6, 1)
    check.near("motions without a share in the point", n_free, 0, 0.5, 1)

    # a modal convolution ends there too
    found, folder = run("convolved_" + name, "\n".join([
        "set Bodies = tyre", "set Analyses = modal convolution", ring, contact(mu),
        section("Road", entries(Indentation=d, Speed=V, Sliding_speed=-V * creep)),
        section("Modal convolution", entries(Friction="true", Method="modal recursion", Force_shape="constant", Time_step=2e-4,
                                             End_time=2, History_interval=0.02))]), may_doubt=True)
    end = table(folder, "contact_point_0.csv")[-1]
    check.near(f"normal force in the end, {name}", end["force_N"], N, 1e-7)
    check.near(f"tangential force in the end, {name}", end["tangential_force_N"], T, 1e-7)

# the slower it rolls the less it differs from one at rest
moved = {}
for name, body, speed in (("still", still, entries()), ("slow", ring, entries(Speed=1e-7))):
    found, _ = run(name, "\n".join([
        "set Bodies = tyre", "set Analyses = modal convolution", body,
        section("Contact", entries(Friction_coefficient=0.2), section("Solver", entries(Tolerance=1e-13))),
        section("Road", entries(Indentation=d, Sliding_speed=0.1, Loading_time=0.01), speed),
        section("Modal convolution", entries(Friction="true", Method="modal recursion", Force_shape="constant", Time_step=1e-4,
                                             End_time=0.05))]), may_doubt=True)
    moved[name] = found["modal_convolution"]
for key in ("impulse_Ns", "tangential_impulse_Ns"):
    check.near("slow rolling, " + key, moved["slow"][key][0], moved["still"][key][0], 1e-6)

check.end()

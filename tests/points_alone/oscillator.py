#!/usr/bin/env python3
"""oscillator.py PROGRAM MPIRUN PARAMETER_FILES: a mass on a spring in rolling, stability and the transient, by closed forms.

Pressed down by d on a rigid plane that drags it along: N = K d + M g, T = -mu N. About that equilibrium the mass swings
along the plane, M_t v'' + (C_t + N mu') v' + K_t v = 0, with friction that falls with the slip speed negatively damped; on
a spring k it swings up and down at sqrt((K + k) / M). In time it goes as modal convolution has it, step by step.
"""
import math

from scene import Check, entries, run, section, table

M, K, zeta, g, M_t, K_t, zeta_t = 2., 5e5, 0.03, 9.81, 1.5, 3e5, 0.01
d, mu, V, k = 1e-4, 0.4, 0.2, 8e5
check = Check()


def oscillator(moves, slides):
    """With the entries that matter."""
    own = dict(Mass=M, Stiffness=K, Gravity=g)
    own.update(dict(Damping_ratio=zeta) if moves else {})
    own.update(dict(Tangential_stiffness=K_t) if slides else {})
    own.update(dict(Tangential_mass=M_t, Tangential_damping_ratio=zeta_t) if moves and slides else {})
    return section("mass", "set Type = oscillator", section("Oscillator", entries(**own)))


still, mass, upright = oscillator(False, True), oscillator(True, True), oscillator(True, False)
plane = section("plane", "set Type = rigid")
rolling = section("Rolling", entries(Hub_displacement=d, Speed=0, Sliding_velocity_x=V))
both = ["set Bodies = mass, plane", plane, rolling]
spring = dict(Normal_law="linear spring", Penalty_amplitude=k, Penalty_exponent=1)


def contact(**values):
    return section("Contact", entries(**values), section("Solver", entries(Tolerance=1e-13)))


# rolling: rigid and on a spring k in series
for law, stiffness in (({}, K), (spring, K * k / (K + k))):
    found, _ = run("rolling", "\n".join(both + [still, "set Analyses = quasi-static rolling",
                                                contact(Friction_coefficient=mu, **law)]))
    case = found["quasi_static_rolling"]["cases"][0]
    N = stiffness * (d + M * g / K)
    check.near("normal force", case["normal_force_N"], N, 1e-9)
    check.near("friction force", case["tangential_force_N"][0], -mu * N, 1e-9)

# stability: along the plane, and up and down on a spring
falling = dict(Friction_law="falling friction", Friction_coefficient=0.3, Static_friction_ratio=1.5)
for name, law, friction, stiffness in (("rigid", {}, {"Friction_coefficient": mu}, 0), ("rigid", {}, falling, 0),
                                       ("spring", spring, {"Friction_coefficient": mu}, k), ("spring", spring, falling, k)):
    found, folder = run("stability", "\n".join(both + [mass, "set Analyses = stability", contact(**friction, **law)]))
    roots = {row["label"]: row for row in table(folder, "stability.csv")}
    along = roots["mass:oscillator; tangential"]
    w = math.sqrt(K_t / M_t)
    slope = 0.
    if friction is falling:
        # from the same file at two speeds beside V
        forces = []
        for speed in (V * (1 - 1e-4), V * (1 + 1e-4)):
            one, _ = run("slope", "\n".join(["set Bodies = mass, plane", still, plane,
                                             section("Rolling", entries(Hub_displacement=d, Speed=0, Sliding_velocity_x=speed)),
                                             "set Analyses = quasi-static rolling", contact(**friction, **law)]))
            forces.append(-one["quasi_static_rolling"]["cases"][0]["tangential_force_N"][0])
        slope = (forces[1] - forces[0]) / (2e-4 * V)
    growth = -(2 * zeta_t * w * M_t + slope) / (2 * M_t)
    check.near(f"growth along the plane, {name}", along["growth_1_s"], growth, 1e-5)
    check.near(f"frequency along the plane, {name}", along["frequency_Hz"], math.sqrt(w**2 - growth**2) / (2 * math.pi), 1e-9)
    if stiffness:
        up = roots["mass:oscillator"]
        decay = zeta * math.sqrt(K / M)
        check.near("growth up and down", up["growth_1_s"], -decay, 1e-9)
        check.near("frequency up and down", up["frequency_Hz"], math.sqrt((K + k) / M - decay**2) / (2 * math.pi), 1e-9)

# in time: on a spring with theta = 1/2 and forces linear in a step, rigid with theta = 3/4 and those of its end; exact
end, step = 0.03, 2e-5
for name, law, theta, shape, reaction, method in (
        ("spring", spring, 0.5, "linear", "as other forces", "theta method"),
        ("rigid", {}, 0.75, "constant", "end of step", "theta method"),
        ("spring, exact", spring, None, "linear", "as other forces", "modal recursion")):
    scheme = entries(Theta=theta) if theta else ""
    pushed, _ = run("pushed", "\n".join([
        "set Bodies = mass, plane", upright, plane, "set Analyses = transient", contact(Friction_coefficient=0, **law),
        section("Rolling", entries(Hub_displacement=1e-30, Speed=0)),
        section("Transient", entries(Time_step=step, End_time=end, Initial_state="undeformed", Reaction=reaction,
                                     Integrator="theta method" if theta else "exact propagator"), scheme)]))
    convolved, _ = run("convolved", "\n".join([
        "set Bodies = mass", upright, "set Analyses = modal convolution",
        section("Contact", entries(**law)) if law else "",
        section("Modal convolution", entries(Time_step=step, End_time=end, Method=method, Force_shape=shape,
                                             Initial_state="at rest"), scheme)]))
    # a force that is linear in a step counts with the mean of both ends, one of its end as it is
    impulse = pushed["transient"]["impulse_Ns"]
    if shape == "constant":
        impulse += step / 2 * pushed["transient"]["last"]["normal_force_N"]
    check.near(f"impulse, {name}", impulse, convolved["modal_convolution"]["impulse_Ns"][0], 1e-10)
check.end()

#!/usr/bin/env python3
"""limit_cycles.py PROGRAM MPIRUN PARAMETER_FILES: limit cycles of masses on springs, given by matrices.

Two motions of one mass flutter: the branch ends at the friction of the closed form, and the growth there is that of the root that
grows, not of its partner with the same frequency. Two masses over falling friction: the growth of the higher root jumps where points
begin to stick, and its cycle is that of a transient. So is that of a tip that leaves the plane and sticks where it touches.
"""
from scene import Check, entries, run, section, write_matrix

check = Check()


def body(name, masses, dampings, ground, links, added=()):
    """Masses along z, each on springs to the next one (x, y, z), the last but one to the ground as well; the last has no mass and touches."""
    n = 3 * len(masses)
    stiffness, mass, damping = ([[0.] * n for _ in range(n)] for _ in range(3))
    for d in range(3):
        on_ground = 3 * (len(masses) - 2) + d
        stiffness[on_ground][on_ground] += ground[d]
        for i, link in enumerate(links):
            a, b = 3 * i + d, 3 * (i + 1) + d
            for row, column, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
                stiffness[row][column] += sign * link[d]
        for i, m in enumerate(masses):
            mass[3 * i + d][3 * i + d] = m
            damping[3 * i + d][3 * i + d] = dampings[i]
    for row, column, value in added:
        stiffness[row][column] += value
        stiffness[column][row] += value
    for letter, matrix in zip("KMC", (stiffness, mass, damping)):
        write_matrix(f"{name}_{letter}.mtx", matrix)
    with open(f"{name}_dofs.csv", "w") as file:
        file.write("node,x_m,y_m,z_m,direction\n" + "".join(f"{i + 1},0,0,{0.01 * (len(masses) - 1 - i)},{d}\n"
                                                             for i in range(len(masses)) for d in "xyz"))
    with open(f"{name}_groups.csv", "w") as file:
        file.write(f"group,node\ntip,{len(masses)}\n")
    return section("mass", "set Type = matrices",
                   section("Matrices", entries(Stiffness=f"{name}_K.mtx", Mass=f"{name}_M.mtx", Damping=f"{name}_C.mtx",
                                               Dofs=f"{name}_dofs.csv", Groups=f"{name}_groups.csv", Contact_group="tip")),
                   section("Modes", entries(Count=n - 3)))


def scene(analyses, mass, contact, speed, *sections):
    return "\n".join([f"set Bodies = mass, plane\nset Analyses = {analyses}", mass, section("plane", "set Type = rigid"),
                      section("Contact", entries(**contact)),
                      section("Rolling", entries(Speed=0, Sliding_velocity_x=speed, Hub_displacement=1e-4)), *sections])


def in_time(theta):
    return section("Transient", entries(Residual_theta=theta, Integrator="exact propagator"),
                   section("Signals", entries(Probes="tip: mass 0 0 0.01 along x")))


def transient(theta, cycle, end, mode, velocity):
    """In the steps of a cycle."""
    return section("Transient", entries(Residual_theta=theta, Integrator="exact propagator", Time_step=cycle["time_step_s"], End_time=end,
                                        Perturbed_mode=mode, Perturbation_velocity=velocity, Error_estimate="false"),
                   section("Signals", entries(Probes="tip: mass 0 0 0.01 along x", Spectrum_duration=0.4)))


def velocity_of(march):
    return next(one for one in march["transient"]["signals"] if one["name"] == "tip_velocity")["cycle"]


# x and z of 1 kg, coupled by a spring, damped alike: onset where a root of its 2 by 2 problem begins to grow
K_X, K_Z, K_XZ, TIP, C = 2e6, 1e6, 2e5, 1.1e6, 14.14
flutter = body("flutter", [1., 0.], [C, 0.], (K_X, 5e6, K_Z), [(3.3e6, 3.3e6, TIP)], [(0, 2, K_XZ)])
cycle = run("flutter", scene("limit cycle", flutter, dict(Friction_coefficient=0.25), 0.1, in_time(0.6),
                             section("Limit cycle", entries(Time_step=4e-6),
                                     section("Branch", entries(Entry="Contact/Friction coefficient", Range="0.15, 0.3")))))[0]["limit_cycle"][0]
# held to the plane along z over the tip's spring, dragged along x by mu times its force
low, high = 0.15, 0.25
grows = lambda mu: max((-C / 2 + complex(C * C / 4 - square) ** 0.5).real
                       for square in ((s + sign * complex(d) ** 0.5) for sign in (-1, 1)
                                      for s, d in [((K_X + K_Z + TIP) / 2,
                                                    ((K_X - K_Z - TIP) / 2) ** 2 + K_XZ * (K_XZ - mu * TIP))]))
while high - low > 1e-13:
    middle = (low + high) / 2
    low, high = (low, middle) if grows(middle) > 0 else (middle, high)
end = cycle["branch"]["begin"]
check.near("onset by the cycle", end["onset"], low, 1e-5)
check.near("onset by the root", end["onset_of_root"], low, 1e-7)
check.near("growth at the onset", end["root_growth_1_s"], 0, 0.01, 1)

# far beyond the onset the tip leaves the plane and sticks where it touches; its stability is not known
HOPPING = dict(Friction_coefficient=0.5)
for name, multipliers in (("hopping", 0), ("hopping_judged", 4)):
    cycle = run(name, scene("limit cycle", flutter, HOPPING, 0.1, in_time(0.6), section("Limit cycle", entries(Time_step=4e-6, Multipliers=multipliers))),
                1, may_doubt=multipliers > 0)[0]["limit_cycle"][0]
    check.near(name + " is not judged", "stability" not in cycle and "touches down" in cycle["not_judged"], True, 1e-12)
march = run("hopping_march", scene("transient", flutter, HOPPING, 0.1, transient(0.6, cycle, 1, "mass:mode 1", 0.1)), 1, may_doubt=True)[0]
side = velocity_of(march)
check.near("frequency of the march that hops", side["frequency_Hz"], cycle["frequency_Hz"], 1e-4)
check.near("amplitude of the march that hops", side["amplitude"], cycle["amplitude_m_s"], 5e-3)

masses = body("masses", [0.5, 1., 0.], [2., 2., 0.], (1e6, 5e6, 1e6), [(1.5e6, 7e6, 3e6), (2e7, 2e7, 1e6)])
falling = dict(Friction_coefficient=0.3, Friction_law="falling friction", Static_friction_ratio=1.8, Stribeck_velocity=0.2)
cycles = run("masses", scene("limit cycle", masses, falling, 0.25, in_time(1), section("Limit cycle", entries(Time_step=1e-5))), 1,
             may_doubt=True)[0]["limit_cycle"]
check.near("cycles", len(cycles), 2, 1e-12)
cycle = max(cycles, key=lambda one: one["frequency_Hz"])
check.near("stable", cycle["stable"], True, 1e-12)
march = run("march", scene("transient", masses, falling, 0.25, transient(1, cycle, 1.5, "mass:mode 4", 0.3)), 1, may_doubt=True)[0]
side = velocity_of(march)
check.near("frequency of the march", side["frequency_Hz"], cycle["frequency_Hz"], 1e-5)
check.near("amplitude of the march", side["amplitude"], cycle["amplitude_m_s"], 2e-3)
check.end()

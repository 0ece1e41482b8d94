#!/usr/bin/env python3
"""block_on_dashpots.py PROGRAM MPIRUN PARAMETER_FILES: a meshed block of an orthotropic material, with a mass coupled to its sides, on
springs and dashpots: what the program says of its mass, modes, response and free vibration, against one mass on a spring."""
import math
from scene import Check, entries, run, section, table

check = Check()
size, n = (0.3, 0.2, 0.1), (3, 2, 1)
names = {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "bottom": (2, 0), "top": (2, 1)}


def number(*ijk):
    return 1 + ijk[0] + (n[0] + 1) * (ijk[1] + (n[1] + 1) * ijk[2])


nodes = [(i, j, k) for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1)]
corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
with open("block.inp", "w") as file:
    file.write("*NODE\n")
    for ijk in nodes:
        x = [ijk[d] * size[d] / n[d] for d in range(3)]
        # the origin in the middle of its top
        file.write(f"{number(*ijk)}, {x[0] - size[0] / 2!r}, {x[1] - size[1] / 2!r}, {x[2] - size[2]!r}\n")
    file.write("*ELEMENT, TYPE=C3D8, ELSET=body\n")
    cells = [(i, j, k) for k in range(n[2]) for j in range(n[1]) for i in range(n[0])]
    for c, first in enumerate(cells):
        file.write(", ".join(map(str, [c + 1] + [number(*(first[d] + one[d] for d in range(3))) for one in corners])) + "\n")
    for name, (d, end) in names.items():
        file.write(f"*NSET, NSET={name}\n")
        file.writelines(f"{number(*ijk)},\n" for ijk in nodes if ijk[d] == end * n[d])

k, c, density, added = 3e5, 3e2, 1600., 7.
area = size[0] * size[1]
mass = density * size[0] * size[1] * size[2] + added
stiffness, damping = k * area, c * area
omega, decay = math.sqrt(stiffness / mass), damping / (2 * mass)
motion = math.sqrt(omega * omega - decay * decay)


def block(rigid, **more):
    ply = entries(E1=140e9, E2=10e9, E3=8e9, nu12=0.3, nu13=0.3, nu23=0.4, G12=5e9, G13=5e9, G23=3e9, Axis_1="1, 1, 0", Axis_2="0, 1, 0")
    motor = entries(Groups="left, right", Rigid=rigid, Mass=added, Place=f"0, 0, {-size[2] / 2}", Inertia="0.1, 0.1, 0.1")
    return "\n".join([
        "set Type = mesh", section("Material", entries(Density=density), section("Orthotropic", ply)),
        section("Mesh", entries(File="block.inp", **more, Foundation_groups="bottom", Masses="motor",
                                # the block lies on its foundation softly along x and y: these motions, which tilt it, come first
                                Foundation_stiffness=f"{k / 50}, {k / 40}, {k}", Foundation_damping=f"0, 0, {c}"),
                section("Mass", section("motor", motor))),
        section("Modes", entries(Count=6))])


def alone(name, rigid, ranks=1):
    text = "\n".join(["set Bodies = block", "set Analyses = modes, frequency response", section("block", block(rigid)),
                      section("Frequency response", entries(Points="middle: 0, 0, 0, z", First_frequency=0.9 * omega / 2 / math.pi,
                                                            Last_frequency=1.1 * omega / 2 / math.pi, Number_of_frequencies=3, Method="direct"))])
    return run(name, text, ranks)


for rigid in ("false", "true"):
    for ranks in (1, 2):
        found, folder = alone(f"alone_{rigid}_{ranks}", rigid, ranks)
        modes = table(folder, "modes_block.csv")
        frequency = [key for key in modes[0] if "frequency" in key][0]
        ratio = [key for key in modes[0] if "damping" in key][0]
        number_of_mode = min(range(len(modes)), key=lambda i: abs(modes[i][frequency] * 2 * math.pi - omega))
        mode = modes[number_of_mode]
        check.near("frequency", mode[frequency] * 2 * math.pi, omega, 1e-5)
        check.near("decay rate of the mode", mode[ratio] * omega, decay, 1e-4)
        log = open(folder + "/log.txt").read()
        # the second run takes the first one's reduction
        if ranks == 1:
            check.near("the mass is printed", float(f"block: a mass of {mass:.4g} kg" in log), 1, 1e-9)
        for row in table(folder, "frequency_response_block.csv"):
            w = 2 * math.pi * row["frequency_Hz"]
            exact = 1j * w / (stiffness - mass * w * w + 1j * w * damping)
            key = [one for one in row if one.endswith("real_m_Ns")][0]
            got = complex(row[key], row[key.replace("real", "imag")])
            check.near("mobility", abs(got / exact - 1), 0, 1e-3, 1)

    # a bar hangs far above; the block swings alone
    text = "\n".join([
        "set Bodies = bar, block", "set Analyses = transient",
        section("bar", "set Type = bar", section("Bar", entries(Length=1, Far_end="held")), section("Modes", entries(Count=2))),
        section("block", block(rigid, Contact_group="top")), section("Contact", entries(Friction_coefficient=0)), section("Rolling", entries(Speed=0)),
        section("Transient", entries(Time_step=2e-4, End_time=3, Integrator="exact propagator", Initial_state="undeformed",
                                     Hub_displacement=-1e-2, Perturbed_mode=f"block:mode {number_of_mode + 1}", Perturbation_velocity=0.01,
                                     History_interval=2e-3),
                section("Signals", entries(Probes="top: block 0.1 0.05 0 along z", Table="true")))])
    found, folder = run(f"swings_{rigid}", text)
    growth = found["transient"]["signals"][0]["growth"][0]
    check.near("frequency in time", growth["frequency_Hz"] * 2 * math.pi, motion, 1e-4)
    check.near("growth in time", growth["growth_1_s"], -decay, 1e-3)
check.end()

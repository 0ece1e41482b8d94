#!/usr/bin/env python3
"""round_trip.py PROGRAM MPIRUN PARAMETER_FILES: a reduced body goes through Matrix Market and back, and every analysis is the same.

A block of finite elements, reduced to 20 modes and its residual flexibility, is exported and read again by Type = matrices. Its
state space and its matrices give the receptance that the program says; Octave reads the state space, if it is there.
"""
import os, shutil, subprocess
from h5py_of_system import h5py  # a Python that has numpy too
import numpy as np
from scene import Check, entries, run, section, table

check = Check()
plane = section("plane", "set Type = rigid")
grid = entries(Grid_spacing=2e-3, Half_length=4e-3, Half_width=4e-3)
rest = "\n".join([
    plane,
    section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Hub_displacement=1e-6)),
    section("Transient", entries(Time_step=2e-7, End_time=4e-5, Initial_state="undeformed", Initial_velocity=-0.01))])


def block(held="top", loss=0.):
    return section("block", "set Type = block",
                   section("Material", entries(Young_modulus=2e9, Poisson_ratio=0.3, Density=2000, Loss_factor=loss)),
                   section("Block", entries(Length=0.008, Width=0.008, Height=0.006, Divisions_x=4, Divisions_y=4, Divisions_z=3,
                                            Contact_face="bottom", Held=held)),
                   section("Modes", entries(Count=20)))


def scene(body, listed, own=""):
    return "\n".join([f"set Analyses = {listed}", "set Bodies = block, plane", body, rest,
                      section("Contact", own, entries(Friction_coefficient=0.3))])


def imported(folder):
    """The section that the export wrote, with the paths of its files."""
    text = open(os.path.join(folder, "export", "block", "body.prm")).read()
    for name in os.listdir(os.path.join(folder, "export", "block")):
        if name.endswith((".mtx", ".csv")):
            text = text.replace("= " + name, "= " + os.path.abspath(os.path.join(folder, "export", "block", name)))
    return text


def same(what, a, b, tolerance=1e-9, scale=None):
    """Numbers, lists or objects of them; of an object against the largest of its numbers."""
    if isinstance(a, dict):
        largest = max(abs(value) for value in a.values())
        for key in a:
            same(what + "/" + key, a[key], b[key], tolerance, largest)
    elif isinstance(a, list):
        check.near(what + ": length", len(b), len(a), 0.1)
        for k, (x, y) in enumerate(zip(a, b)):
            same(f"{what}[{k}]", x, y, tolerance, max(map(abs, a)) or 1)
    else:
        check.near(what, b, a, tolerance, scale)


def same_tables(what, one, other, name, scales={}):
    """Each column against its largest number or a scale."""
    a, b = table(one, name), table(other, name)
    check.near(what + ": rows", len(b), len(a), 0.1)
    for key in a[0]:
        if isinstance(a[0][key], float):
            size = scales.get(key) or max(abs(row[key]) for row in a) or 1.
            for k, (x, y) in enumerate(zip(a, b)):
                check.near(f"{what}, {key}, row {k}", y[key], x[key], 1e-9, size)


def response(points):
    """The contact points 1 and 2 of the lowest line, each over its cell."""
    return section("Frequency response", entries(Points=points, Frequencies="1000, 20000, 40000, 58000", Quantity="receptance",
                                                 Load_length=2e-3, Load_width=2e-3))


everything = "modes, export, frequency response, quasi-static rolling, stability, transient"
on_surface = "a: -3e-3, -3e-3, z; b: -1e-3, -3e-3, x"
at_nodes = "a: -3e-3, -3e-3, 0, z; b: -1e-3, -3e-3, 0, x"
first, one = run("first", scene(block(loss=0.02), everything, grid) + "\n" + response(on_surface), 1, may_doubt=True)
second, two = run("second", scene(imported(one), everything) + "\n" + response(at_nodes), 1, may_doubt=True)
for key in ("frequencies_Hz", "damping_ratio"):
    same("modes/" + key, first["modes"]["block"][key], second["modes"]["block"][key])
# modes and static answer of the rest, damped as in time: what was exported (with loss factors, more is known of the elements)
same_tables("response", one, two, "frequency_response_block_time_domain.csv")
for key in ("normal_force_N", "tangential_force_N", "max_pressure_Pa", "contact_points", "slip_points"):
    same("rolling/" + key, first["quasi_static_rolling"]["cases"][0][key], second["quasi_static_rolling"]["cases"][0][key])
same_tables("patch", one, two, "contact_patch_0.csv", {"gap_m": 1e-6})
same_tables("roots", one, two, "stability.csv")
same("transient/energy", first["transient"]["energy"], second["transient"]["energy"])
same("transient/impulse", first["transient"]["impulse_Ns"], second["transient"]["impulse_Ns"])
a, b = (h5py.File(os.path.join(folder, "histories.h5"))["normal_force_N"][:] for folder in (one, two))
check.near("normal force in time", abs(a - b).max(), 0, 1e-9, abs(a).max())
# the comparison means something
check.near("points in contact", first["quasi_static_rolling"]["cases"][0]["contact_points"], 16, 0.1)
check.near("unstable roots", len(first["stability"]["unstable"]), 2, 0.1)
check.near("the normal force varies", float(np.ptp(a) > abs(a.mean())), 1, 0.1)
# on two ranks
third, three = run("third", scene(imported(one), "modes, quasi-static rolling, stability, transient"), 2,
                   "--set", "Output/Cache directory=cache of two ranks", may_doubt=True)
same("two ranks", second["modes"]["block"]["frequencies_Hz"], third["modes"]["block"]["frequencies_Hz"])
same_tables("two ranks", two, three, "contact_patch_0.csv", {"gap_m": 1e-6})
same_tables("two ranks", two, three, "stability.csv")
same("two ranks", second["transient"]["energy"], third["transient"]["energy"])

# The state space and the matrices of either export against what the program says; rows: z, x, y of 16 points.
row = {"a": 0, "b": 16 + 1}
computed = table(two, "frequency_response_block_time_domain.csv")
damped = table(two, "frequency_response_block.csv")
for folder in (one, two):
    files = os.path.join(folder, "export", "block")
    with h5py.File(os.path.join(files, "state_space.h5")) as file:
        A, B, C, D = (file[name][:].T for name in "ABCD")
    with h5py.File(os.path.join(files, "matrices.h5")) as file:
        M, K, damping, T = (file[name][:].T for name in ("mass", "stiffness", "damping", "recovery"))
    for k, line in enumerate(computed):
        s = 2j * np.pi * line["frequency_Hz"]
        by_states = C @ np.linalg.solve(s * np.eye(len(A)) - A, B) + D
        by_matrices = T @ np.linalg.solve(s**2 * M + s * damping + K, T.T)
        for first_point, second_point, name in (("a", "a", "a_z_a_z"), ("a", "b", "a_z_b_x"), ("b", "b", "b_x_b_x")):
            for known in (line, damped[k]):
                value = known[name + "_real_m_N"] + 1j * known[name + "_imag_m_N"]
                for what, own in (("state space", by_states), ("matrices", by_matrices)):
                    error = abs(own[row[first_point], row[second_point]] - value)
                    check.near(f"{what} of {folder}, {name}, {line['frequency_Hz']:g} Hz", error, 0, 1e-9, abs(value))
if shutil.which("octave"):
    code = "s = load('first/export/block/state_space.h5'); H = s.C * ((1e5i * eye(rows(s.A)) - s.A) \\ s.B) + s.D; printf('%.17g\\n', abs(H(1, 18)))"
    said = subprocess.run(["octave", "--no-gui", "--no-init-file", "--eval", code], capture_output=True, text=True)
    by_states = C @ np.linalg.solve(1e5j * np.eye(len(A)) - A, B) + D
    check.near("Octave", float(said.stdout or "nan"), abs(by_states[0, 17]), 1e-9)
check.end()

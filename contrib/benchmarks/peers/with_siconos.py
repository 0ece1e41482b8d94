#!/usr/bin/python3
"""The bouncing bar and contact problems by Siconos and by Vibrocontact: both answers, both times.

Bar: parameter_files/examples/bouncing_bar.prm, whose closed form is known (impulse 200 N s, no energy lost). Siconos marches linear elements
by Moreau and Jean's scheme with Newton's impact law (restitution 0); Vibrocontact the same elements and steps unreduced, and the shipped
20 modes.
Contact problems: FCLIB files that a run of Vibrocontact writes and, without --quick, the stored hard cases of tests/contact_problems, at the
approach that Vibrocontact found. Siconos solves them by block Gauss-Seidel (NSGS), Alart and
Curnier's nonsmooth Newton method (NSN_AC) and ADMM. Its rows are scaled by the mean diagonal, which changes no solution.
"""
import os
import tempfile
import time

import numpy as np

from common import EXAMPLES, least_seconds, options, require, run_ours, skip, write_table

try:
    import h5py
    import siconos.kernel as kernel
    import siconos.numerics as numerics
except ImportError:
    skip("Siconos (or h5py) for this Python", "python3-siconos python3-h5py, and run it by /usr/bin/python3")

# the bar of bouncing_bar.prm
LENGTH, YOUNG, DENSITY, GAP, SPEED, END = 10., 900., 1., 5., 10., 1.5
IMPULSE, ENERGY = 200., 500.


def bar_by_siconos(elements, step, theta):
    """March of linear elements; impulse [N s], energy at the end [J], largest penetration [m], steps, processor seconds."""
    n, dx = elements + 1, LENGTH / elements
    mass, stiffness = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        mass[e:e + 2, e:e + 2] += DENSITY * dx / 6 * np.array([[2., 1.], [1., 2.]])
        stiffness[e:e + 2, e:e + 2] += YOUNG / dx * np.array([[1., -1.], [-1., 1.]])
    bar = kernel.LagrangianLinearTIDS(np.full(n, GAP), np.full(n, -SPEED), mass)
    bar.setKPtr(stiffness)
    row = np.zeros((1, n))
    row[0, 0] = 1.
    stop = kernel.Interaction(kernel.NewtonImpactNSL(0.), kernel.LagrangianLinearTIR(row))
    model = kernel.NonSmoothDynamicalSystem(0., END)
    model.insertDynamicalSystem(bar)
    model.link(stop, bar)
    simulation = kernel.TimeStepping(model, kernel.TimeDiscretisation(0., step), kernel.MoreauJeanOSI(theta), kernel.LCP())
    impulse, steps, lowest, begin = 0., 0, 0., time.process_time()
    while simulation.hasNextEvent():
        simulation.computeOneStep()
        impulse += stop.lambda_(1)[0]
        lowest = min(lowest, bar.q()[0])
        simulation.nextStep()
        steps += 1
    seconds = time.process_time() - begin
    q, v = bar.q(), bar.velocity()
    return impulse, 0.5 * (v @ mass @ v + q @ stiffness @ q), -lowest, steps, seconds


def compare_bar(chosen):
    """One row per scheme, mesh, theta and step."""
    file = os.path.join(EXAMPLES, "bouncing_bar.prm")
    rows = []

    def ours(name, elements, theta, step, **entries):
        runs = [run_ours(chosen, file, folder, Transient__Time_step=step, Transient__Theta=theta, Transient__Error_estimate="false", **entries)
                for _ in range(1 if chosen.quick else 5)]
        run, seconds = runs[0][0]["transient"], min(seconds for _, seconds in runs)
        run["seconds_per_step"] = min(analyses["transient"]["seconds_per_step"] for analyses, _ in runs)
        rows.append((name, elements, theta, step, run["impulse_Ns"] / IMPULSE - 1, run["energy"]["stored_J"] / ENERGY - 1, 0.,
                     1e6 * run["seconds_per_step"], seconds))
        return rows[-1]

    with tempfile.TemporaryDirectory() as folder:
        for elements, theta, step in [(100, 0.5, 1e-3), (100, 1., 1e-3)] + ([] if chosen.quick else [(100, 0.5, 2e-3), (100, 0.5, 5e-4), (200, 0.5, 5e-4)]):
            impulse, energy, penetration, steps, seconds = bar_by_siconos(elements, step, theta)
            rows.append(("Siconos, Moreau-Jean", elements, theta, step, impulse / IMPULSE - 1, energy / ENERGY - 1, penetration,
                         1e6 * seconds / steps, seconds))
            unreduced = {"bar__Bar__Divisions": elements, "bar__Bar__Element_degree": 1, "Transient__Model": "finite elements",
                         "Transient__Reaction": "end of step"}
            row = ours("ours, the same elements", elements, theta, step, **unreduced)
            # both lose what the mass of the contact node takes: the same order of error
            require(abs(impulse / IMPULSE - 1) < 0.05 and abs(row[4]) < 0.05, f"impulses of {elements} elements: {rows[-2:]}")
        for step in (1e-3,) if chosen.quick else (2e-3, 1e-3, 5e-4):
            row = ours("ours, shipped 20 modes", "", 0.5, step)
            require(abs(row[4]) < 5e-3, f"impulse of the shipped file: {row}")
    write_table(chosen.output, "siconos_bar", "Bouncing bar: errors of impulse and energy against the closed form; time of the steps alone and of the whole "
                "process (Siconos: of its loop in Python)",
                ("scheme", "elements", "theta", "step_s", "impulse_error", "energy_error", "penetration_m", "us_per_step", "seconds"), rows)


def read_problem(file_name):
    """W, q, mu and the forces in the file (point by point: normal, x, y); None for a law that Siconos does not know."""
    with h5py.File(file_name) as file:
        law = file["vibrocontact/normal_law/name"][()]
        if b"signorini" not in (law if isinstance(law, bytes) else bytes(law)):
            return None
        local = file["fclib_local"]

        def matrix(group):
            full = np.zeros((int(group["m"][0]), int(group["n"][0])))
            starts, rows, values = group["p"][:], group["i"][:], group["x"][:]
            for column in range(full.shape[1]):
                among = slice(starts[column], starts[column + 1])
                full[rows[among], column] = values[among]
            return full

        q = local["vectors/q"][:].astype(float)
        if "V" in local:
            q = q + matrix(local["V"])[:, 0] * file["solution/l"][0]
        return matrix(local["W"]), q, local["vectors/mu"][:].astype(float), file["solution/r"][:]


def residual(W, q, mu, r):
    """Vibrocontact's measure (ContactResidual): forces less their projections, rho of each point, over m N with m = min(mu, 1); normal ones over N / 1000
    at least."""
    forces, responses, diagonal = (rows.reshape(-1, 3) for rows in (r, W @ r + q, W.diagonal()))

    def rho(compliance):
        return 1 / np.where(compliance > 0, compliance, compliance.mean())

    normal = np.maximum(forces[:, 0] - rho(diagonal[:, 0]) * responses[:, 0], 0.)
    tangential = forces[:, 1:] - rho(diagonal[:, 1:].mean(axis=1))[:, None] * responses[:, 1:]
    length = np.linalg.norm(tangential, axis=1)
    tangential *= np.minimum(1., mu * normal / np.maximum(length, 1e-300))[:, None]
    normal_defect, tangential_defect = np.linalg.norm(forces[:, 0] - normal), np.linalg.norm(forces[:, 1:] - tangential)
    total, limit = np.linalg.norm(normal), np.linalg.norm(np.minimum(mu, 1.) * normal)
    if normal_defect == 0 and tangential_defect == 0:
        return 0.
    if total == 0:
        return 1.  # forces that all have to go
    limit = limit or total
    return np.hypot(normal_defect / max(limit, 1e-3 * total), tangential_defect / limit)


def solve_by_siconos(W, q, mu, method, iterations):
    """Cold solve; forces, iterations, processor seconds, whether Siconos says that it converged."""
    n = len(mu)
    scale = np.ones(3 * n)
    for component in range(3):
        scale[component::3] = 1 / W.diagonal()[component::3].mean()
    # two equal factors for x and y: directions of slip stay
    scale[1::3] = scale[2::3] = 2 / (1 / scale[1] + 1 / scale[2])
    force = np.abs(scale * q).max()
    scaled, free = W * scale[:, None], scale * q / force

    def work():
        problem = numerics.FrictionContactProblem(3, scaled, free, mu)
        settings = numerics.SolverOptions(getattr(numerics, "SICONOS_FRICTION_3D_" + method))
        settings.dparam[0], settings.iparam[0] = 1e-10, iterations
        r, u = np.zeros(3 * n), np.zeros(3 * n)
        failed = numerics.fc3d_driver(problem, r, u, settings)
        return r, int(settings.iparam[1]), failed == 0

    seconds, (r, used, converged) = least_seconds(work)
    return r * force, used, seconds, converged


def written_problem(chosen, folder):
    """A rolling contact that the program solves and writes: name, points in contact, iterations, milliseconds."""
    file = os.path.join(EXAMPLES, "half_space_rolling.prm")
    analyses, _ = run_ours(chosen, file, folder, Output__Contact_problems="true", Rolling__Grids="one",
                           Contact__Grid_spacing=0.0015 if chosen.quick else 0.001)
    case = analyses["quasi_static_rolling"]["cases"][0]
    os.replace(os.path.join(folder, "ours", "contact_problems", "case_0.h5"), os.path.join(folder, "half_space_rolling.h5"))
    return [("half_space_rolling", case["contact_points"], case["iterations"], 1e3 * case["seconds"])]


def compare_contact(chosen):
    """One row per problem and method."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        problems = written_problem(chosen, folder)
        if not chosen.quick:
            for name, _, contacts, iterations, _, ms in chosen.bench.executable("solve_contact_problems", folder):
                problems.append((name, int(contacts), int(iterations), float(ms)))
        for name, contacts, iterations, ms in problems:
            stored = read_problem(os.path.join(folder, name + ".h5"))
            if stored is None:
                continue
            W, q, mu, ours = stored
            rows.append((name, len(mu), contacts, "ours", iterations, residual(W, q, mu, ours), 0., ms, 1.))
            for method, most in (("NSN_AC", 100), ("ADMM", 5000), ("NSGS", 300 if chosen.quick else 2000)):
                r, used, seconds, converged = solve_by_siconos(W, q, mu, method, most)
                off = np.linalg.norm(r - ours) / np.linalg.norm(ours)
                rows.append((name, len(mu), contacts, method if converged else method + ", not converged", used, residual(W, q, mu, r), off,
                             1e3 * seconds, 1e3 * seconds / ms))
                require(not converged or off < 1e-7, f"{name}: forces of {method} differ by {off:.1e}")
            require(any(row[0] == name and row[3] == "NSN_AC" for row in rows), f"{name}: Siconos' Newton method does not converge")
    write_table(chosen.output, "siconos_contact", "Contact problems at a given approach, cold: residual in Vibrocontact's measure, difference of forces to ours over their norm",
                ("problem", "points", "in_contact", "method", "iterations", "residual", "difference", "ms", "over_ours"), rows)


def main():
    chosen = options(__doc__)
    compare_bar(chosen)
    compare_contact(chosen)


if __name__ == "__main__":
    main()

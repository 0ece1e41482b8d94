"""Integrators of motions in time: theta, exact propagation, step, reaction, model."""
import math

import program
from study import Point, Study

FREE = "contrib/benchmarks/free_bar.prm"
IMPACT = "parameter_files/examples/bouncing_bar.prm"
INTEGRATOR, REACTION, MODEL = "Transient/Integrator", "Transient/Reaction", "Transient/Model"
THETAS = (0.5, 0.55, 1.)


def marches(bench, file, entries, read=None):
    runs = bench.run(file, {"Transient/Error estimate": "false", **entries}, read=read)
    found = runs.analysis("transient")
    return runs, found, [run["analyses"]["transient"]["seconds_per_step"] * found["steps"] for run in runs.results]


def integrators():
    """Name, entries, whether the default: theta 1/2."""
    yield from ((f"theta = {theta:g}", {INTEGRATOR: "theta method", "Transient/Theta": theta}, theta == 0.5) for theta in THETAS)
    yield "exact propagator", {INTEGRATOR: "exact propagator"}, False


def free(bench):
    """First mode of a bar: u = v / omega_d exp(-zeta omega t) sin(omega_d t), omega = pi c / (2 L)."""
    omega, zeta, velocity = math.pi / 2 * math.sqrt(200e9 / 8000), 1e-3, 0.3
    damped = omega * math.sqrt(1 - zeta ** 2)

    def error(folder):
        rows = program.read_table(f"{folder}/histories.csv")
        name = next(column for column in rows[0] if column.startswith("tip") and "displacement" in column)
        exact = [velocity / damped * math.exp(-zeta * omega * t) * math.sin(damped * t)
                 for t in (float(row["time_s"]) for row in rows)]
        found, largest = [float(row[name]) for row in rows], max(map(abs, exact))
        # the sign of a mode shape is free: that of the first large sample holds for all
        first = next(k for k, one in enumerate(exact) if abs(one) > largest / 2)
        sign = math.copysign(1, found[first] * exact[first])
        return max(abs(sign * value - one) for value, one in zip(found, exact)) / largest

    points = []
    for name, entries, default in integrators():
        for step in (4e-6, 1e-6) if bench.quick else (1.6e-5, 4e-6, 1e-6, 2.5e-7):
            runs, _, seconds = marches(bench, FREE, {**entries, "Transient/Time step": step}, read=error)
            points.append(Point(f"{name}, step {step:g} s", name, seconds, runs.read[-1], default and step == 1e-6, entries))
    return points


def impact(bench):
    """A bar thrown against a stop: impulse 2 m v, all energy kept."""
    points = []
    variants = [(f"{name}, {reaction}, reduced", {**entries, REACTION: reaction, MODEL: "reduced"}, default and reaction == "as other forces")
                for name, entries, default in integrators() for reaction in ("as other forces", "end of step")
                if not (reaction == "end of step" and "exact" in name)]
    elements = {INTEGRATOR: "theta method", MODEL: "finite elements", "bar/Bar/Divisions": 200, "bar/Bar/Element degree": 1,
                "bar/Modes/Count": 4}
    variants += [("theta = 0.5, as other forces, elements with a massless node",
                  {**elements, REACTION: "as other forces", "bar/Bar/Massless contact node": "true"}, False),
                 ("theta = 0.5, end of step, elements", {**elements, REACTION: "end of step"}, False)]
    for name, entries, default in variants:
        for step in (4e-3, 1e-3) if bench.quick else (8e-3, 4e-3, 2e-3, 1e-3, 5e-4):
            _, found, seconds = marches(bench, IMPACT, {**entries, "Transient/Time step": step})
            error = max(abs(found["impulse_Ns"] / 200 - 1), abs(found["energy"]["stored_J"] / 500 - 1))
            points.append(Point(f"{name}, step {step:g} s", name, seconds, error, default and step == 1e-3, entries))
    return points


STUDIES = [
    Study("transient_free", "Free motion of a bar's first mode", "the damped oscillation in closed form, 62 periods.",
          "seconds of all steps [s]", "largest error of the displacement over its amplitude [-]",
          {INTEGRATOR: ["theta method", "exact propagator"]}, free, floor=1e-9,
          reason="motions in contact are what marches are for, and there it is on the front (transient_impact): the propagator's reactions, "
                 "linear in the step, ring beyond a step of 2.7 sqrt(W / Psi Psi^T); scripts set Transient/Theta, which it would refuse."),
    Study("transient_impact", "A bar thrown against a rigid stop", "impulse 2 m v and energy kept, in closed form (d'Alembert).",
          "seconds of all steps [s]", "larger relative error of impulse and energy [-]",
          {INTEGRATOR: ["theta method", "exact propagator"], REACTION: ["as other forces", "end of step"],
           MODEL: ["reduced", "finite elements"]}, impact, floor=1e-6)]

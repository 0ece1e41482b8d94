"""A body known by its poles on a road: propagation, theta, direct, block and event-located; shape of the force; contact solver."""
import glob
import math

import program
from study import Point, Study

MASS = "parameter_files/examples/oscillator_on_sine.prm"
ROLLING_TYRE = "parameter_files/examples/tyre_rolling.prm"
RIGID_TYRE = "contrib/benchmarks/rigid_tyre.prm"
TYRE = "parameter_files/examples/tyre_three_points.prm"
DEFAULT = "modal recursion"
METHODS = [DEFAULT, "theta method", "direct convolution", "block convolution", "direct convolution, scalar", "event located"]
METHOD, SHAPE, SOLVER = "Modal convolution/Method", "Modal convolution/Force shape", "Modal convolution/Contact solver"


SAMPLES = 2e-4  # the histories' interval [s], a multiple of all steps


def march(bench, file, step, end, entries, repetitions=None):
    """Impulses of all points with the rms force, displacements and forces of all points over time, and the seconds of each run."""
    def histories(folder):
        tables = [program.read_table(f"{folder}/contact_point_{k}.csv") for k in range(len(glob.glob(f"{folder}/contact_point_*.csv")))]
        return {column: [[float(row[column]) for row in table] for table in tables] for column in ("time_s", "displacement_m", "force_N")}
    runs = bench.run(file, {"Modal convolution/Time step": step, "Modal convolution/End time": end,
                            "Modal convolution/History interval": SAMPLES, "Modal convolution/Error estimate": "false", **entries},
                     repetitions=repetitions, read=histories)
    found = runs.analysis("modal_convolution")
    numbers = [*found["impulse_Ns"], found["rms_force_N"]]
    return numbers, runs.read[-1], [run["analyses"]["modal_convolution"]["seconds_per_step"] * found["steps"] for run in runs.results]


def error(found, truth):
    return max(abs(one / other - 1) for one, other in zip(found, truth))


def rms_error(found, truth):
    """Of histories of all points that may differ by their last sample."""
    pairs = [pair for one, other in zip(found, truth) for pair in zip(one, other)]
    return math.sqrt(sum((a - b) ** 2 for a, b in pairs) / sum(b ** 2 for _, b in pairs))


def closed_form(times):
    """Impulse [N s] of the oscillator on the sine, with that of its start, and its displacements [m] at these times, before it comes down
    again: it follows the road while the force it needs presses, then it swings freely about its equilibrium under its weight."""
    K, M, A, weight = 4e5, 1., 5e-3, 9.81
    C, omega = 2 * 0.02 * math.sqrt(K * M), 2 * math.pi * 0.1 / 0.025
    S, Q = A * (K - M * omega ** 2), A * C * omega
    low, high = 0.12, 0.13  # the force falls through zero between the two [s]
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if S * math.sin(omega * middle) + Q * math.cos(omega * middle) + weight > 0 else (low, middle)
    impulse = M * A * omega + S / omega * (1 - math.cos(omega * low)) + Q / omega * math.sin(omega * low) + weight * low
    decay, rest = C / (2 * M), -weight / K
    swing = math.sqrt(K / M - decay ** 2)
    u, v = A * math.sin(omega * low) - rest, A * omega * math.cos(omega * low)

    def flight(t):
        return rest + math.exp(-decay * t) * (u * math.cos(swing * t) + (v + decay * u) / swing * math.sin(swing * t))
    return impulse, [A * math.sin(omega * t) if t < low else flight(t - low) for t in times]


def rigid(bench):
    """The oscillator on the sine: displacement over time, and impulse. Forces at the steps of a rigid impact grow as the step becomes
    shorter. Direct sums take the whole memory of the run."""
    def errors(found, motion):
        impulse, displacements = closed_form(motion["time_s"][0])
        return rms_error(motion["displacement_m"], [displacements]), {"impulse": abs(found[0] / impulse - 1)}
    end = 0.2
    event, motion, event_seconds = march(bench, MASS, 1e-4, end, {METHOD: "event located"})
    wrong, impulse = errors(event, motion)
    points = [Point("event located", "event located", event_seconds, wrong, False, {METHOD: "event located"}, impulse)]
    for method in METHODS[:-1]:
        for step in (1e-4, 1e-5) if bench.quick or "direct" in method else (1e-4, 1e-5, 1e-6):
            entries = {METHOD: method}
            if "convolution" in method:
                entries["Modal convolution/Memory"] = end
            found, its_motion, seconds = march(bench, MASS, step, end, entries)
            wrong, impulse = errors(found, its_motion)
            points.append(Point(f"{method}, step {step:g} s", method, seconds, wrong, method == DEFAULT and step == 1e-5,
                                {METHOD: method, SHAPE: "impulse"}, impulse))
    return points


def rigid_tyre(bench):
    """Three rigid points of a ring of 60 orders on a random road: displacements over time, and impulses. Which impacts a step resolves is
    a matter of chance: shorter motions favour one method or the other by some 15 %."""
    end = 0.2
    event, motion, event_seconds = march(bench, RIGID_TYRE, 2e-5, end, {METHOD: "event located"})
    finest, finest_motion, _ = march(bench, RIGID_TYRE, 1e-6, end, {METHOD: DEFAULT}, repetitions=1)

    def point(label, method, step, seconds, found, its_motion, truth, true_motion):
        impulse = max(abs(one - other) for one, other in zip(found[:-1], truth[:-1])) / max(truth[:-1])
        return Point(label, method, seconds, rms_error(its_motion["displacement_m"], true_motion["displacement_m"]),
                     method == DEFAULT and step == 2e-5, {METHOD: method, SHAPE: "impulse"}, {"impulse": impulse})
    points = [point("event located", "event located", 0, event_seconds, event, motion, finest, finest_motion)]
    for method in METHODS[:-1]:
        for step in (2e-5,) if bench.quick else (4e-5, 2e-5, 1e-5, 5e-6):
            entries = {METHOD: method, **({"Modal convolution/Memory": end} if "convolution" in method else {})}
            found, its_motion, seconds = march(bench, RIGID_TYRE, step, end, entries)
            points.append(point(f"{method}, step {step:g} s", method, step, seconds, found, its_motion, event, motion))
    return points


def tread(bench):
    """Three points with tread on a random road, forces over time and what is summed of them: shapes of the force and contact solvers of
    the default method, and the methods."""
    end = 0.05
    finest, finest_motion, _ = march(bench, TYRE, 1e-6, end, {METHOD: "theta method", SHAPE: "linear"}, repetitions=1)
    other, other_motion, _ = march(bench, TYRE, 1e-6, end, {METHOD: DEFAULT, SHAPE: "linear"}, repetitions=1)
    points = []
    variants = [(DEFAULT, shape, solver) for shape in ("constant", "linear") for solver in ("automatic", "common")]
    variants += [(method, "linear", "automatic") for method in METHODS[1:-1]]
    for method, shape, solver in variants:
        for step in (2e-5,) if bench.quick else (4e-5, 2e-5, 1e-5):
            entries = {METHOD: method, SHAPE: shape, SOLVER: solver}
            if "convolution" in method:
                entries["Modal convolution/Memory"] = end
            found, motion, seconds = march(bench, TYRE, step, end, entries)
            truth, true_motion = (other, other_motion) if method == "theta method" else (finest, finest_motion)
            points.append(Point(f"{method}, {shape}, {solver}, step {step:g} s", f"{method}, {shape}, {solver}", seconds,
                                rms_error(motion["force_N"], true_motion["force_N"]),
                                method == DEFAULT and (shape, solver) == ("linear", "automatic") and step == 2e-5, entries,
                                {"impulse and rms force": error(found, truth)}))
    return points


def many(bench):
    """Hundreds of points of a rolling tyre: impulses of all of them and the rms force, by the kept inverse and by products."""
    points, method, tolerance = 300 if bench.quick else 900, "Contact/Solver/Method", "Contact/Solver/Tolerance"
    scene = {"tyre/Ring/Contact points": points, "tyre/Ring/Contact spacing": 0.12 / points, "tyre/Ring/Tread stiffness": 4032000 / points,
             "Output/Figures": "false"}
    products = {SOLVER: "common", method: "projected jacobi"}
    by_solver = {SOLVER + " = automatic": {SOLVER: "automatic"}, SOLVER + " = active set": {SOLVER: "active set"},
                 **{f"{method} = projected jacobi, tolerance {value:g}": {**products, tolerance: value} for value in (1e-6, 1e-8, 1e-13)}}
    runs = {label: march(bench, ROLLING_TYRE, 1.953125e-5, 0.1, {**scene, **entries}) for label, entries in by_solver.items()}
    inverse, iterated = runs[SOLVER + " = active set"][0], runs[f"{method} = projected jacobi, tolerance 1e-13"][0]

    def of_largest(found, truth):
        *impulses, rms = truth
        return max(max(abs(one - other) for one, other in zip(found, impulses)) / max(impulses), abs(found[-1] / rms - 1))
    return [Point(label.split("/")[-1], label.split("/")[-1].split(", ")[0], seconds,
                  of_largest(found, iterated if found is inverse else inverse), "automatic" in label, by_solver[label])
            for label, (found, _, seconds) in runs.items()]


STUDIES = [
    Study("convolution_rigid", "Rigid point of an oscillator on a sine",
          truth="the closed form: on the road while the force presses, then the free swing.",
          cost="processor time of 0.2 s of motion [s]", error="displacement, rms error over rms [-]", floor=1e-9,
          choices={METHOD: METHODS, SHAPE: ["impulse"]}, measure=rigid, further={"impulse": "impulse: relative error [-]"}),
    Study("convolution_impacts", "Three rigid points of a tyre on a random road",
          truth="the exact motion between touches and releases (event located); for that method itself modal recursion in steps of 1e-6 s.",
          cost="processor time of 0.2 s of motion [s]", error="displacements, rms error over rms [-]", floor=1e-7,
          choices={METHOD: METHODS, SHAPE: ["impulse"]}, measure=rigid_tyre,
          further={"impulse": "impulses: error over the largest [-]"}),
    Study("convolution_tread", "Three points of a tyre with tread on a random road",
          truth="the theta method in steps of 1e-6 s, another integrator; for the theta method itself modal recursion in "
                "such steps.",
          cost="processor time of 0.05 s of motion [s]", error="contact forces, rms error over rms [-]",
          floor=1e-6, choices={METHOD: METHODS[:-1], SHAPE: ["constant", "linear"], SOLVER: ["automatic", "common"]}, measure=tread,
          further={"impulse and rms force": "impulses, rms force: relative error [-]"}),
    Study("convolution_many", "Hundreds of points of a rolling tyre",
          truth="the active set with its kept inverse; for that itself products to 1e-13: they share the poles and their steps, not the contact.",
          cost="processor time of 0.1 s of motion [s]", error="impulses over the largest, rms force: largest error [-]", floor=1e-15,
          choices={SOLVER: ["automatic", "active set", "common"], "Contact/Solver/Method": ["projected jacobi"]}, measure=many)]

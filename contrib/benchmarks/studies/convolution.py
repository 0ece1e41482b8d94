"""A body known by its poles on a road: propagation, theta, direct, block and event-located; shape of the force; contact solver."""
import math

import program
from study import Point, Study

MASS = "parameter_files/examples/oscillator_on_sine.prm"
TYRE = "parameter_files/examples/tyre_three_points.prm"
DEFAULT = "modal recursion"
METHODS = [DEFAULT, "theta method", "direct convolution", "block convolution", "direct convolution, scalar", "event located"]
METHOD, SHAPE, SOLVER = "Modal convolution/Method", "Modal convolution/Force shape", "Modal convolution/Contact solver"


SAMPLES = 2e-4  # the histories' interval [s], a multiple of all steps


def march(bench, file, step, end, entries, repetitions=None):
    """Impulses of all points with the rms force, displacement of the first point, and the seconds of each run."""
    def displacement(folder):
        return [float(row["displacement_m"]) for row in program.read_table(f"{folder}/contact_point_0.csv")]
    runs = bench.run(file, {"Modal convolution/Time step": step, "Modal convolution/End time": end,
                            "Modal convolution/History interval": SAMPLES, "Modal convolution/Error estimate": "false", **entries},
                     repetitions=repetitions, read=displacement)
    found = runs.analysis("modal_convolution")
    numbers = [*found["impulse_Ns"], found["rms_force_N"]]
    return numbers, runs.read[-1], [run["analyses"]["modal_convolution"]["seconds_per_step"] * found["steps"] for run in runs.results]


def error(found, truth):
    return max(abs(one / other - 1) for one, other in zip(found, truth))


def rms_error(found, truth):
    """Of histories that may differ by their last sample."""
    pairs = list(zip(found, truth))
    return math.sqrt(sum((a - b) ** 2 for a, b in pairs) / sum(b ** 2 for _, b in pairs))


def rigid(bench):
    """The oscillator on the sine, impulse and displacement. Direct sums take the whole memory of the run."""
    end = 0.2
    event, motion, event_seconds = march(bench, MASS, 1e-4, end, {METHOD: "event located"})
    finest, finest_motion, _ = march(bench, MASS, 1e-7, end, {METHOD: DEFAULT}, repetitions=1)
    points = [Point("event located", "event located", event_seconds,
                    max(error(event[:-1], finest[:-1]), rms_error(motion, finest_motion)), False, {METHOD: "event located"})]
    for method in METHODS[:-1]:
        for step in (1e-4, 1e-5) if bench.quick or "direct" in method else (1e-4, 1e-5, 1e-6):
            entries = {METHOD: method}
            if "convolution" in method:
                entries["Modal convolution/Memory"] = end
            found, its_motion, seconds = march(bench, MASS, step, end, entries)
            points.append(Point(f"{method}, step {step:g} s", method, seconds,
                                max(error(found[:-1], event[:-1]), rms_error(its_motion, motion)), method == DEFAULT and step == 1e-5,
                                {METHOD: method, SHAPE: "impulse"}))
    return points


def tread(bench):
    """Three points with tread on a random road: shapes of the force and contact solvers of the default method, and the methods."""
    end = 0.05
    finest, _, _ = march(bench, TYRE, 1e-6, end, {METHOD: "theta method", SHAPE: "linear"}, repetitions=1)
    other, _, _ = march(bench, TYRE, 1e-6, end, {METHOD: DEFAULT, SHAPE: "linear"}, repetitions=1)
    points = []
    variants = [(DEFAULT, shape, solver) for shape in ("constant", "linear") for solver in ("active set", "common")]
    variants += [(method, "linear", "active set") for method in METHODS[1:-1]]
    for method, shape, solver in variants:
        for step in (2e-5,) if bench.quick else (4e-5, 2e-5, 1e-5):
            entries = {METHOD: method, SHAPE: shape, SOLVER: solver}
            if "convolution" in method:
                entries["Modal convolution/Memory"] = end
            found, _, seconds = march(bench, TYRE, step, end, entries)
            truth = other if method == "theta method" else finest
            points.append(Point(f"{method}, {shape}, {solver}, step {step:g} s", f"{method}, {shape}, {solver}", seconds,
                                error(found, truth), method == DEFAULT and (shape, solver) == ("linear", "active set") and step == 2e-5,
                                entries))
    return points


POLES = ("its poles keep frequency and decay at any step, as models with poles to many kHz need; the theta method lowers each by the part (omega h)^2 / 12. "
         "Here, with few poles, the two are within a factor of three: theta better by impulses, the recursion by displacements.")
STUDIES = [
    Study("convolution_rigid", "Rigid point of an oscillator on a sine",
          truth="the exact motion between touches and releases (event located); for that method itself the limit of modal "
                "recursion, step 1e-7 s.",
          cost="processor time of 0.2 s of motion [s]", error="larger relative error of impulse and displacement (rms) [-]", floor=1e-7,
          choices={METHOD: METHODS, SHAPE: ["impulse"]}, measure=rigid, reason=POLES),
    Study("convolution_tread", "Three points of a tyre with tread on a random road",
          truth="the theta method in steps of 1e-6 s, another integrator; for the theta method itself modal recursion in "
                "such steps.",
          cost="processor time of 0.05 s of motion [s]", error="largest relative error, impulses of the points and rms force [-]",
          floor=1e-6, choices={METHOD: METHODS[:-1], SHAPE: ["constant", "linear"], SOLVER: ["active set", "common"]}, measure=tread,
          reason=POLES)]

"""Reduced models of the rolling equilibrium's roots, and roots followed along a sweep."""
import math

import program
from study import Point, Study

LAYER = "parameter_files/examples/sliding_layer.prm"
SEGMENT = "parameter_files/verification/reduced_stability/wheel_segment.prm"
SEGMENT_ROOTS = "parameter_files/verification/reduced_stability/baseline.csv"
MAP = "parameter_files/verification/followed_map/map.prm"
MODEL, LINEARISATION, FOLLOWED = "Stability/Model", "Stability/Linearisation", "Stability/Roots of a sweep"


def roots(folder):
    """Frequency and growth of every oscillating root."""
    rows = program.read_table(f"{folder}/stability.csv")
    return [(float(row["frequency_Hz"]), float(row["growth_1_s"])) for row in rows if float(row["frequency_Hz"]) > 0]


def error(found, exact):
    """Largest distance in the complex plane over the frequency, each root to the nearest."""
    def distance(a, b):
        return math.hypot(a[0] - b[0], (a[1] - b[1]) / (2 * math.pi))
    return max(min(distance(root, one) for one in found) / root[0] for root in exact)


def solve(bench, file, entries, repetitions=None):
    runs = bench.run(file, {"Analyses": "stability", **entries}, read=roots, repetitions=repetitions)
    return runs.read[-1], [run["analyses"]["stability"]["cases"][0]["seconds"] for run in runs.results]


def layer(bench):
    """Three lowest unstable pairs of the sliding layer. The number of modes has no default: marked is the smallest within 1 %."""
    exact, seconds = solve(bench, LAYER, {MODEL: "finite elements"})
    compared = [root for root in exact if root[1] > 1e-6 * root[0]][:3]
    finer, _ = solve(bench, LAYER, {MODEL: "attachment inertia", "layer/Modes/Count": 250})
    points = [Point("finite elements", "finite elements", seconds, error(finer, compared), False, {MODEL: "finite elements"})]
    for model in ("reduced", "attachment inertia"):
        for count in (20, 40, 60) if bench.quick else (10, 20, 40, 60, 80, 160):
            found, seconds = solve(bench, LAYER, {MODEL: model, "layer/Modes/Count": count})
            points.append(Point(f"{model}, {count} modes", model, seconds, error(found, compared), model == "reduced" and count == 40,
                                {MODEL: model}))
    return points


def segment(bench):
    """A segment of a wheel on a rigid crown; the roots by elements take five minutes and are stored."""
    with open(f"{program.ROOT}/{SEGMENT_ROOTS}", encoding="utf-8") as file:
        stored = next(line for line in file if line.startswith("segment,finite elements")).split(",")[3]
    exact = [(float(words[0]), float(words[2])) for words in (one.split() for one in stored.split(";")) if words]
    points = []
    for name, entries in (("reduced, consistent", {MODEL: "reduced", LINEARISATION: "consistent"}),
                          ("reduced, paper", {MODEL: "reduced", LINEARISATION: "paper"}),
                          ("attachment inertia", {MODEL: "attachment inertia"})):
        for count in (10, 20, 40, 80):
            found, seconds = solve(bench, SEGMENT, {**entries, "segment/Modes/Count": count}, min(2, bench.repetitions))
            points.append(Point(f"{name}, {count} modes", name, seconds, error(found, exact), name == "reduced, consistent" and count == 40,
                                entries))
    return points


def sweep(bench):
    """Growth of the unstable roots over friction by both ways; each is the other's truth."""
    def growths(folder):
        return ([case["unstable"] for case in program.read_json(f"{folder}/results.json")["analyses"]["stability"]["cases"]],
                len(program.read_table(f"{folder}/stability.csv")))
    entries = {"Stability/Sweep/Entry": "Contact/Friction coefficient", "Stability/Sweep/Second entry": "",
               "Stability/Sweep/Second range": ""}
    # the reduction, into the cache
    bench.run(MAP, {**entries, "Stability/Sweep/Range": "0.05, 0.1, 0.05"}, cached=True, repetitions=1)
    found = {}
    for way in ("complete", "followed"):
        runs = bench.run(MAP, {**entries, FOLLOWED: way, "Stability/Sweep/Range": "0.05, 0.5, 0.015"}, cached=True, read=growths)
        found[way] = (runs.read[-1], runs.processor)
    (complete, n_all), (followed, _) = found["complete"][0], found["followed"][0]
    worst = 0.
    for ours, others in zip(complete, followed):
        if len(ours) != len(others):
            worst = math.inf
        for root in ours:
            near = min(others, key=lambda other: abs(other["frequency_Hz"] - root["frequency_Hz"]), default=None)
            worst = max(worst, abs(near["growth_1_s"] - root["growth_1_s"]) / root["frequency_Hz"] if near else math.inf)
    return [Point(way, way, seconds, worst, way == "complete", {FOLLOWED: way}, {"roots not listed": 1 - n_roots / n_all})
            for way, ((_, n_roots), seconds) in found.items()]


STUDIES = [
    Study("stability_layer", "Roots of a sliding layer by reduced models",
          "all dofs of the elements; for these themselves the model with inertia of its attachments and nearly all modes.",
          "seconds of the eigenvalues [s]", "largest distance of three unstable roots over their frequency [-]",
          {MODEL: ["reduced", "attachment inertia", "finite elements"]}, layer, floor=1e-8),
    Study("stability_segment", "Roots of a wheel's segment by reduced models",
          "all dofs of the elements, stored by parameter_files/verification/reduced_stability.", "seconds of the eigenvalues [s]",
          "largest distance of the lowest roots over their frequency [-]",
          {MODEL: ["reduced", "attachment inertia"], LINEARISATION: ["consistent", "paper"]}, segment, quick=False, floor=1e-5),
    Study("stability_sweep", "Roots over friction, 31 values", "the two ways against each other: all roots by LAPACK, and Newton's method "
          "from the roots of the value before.", "processor time of the whole program [s]", "growth over frequency: difference [-]",
          {FOLLOWED: ["complete", "followed"]}, sweep, quick=False, floor=1e-8, further={"roots not listed": "share of the roots not listed [-]"})]

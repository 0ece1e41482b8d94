"""Fits of poles to receptances: methods and numbers of pairs."""
from study import Point, Study

FILE = "parameter_files/examples/identify_tyre.prm"
METHODS = ["vector fitting", "lsce", "lsce with real amplitudes (as in the paper)"]


def measure(bench):
    numbers = [16, 25] if bench.quick else [8, 12, 16, 20, 25, 32]
    points = []
    for method in METHODS:
        # the program's list has the paper's method by its short name
        runs = bench.run(FILE, {"Identification/Method": method.split(" (")[0], "Identification/Stabilisation chart": "false",
                                "Identification/Numbers of pole pairs": ", ".join(map(str, numbers))})
        for k, number in enumerate(numbers):
            fits = [run["analyses"]["identification"][k] for run in runs.results]
            points.append(Point(f"{method}, {number} pairs", method, [fit["seconds"] for fit in fits], fits[0]["error_E"],
                                method == METHODS[0] and number == 25, {"Identification/Method": method}))
    return points


STUDIES = [Study(
    "identification", "Poles of a ring's receptances",
    truth="the receptances themselves, the closed form of the ring order by order (parameter_files/examples/data/ring_at_rest.py).",
    cost="seconds of a fit, made passive [s]", error="E of Meftah & Duhamel (2011), worst entry [-]",
    choices={"Identification/Method": METHODS}, measure=measure, floor=1e-6)]

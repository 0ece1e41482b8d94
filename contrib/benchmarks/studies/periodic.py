"""Periodic motions: bases, forms, laws, numbers of functions, models; stability along a response curve."""
from study import Point, Study

BAR = "parameter_files/examples/axial_bar_150.prm"
RIGID_BAR = "parameter_files/examples/axial_bar_signorini.prm"
BAR_RESPONSE = "parameter_files/examples/axial_bar_response.prm"
WAVELETS = [f"daubechies{order}" for order in range(6, 40, 2)]
BASES = ["fourier", "bspline", "haar", *WAVELETS]
TRIAL, WEIGHTING, FORM, LAW, MODEL = ("Periodic/Trial basis", "Periodic/Weighting basis", "Periodic/Form", "Periodic/Law",
                                      "Periodic/Model")
SHOOTING = "shooting in time on the same finite elements under the same law (Periodic/Reference)."
NO_COMPARISON = {"Periodic/Comparison/Pairs": "", "Periodic/Comparison/Numbers": ""}


def solutions(runs):
    """Converged solutions of the runs, each with its seconds in all of them."""
    for k, found in enumerate(runs.analysis("periodic")):
        if found["converged"] and found["error_to_reference"] < 1:
            yield found, [run["analyses"]["periodic"][k]["seconds"] for run in runs.results]


def bases(file):
    """Function that measures all bases with themselves, and the paper's mixed pairs. Default: 127 functions of Fourier."""
    def measure(bench):
        pairs = [f"{basis}:{basis}" for basis in BASES if basis != "haar"]
        pairs += ["haar:fourier", "haar:bspline", "daubechies6:fourier"]
        numbers = [32, 64] if bench.quick else [16, 32, 64, 127, 128]
        runs = bench.run(file, {"Periodic/Number of functions": 127, "Periodic/Comparison/Pairs": ", ".join(pairs),
                                "Periodic/Comparison/Numbers": ", ".join(map(str, numbers)),
                                "Periodic/Comparison/Force phases": 1 if bench.quick else 8})
        points = []
        for found, seconds in solutions(runs):
            label = f"{found['basis']}:{found['weighting']}, {found['n_functions']}"
            if all(point.label != label for point in points):
                points.append(Point(label, label.split(",")[0], seconds, found["error_to_reference"], label == "fourier:fourier, 127",
                                    {TRIAL: found["basis"], WEIGHTING: found["weighting"]}))
        return points
    return measure


def forms(bench):
    """Forms of the residual, laws, models of the bar; weighting by Haar's functions, which only the strong form takes."""
    variants = [(form, "penalty", "finite elements", "fourier:fourier") for form in ("strong", "weak", "distributional")]
    variants += [("distributional", "linear", "finite elements", "fourier:fourier"),
                 ("distributional", "signorini", "finite elements", "fourier:fourier"),
                 ("distributional", "penalty", "reduced", "fourier:fourier"),
                 ("strong", "penalty", "finite elements", "fourier:haar"), ("strong", "penalty", "finite elements", "bspline:haar")]
    points = []
    for form, law, model, pair in variants:
        trial, weighting = pair.split(":")
        curve = f"{form}, {law}, {model}" + ("" if trial == weighting else f", {pair}")
        for number in (64, 127) if bench.quick else (16, 32, 64, 127, 255):
            if weighting == "haar" and number % 2:
                number += 1
            entries = {FORM: form, LAW: law, MODEL: model, TRIAL: trial, WEIGHTING: weighting}
            runs = bench.run(RIGID_BAR if law == "signorini" else BAR, {**NO_COMPARISON, **entries, "Periodic/Number of functions": number})
            for found, seconds in solutions(runs):
                points.append(Point(f"{curve}, {number}", curve, seconds, found["error_to_reference"],
                                    (form, law, model, number) == ("distributional", "penalty", "reduced", 127), entries))
    return points


def stability(bench):
    """A multiplier is one at a fold: how far the nearest one is from it. Marked: the default method with the file's number of functions."""
    points = []
    for method in ("monodromy", "hill"):
        for number in (63,) if bench.quick else (31, 63, 127):
            runs = bench.run(BAR_RESPONSE, {"Periodic/Continuation/Pairs": "", "Periodic/Continuation/Stability": method,
                                            "Periodic/Number of functions": number})
            found = runs.analysis("response")
            seconds = [run["analyses"]["response"]["stability_seconds"] for run in runs.results]
            points.append(Point(f"{method}, {number} functions", method, seconds,
                                max(abs(abs(one) - 1) for one in found["multiplier_at_folds"]), (method, number) == ("monodromy", 63),
                                {"Periodic/Continuation/Stability": method}))
    return points


ALL_BASES = {TRIAL: BASES, WEIGHTING: [basis for basis in BASES if basis != "haar"]}
COST, ERROR = "seconds of one solution [s]", "relative rms error of the displacement [-]"
STUDIES = [
    Study("periodic_penalty", "Bases of periodic motions, penalty", "Displacements against " + SHOOTING, COST, ERROR, ALL_BASES,
          bases(BAR), floor=1e-6),
    Study("periodic_rigid", "Bases of periodic motions, rigid stop", "Displacements against " + SHOOTING, COST, ERROR,
          {TRIAL: ["fourier", "bspline", "daubechies6", "haar"]}, bases(RIGID_BAR), floor=1e-6, quick=False),
    Study("periodic_forms", "Forms, laws and models of periodic motions", "Displacements against " + SHOOTING, COST, ERROR,
          {FORM: ["strong", "weak", "distributional"], LAW: ["penalty", "linear", "signorini"], MODEL: ["reduced", "finite elements"],
           WEIGHTING: ["fourier", "haar"]},
          forms, floor=1e-6),
    Study("periodic_stability", "Multipliers along a response curve", "at a fold a multiplier is one, whatever the motion.",
          "seconds of the multipliers of the curve [s]", "largest distance of the multiplier at the folds from one [-]",
          {"Periodic/Continuation/Stability": ["monodromy", "hill"]}, stability, floor=1e-6)]

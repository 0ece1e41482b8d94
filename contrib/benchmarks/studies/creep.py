"""Creep schemes and grids on random cases at random alignments of the grid."""
import math
import os
import sys

import program
from study import Point, Study

sys.path.insert(0, os.path.join(program.ROOT, "parameter_files", "verification", "creep_extrapolation"))
import creep_cases  # noqa: E402

SCHEMES = ["first-order upwind", "second-order upwind"]


# two grids take schemes of their own
VARIANTS = [("first order, one grid", {"Rolling/Grids": "one", "Contact/Creep scheme": SCHEMES[0]}),
            ("second order, one grid", {"Rolling/Grids": "one", "Contact/Creep scheme": SCHEMES[1]}),
            ("two grids", {"Rolling/Grids": "two"}), ("automatic", {"Rolling/Grids": "automatic"})]


def measure(bench):
    """Mean error and whole cost of the stored cases; refined: spacing of the case over the one used."""
    cases = creep_cases.stored()[:6 if bench.quick else None]
    points = []
    for name, entries in VARIANTS:
        for refined in ((1,) if bench.quick else (0.5, 1, 2)):
            # 30 cases are a mean already
            repetitions = min(bench.repetitions, 3)
            seconds, error = [0.] * repetitions, 0.
            for case in cases:
                runs = bench.run(creep_cases.FILE, {**creep_cases.settings(case, refined), **entries}, repetitions=repetitions)
                force = creep_cases.over_friction(case, runs.analysis("quasi_static_rolling")["cases"][0])
                error += math.hypot(force[0] - case["fx"], force[1] - case["fy"]) / len(cases)
                seconds = [total + run["analyses"]["quasi_static_rolling"]["cases"][0]["seconds"]
                           for total, run in zip(seconds, runs.results)]
            points.append(Point(f"{name}, h / {refined}", name, seconds, error, name == "automatic" and refined == 1, entries))
    return points


STUDIES = [Study(
    name="creep", title="Creep schemes and grids, random cases at random alignments",
    truth="limits of the creep force of 30 random cases (axes, friction, creepages, spin, alignment) by refinement with both schemes, "
          "parameter_files/verification/creep_extrapolation.",
    cost="seconds of the rolling contact of all cases", error="mean error of the force over mu N [-]", floor=2e-4,
    choices={"Contact/Creep scheme": SCHEMES, "Rolling/Grids": ["automatic", "one", "two"]}, measure=measure)]

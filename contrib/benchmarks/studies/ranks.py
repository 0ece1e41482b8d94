"""One and two ranks: the same frequencies of a solid wheel, seconds of the clock."""
from study import Point, Study

from .reduction import finest_wheel, frequency_error, wheel_frequencies

LIMIT = 2000


def measure(bench):
    exact = finest_wheel(bench, LIMIT)
    points = []
    for division in (0.24,) if bench.quick else (0.24, 0.12):
        for ranks in (1, 2):
            found, runs = wheel_frequencies(bench, {"wheel/Wheel/Coarse division": division, "wheel/Wheel/Contact division": division,
                                                    "wheel/Modes/Upper frequency": LIMIT}, ranks=ranks, repetitions=1 if bench.quick else min(3, bench.repetitions))
            points.append(Point(f"{ranks} ranks, cells of {division:g} m", f"{ranks} ranks", runs.clock, frequency_error(found, exact),
                                ranks == 1 and division == 0.24, {}))
    return points


STUDIES = [Study("ranks", "A solid wheel on one and two ranks", "the section by harmonics of degree 4 with halved cells.",
                 "seconds of the clock, whole program [s]", "largest relative error of all frequencies below 2 kHz [-]", {}, measure,
                 floor=1e-5, reason="mpirun says how many ranks there are, not the program.")]

"""What a study of error against cost is made of, and which of its points lie on its front."""
import statistics
from dataclasses import dataclass, field

CHEAPER = 1.15  # medians closer than that are equal: repeated runs differ as much
MORE_EXACT = 1.1
EQUAL = 1 + 1e-6  # errors of two ways to the same numbers differ by rounding


@dataclass
class Point:
    """One choice on a picture.

    label    what was chosen, unique in its study ("two grids, h = 1 mm")
    curve    points of the same curve are joined and share a colour: usually the member
    seconds  cost of each repeated run [s]
    error    against the truth of the study, in the unit of the study's error
    default  true for what the program does without being told
    choices  value by entry of the parameter file ("Contact/Creep scheme": "first-order upwind")
    further  errors of the study's further quantities, by their names
    """
    label: str
    curve: str
    seconds: list
    error: float
    default: bool = False
    choices: dict = field(default_factory=dict)
    further: dict = field(default_factory=dict)

    @property
    def median(self):
        return statistics.median(self.seconds)

    @property
    def spread(self):
        """Largest over smallest cost of the repeated runs."""
        return max(self.seconds) / max(min(self.seconds), 1e-12)


@dataclass
class Study:
    """One picture.

    truth    the sentence that names the independent truth of the errors, for the caption
    cost     what the seconds count ("processor time of the contact solution [s]")
    error    what the error is, with its unit
    choices  members by entry that are on the picture; a measured study must hold all of them
    measure  function of a bench (program.Bench) that returns the points
    quick    whether run.py --quick runs it
    floor    errors below are round-off or the truth's own error, and count as equal
    reason   why the default stays although the picture shows better ones, else empty
    further  errors of other quantities that are asked of the same runs: what each is, with its unit, by a short name. A point then
             beats another only if it is no less exact in any of them
    """
    name: str
    title: str
    truth: str
    cost: str
    error: str
    choices: dict
    measure: object
    quick: bool = True
    floor: float = 1e-12
    reason: str = ""
    further: dict = field(default_factory=dict)
    points: list = field(default_factory=list)

    def run(self, bench):
        """Measures and checks what came: each member on the picture, a default, labels that differ."""
        self.points = self.measure(bench)
        labels = [point.label for point in self.points]
        if len(set(labels)) < len(labels):
            raise RuntimeError(f"study {self.name}: two points have the same label: {sorted(labels)}")
        if not any(point.default for point in self.points):
            raise RuntimeError(f"study {self.name}: no point is the program's default")
        for entry, members in self.choices.items():
            missing = set(members) - {point.choices.get(entry) for point in self.points}
            if missing and not bench.quick:
                raise RuntimeError(f"study {self.name}: no point shows {entry} = {', '.join(sorted(missing))}")

    def quantities(self):
        """Names of the errors: "" of the first, then those of further ones."""
        return ["", *self.further]

    def error_of(self, point, quantity):
        return max(point.further[quantity] if quantity else point.error, self.floor)

    def dominates(self, one, other, quantities):
        """Whether one is clearly cheaper and no less exact than other, or clearly more exact, in no quantity clearly less, and not
        clearly dearer."""
        errors = [(self.error_of(one, quantity), self.error_of(other, quantity)) for quantity in quantities]
        cheaper = one.median * CHEAPER < other.median and max(one.seconds) < min(other.seconds)
        more_exact = any(ours * MORE_EXACT < theirs for ours, theirs in errors) and all(ours <= theirs * MORE_EXACT for ours, theirs in errors)
        return (cheaper and all(ours <= theirs * EQUAL for ours, theirs in errors)) or (more_exact and one.median < other.median * CHEAPER)

    def better_than(self, point, quantities=None):
        """Points that beat a point, by all errors or by some of them alone."""
        return [other for other in self.points if self.dominates(other, point, self.quantities() if quantities is None else quantities)]

    def front(self, quantities=None):
        """Points that no other one beats, by cost."""
        return sorted((point for point in self.points if not self.better_than(point, quantities)), key=lambda point: point.median)

    def defaults_off_front(self):
        return [point for point in self.points if point.default and self.better_than(point)]

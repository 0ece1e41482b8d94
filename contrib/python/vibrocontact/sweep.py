"""Many runs of one case: sweeps over values, and an objective for an optimiser."""
from __future__ import annotations

import itertools
import os
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .case import Case
from .errors import InputError, NotConverged, VibrocontactError
from .results import Results
from .run import Run
from .tables import Array

Grid = Mapping[str, Sequence[Any]]


@dataclass
class Point:
    """A run of a sweep.

    values   of the entries that are varied
    folder   of the run
    results  also of a run that did not converge; None if there are none
    error    what went wrong; None if nothing did
    """
    values: Dict[str, Any]
    folder: Path
    results: Optional[Results] = None
    error: Optional[VibrocontactError] = None


class Study(Sequence[Point]):
    """Points of a sweep in order, the last entry running fastest.

    shape  numbers of values by entry, if every value was combined with every other; else the number of points
    """

    def __init__(self, points: List[Point], shape: Tuple[int, ...]):
        self.points, self.shape = points, shape

    def __getitem__(self, index: Any) -> Any:
        return self.points[index]

    def __len__(self) -> int:
        return len(self.points)

    def __iter__(self) -> Iterator[Point]:
        return iter(self.points)

    @property
    def failed(self) -> List[Point]:
        """Points with an error."""
        return [point for point in self.points if point.error]

    def values(self, entry: str) -> Array:
        """Of an entry at all points, in the study's shape."""
        return np.array([point.values[entry] for point in self.points]).reshape(self.shape)

    def collect(self, value: Callable[[Results], Any]) -> Array:
        """A number or an array of each point's results, in the study's shape (axes of the array behind); nan at points that did not converge
        or have no results."""
        found = [None if point.error or point.results is None else np.asarray(value(point.results), dtype=float) for point in self.points]
        like = next((one for one in found if one is not None), np.array(np.nan))
        return np.array([np.full(like.shape, np.nan) if one is None else one for one in found]).reshape(self.shape + like.shape)


def sweep(case: Case, values: Union[Grid, Iterable[Mapping[str, Any]]], folder: Union[str, Path], *, jobs: Optional[int] = None, ranks: int = 1,
          check: bool = True, resume: bool = False, on_point: Optional[Callable[[Point], None]] = None) -> Study:
    """Runs a case at many values, each run in a folder of its own below `folder`: 0, 1, ...

    values    lists of values by entry, every one combined with every other; or the entries of each point, one mapping per point
    jobs      runs at once; default: cores over ranks
    ranks     of each run
    check     have the program check all points first: a wrong value of the last is said before the first is computed
    resume    go on in the folders as Case.start() does
    on_point  called with each point when it has ended; all runs are stopped if it raises

    All share a cache of reductions, `folder`/cache, unless the case sets Output/Cache directory; the first goes alone, so that the others find its
    reductions there. Figures are not drawn unless the case sets Output/Figures.
    Wrong input of a point is raised by the check. Without it, and for all else (a run that does not converge, is killed, ...), the point keeps its error
    and the others go on. Ctrl-C stops all runs and is raised again.
    """
    where = Path(folder).absolute()
    if isinstance(values, Mapping):
        shape = tuple(len(values[entry]) for entry in values)
        chosen = [dict(zip(values, one)) for one in itertools.product(*values.values())]
    else:
        chosen = [dict(one) for one in values]
        shape = (len(chosen),)
    base = _with_shared_cache(case, where)
    points = [Point(one, where / str(k)) for k, one in enumerate(chosen)]
    cases = [base.with_entries(point.values) for point in points]
    runs: Dict[int, Run] = {}
    lock, stopping = threading.Lock(), threading.Event()

    def compute(k: int) -> Point:
        point = points[k]
        try:
            with lock:
                if stopping.is_set():
                    return point
                runs[k] = cases[k].start(point.folder, ranks=ranks, resume=resume)
            point.results = runs[k].wait()
        except VibrocontactError as error:
            point.error, point.results = error, getattr(error, "results", None)
        return point

    with ThreadPoolExecutor(jobs or max(1, (os.cpu_count() or 1) // ranks)) as pool:
        try:
            if check:
                for _ in pool.map(Case.check, cases):
                    pass
            for these in (range(len(points))[:1], range(len(points))[1:]):
                for ended in as_completed([pool.submit(compute, k) for k in these]):
                    point = ended.result()
                    if on_point:
                        on_point(point)
        except BaseException:
            with lock:
                stopping.set()
            pool.shutdown(wait=False, cancel_futures=True)
            for run in runs.values():
                run.stop()
            raise
    return Study(points, shape)


class Objective:
    """A function of numbers that runs a case at them: for scipy.optimize or an optimiser of one's own.

        objective = Objective(case, ["Rolling/Lateral creepage"], lambda results: ..., "results/fit")
        scipy.optimize.minimize(lambda x: objective(1e-3 * x), [2.0], method="Nelder-Mead")

    history  of all evaluations, in order: (numbers, value)
    """

    def __init__(self, case: Case, entries: Sequence[str], value: Callable[[Results], Any], folder: Union[str, Path], *, ranks: int = 1,
                 instead: Any = None):
        """
        entries  that the numbers are values of, in order
        value    of the results: a number, or several for a fit
        folder   for the runs: 0, 1, ... in it, with a cache that they share as in sweep()
        ranks    of each run
        instead  value where the program refuses the numbers or does not converge; None: that is raised
        """
        self.folder = Path(folder).absolute()
        self.case = _with_shared_cache(case, self.folder)
        self.entries, self.value, self.ranks, self.instead = list(entries), value, ranks, instead
        self.history: List[Tuple[Tuple[float, ...], Any]] = []

    def __call__(self, numbers: Any) -> Any:
        """The value at these numbers; what was computed before is not computed again. Raises as Run.wait()."""
        asked = tuple(float(one) for one in np.atleast_1d(numbers))
        if len(asked) != len(self.entries):
            raise ValueError(f"{len(asked)} numbers for {len(self.entries)} entries")
        for known, value in self.history:
            if known == asked:
                return value
        try:
            value = self.value(self.case.with_entries(dict(zip(self.entries, asked))).run(self.folder / str(len(self.history)), ranks=self.ranks))
        except (InputError, NotConverged):
            if self.instead is None:
                raise
            value = self.instead
        self.history.append((asked, value))
        return value


def _with_shared_cache(case: Case, folder: Path) -> Case:
    shared = {"Output/Cache directory": folder / "cache", "Output/Figures": False}
    return case.with_entries({entry: value for entry, value in shared.items() if entry not in case.entries})

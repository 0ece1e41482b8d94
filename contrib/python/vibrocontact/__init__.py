"""Vibrocontact from Python: cases, runs, sweeps and results.

    import vibrocontact as vc

    case = vc.Case.from_file(vc.EXAMPLES / "half_space_rolling.prm", {"Rolling/Lateral creepage": 0.003})
    results = case.run("results/first")
    print(results.analyses.quasi_static_rolling.cases[0].utilisation)

Entries are those of a parameter file, named by their paths ("Contact/Friction coefficient"); `parameters()` lists them with
meaning, unit and default. Whatever goes wrong is a `VibrocontactError` whose text says what, where and what to do.
Needs numpy; h5py for histories, matplotlib for figures. doc/python.md has a first study.
"""
from . import figures
from .case import Case, Entries, Value
from .errors import (CannotWrite, InputError, Killed, NotConverged, ProgramFault, ProgramNotFound, Stopped, UnknownEntry,
                     VibrocontactError)
from .parameters import Catalogue, Parameter, parameters
from .program import EXAMPLES, find_program
from .results import Record, Results
from .ring_down import RingDown, ring_down, turning_points
from .run import Line, Run
from .sweep import Objective, Point, Study, sweep
from .tables import Quantity, Table

__all__ = ["CannotWrite", "Case", "Catalogue", "EXAMPLES", "Entries", "InputError", "Killed", "Line", "NotConverged", "Objective", "Parameter", "Point",
           "ProgramFault", "ProgramNotFound", "Quantity", "Record", "Results", "RingDown", "Run", "Stopped", "Study", "Table", "UnknownEntry", "Value",
           "VibrocontactError", "figures", "find_program", "parameters", "ring_down", "sweep", "turning_points"]

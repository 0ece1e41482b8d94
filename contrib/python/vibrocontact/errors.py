"""What can go wrong, one class for each thing that a caller may do about it. The text says what, where and what to do."""
from __future__ import annotations

import signal as signals
from pathlib import Path
from typing import TYPE_CHECKING, Optional, Sequence

if TYPE_CHECKING:
    from .results import Results


class VibrocontactError(Exception):
    """Base of all."""


class ProgramNotFound(VibrocontactError):
    """There is no program vibrocontact, or what was named is none."""


class InputError(VibrocontactError):
    """Wrong input (exit code 1): nothing was computed. The text is the program's sentence: what, where, what to do."""


class UnknownEntry(InputError):
    """No entry of this name.

    entry    the path as given
    nearest  paths, or names in that section, that may be meant; nearest first, possibly none
    """

    def __init__(self, text: str, entry: str, nearest: Sequence[str] = ()):
        super().__init__(text)
        self.entry, self.nearest = entry, tuple(nearest)


class NotConverged(VibrocontactError):
    """A computation did not converge (exit code 2). What was computed is kept.

    results   the results so far
    messages  what did not converge, as results.json has it
    """

    def __init__(self, text: str, results: Optional["Results"], messages: Sequence[str] = ()):
        super().__init__(text)
        self.results, self.messages = results, tuple(messages)


class ProgramFault(VibrocontactError):
    """A fault of the program (exit code 3), or of what starts it (mpirun)."""


class CannotWrite(ProgramFault):
    """Results cannot be written any more: a full disk, a lost permission. What was written stays in `folder`."""

    def __init__(self, text: str, folder: Path):
        super().__init__(text)
        self.folder = folder


class Killed(VibrocontactError):
    """A process of the run was ended by a signal that it did not answer.

    signal         its number
    out_of_memory  the system has killed a process for memory while the run lived
    folder         holds the last checkpoint, if there was one
    """

    def __init__(self, text: str, signal: int, out_of_memory: bool, folder: Path):
        super().__init__(text)
        self.signal, self.out_of_memory, self.folder = signal, out_of_memory, folder


class Stopped(VibrocontactError):
    """The run was stopped by SIGTERM or SIGINT; `resume=True` in the same folder goes on.

    signal   its number
    results  those so far; None if it was stopped before there were any
    """

    def __init__(self, signal: int, folder: Path, results: Optional["Results"]):
        super().__init__(f"the run in {folder} was stopped by {signals.Signals(signal).name}; "
                         "start it in the same folder with resume=True and it goes on")
        self.signal, self.folder, self.results = signal, folder, results

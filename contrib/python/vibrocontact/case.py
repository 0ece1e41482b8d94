"""A case: what a parameter file says, with entries changed."""
from __future__ import annotations

import copy
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Callable, Dict, Iterable, List, Mapping, Optional, Tuple, Union

from .errors import CannotWrite, InputError, ProgramFault
from .parameters import parameters
from .prm import Entries, Value, flat, read_entries, write_entries
from .program import environment, find_program, on_ranks
from .results import Results
from .run import Line, Run, input_error, last_sentence

__all__ = ["Case", "Entries", "Value"]


class Case:
    """What is to be computed. A case does not change; `with_entries` makes another.

        Case({"Bodies": ["wheel", "rail"], "Analyses": "quasi-static rolling", "wheel": {"Type": "half-space"}, ...})
        Case.from_file("wheel.prm", {"Contact/Friction coefficient": 0.4})

    Names are checked at once: against the program's own list, and what that does not hold by the program itself. Values are checked by
    `check()`, and by the program before it computes anything.
    Overrides go to the program as --set does, so that used.prm holds every value of the run, and `Results.case()` is the same case again.
    Files that entries name count from the folder of the parameter file, or else from the working folder.
    """

    def __init__(self, entries: Entries, *, program: Union[str, Path, None] = None):
        """Of entries alone, nested by section or with paths as keys. Raises UnknownEntry, InputError, ProgramNotFound."""
        self._file: Optional[Path] = None
        self._given = flat(entries)
        self._overrides: Dict[str, str] = {}
        self.program = find_program(program)
        self._check_names(self._given)

    @classmethod
    def from_file(cls, file: Union[str, Path], overrides: Optional[Entries] = None, *, program: Union[str, Path, None] = None) -> "Case":
        """Of a parameter file and entries that replace its own. Raises InputError if it cannot be read, UnknownEntry for the name of an override
        (names in the file itself: check())."""
        made = cls.__new__(cls)
        made._file = Path(file).resolve()
        made.program = find_program(program)
        try:
            made._given = read_entries(made._file.read_text(encoding="utf-8-sig"))
        except (OSError, UnicodeError) as error:
            raise InputError(f"the parameter file {file} cannot be read ({error}): name a text file in UTF-8") from None
        made._overrides = {}
        return made.with_entries(overrides or {})

    def with_entries(self, overrides: Entries) -> "Case":
        """The case with these entries instead. Raises UnknownEntry; InputError if the program had to be asked and refuses the case otherwise."""
        made = copy.copy(self)
        made._overrides = {**self._overrides, **flat(overrides)}
        made._check_names(flat(overrides))
        return made

    @property
    def entries(self) -> Dict[str, str]:
        """All entries that are set, as texts by their paths."""
        return {**self._given, **self._overrides}

    @property
    def overrides(self) -> Mapping[str, str]:
        """Those that replace entries of the file, or of the mapping that the case was made of."""
        return dict(self._overrides)

    def __repr__(self) -> str:
        return f"Case({self._file or self._given.get('Title', 'entries')}, {self._overrides})"

    def check(self, folder: Union[str, Path, None] = None) -> str:
        """Has the program validate names, values, files and meshes; nothing is run. Returns its description of the scene, with what its
        reductions need of memory; with a folder also draws the scene there. Raises InputError with the program's sentence."""
        words, scratch = self._words()
        try:
            done = subprocess.run([*words, "--check", *(["--output", str(folder)] if folder else [])], capture_output=True, text=True,
                                  errors="replace", env=environment(), stdin=subprocess.DEVNULL)
        finally:
            if scratch:
                shutil.rmtree(scratch, ignore_errors=True)
        sentence = last_sentence(done.stderr)
        if done.returncode == 1 and sentence:
            raise input_error(sentence)
        if done.returncode != 0:
            raise ProgramFault(f"--check ended with {done.returncode}: {done.stderr.strip()[-2000:]}")
        return done.stdout

    def start(self, folder: Union[str, Path], *, ranks: int = 1, resume: bool = False) -> Run:
        """Starts a run and returns at once. Raises CannotWrite, ProgramFault, ProgramNotFound (no mpirun).

        folder  for the results; what an earlier run left there is replaced
        ranks   of MPI
        resume  go on from the newest checkpoint in the folder, from the beginning if there is none; the case has to be the same but for end
                times and section Output
        """
        target = Path(folder).absolute()
        words, scratch = self._words()
        if resume and (target / "results.json").exists() and (target / "used.prm").exists():
            words.append("--resume")
        return Run([*on_ranks(ranks), *words, "--output", str(target)], target, scratch)

    def run(self, folder: Union[str, Path], *, ranks: int = 1, resume: bool = False, on_line: Optional[Callable[[Line], None]] = None) -> Results:
        """Runs it and returns the results; raises what Run.wait() raises. Arguments as for start(), and

        on_line  called with every line that the program says; the run is stopped if it raises
        """
        with self.start(folder, ranks=ranks, resume=resume) as run:
            for line in run.progress() if on_line else ():
                on_line(line)  # type: ignore[misc]
            return run.wait()

    def _check_names(self, paths: Iterable[str]) -> None:
        unknown = parameters(self.program).unknown(paths, self.entries)
        if unknown:
            doubtful = copy.copy(self)  # an override is judged before the rest of the file
            doubtful._overrides = {**self._overrides, **{path: self.entries[path] for path in unknown}}
            doubtful.check()

    def _words(self) -> Tuple[List[str], Optional[Path]]:
        """The program with its file and the overrides; the folder that was made for the file if the case had none."""
        file, scratch = self._file, None
        if file is None:
            try:
                scratch = Path(tempfile.mkdtemp(prefix="vibrocontact_"))
                file = scratch / "case.prm"
                file.write_text(write_entries(self._given), encoding="utf-8")
            except OSError as error:
                raise CannotWrite(f"the parameter file of the case cannot be written ({error}): make room there, or name another folder by "
                                  "the variable TMPDIR", scratch or Path(os.environ.get("TMPDIR", "/tmp"))) from error
        words = [str(self.program), str(file)]
        for path, value in self._overrides.items():
            words += ["--set", f"{path}={value}"]
        return words, scratch

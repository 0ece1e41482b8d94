"""What a run has left in its folder."""
from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Union

from .errors import VibrocontactError
from .tables import Table, read_histories, read_table

if TYPE_CHECKING:
    from .case import Case


class Record(Dict[str, Any]):
    """An object of results.json; keys are attributes too: `record.cases[0].utilisation`."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f'no "{name}" here; there are {", ".join(map(str, self))}') from None

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *filter(str.isidentifier, self)]


class Results:
    """Results of a run, complete or not.

    folder    the output folder
    data      results.json as a Record; its keys (doc/index.md) are attributes of the results too: `results.analyses`, `results.wall_s`
    """

    def __init__(self, folder: Union[str, Path]):
        """Raises VibrocontactError if the folder has no results.json that can be read."""
        self.folder = Path(folder)
        try:
            with open(self.folder / "results.json", encoding="utf-8") as file:
                self.data: Record = json.load(file, object_hook=Record)
        except (OSError, ValueError) as error:
            raise VibrocontactError(f"{folder} is no output folder of a run: results.json cannot be read ({error})") from None

    def __getattr__(self, name: str) -> Any:
        if name == "data":
            raise AttributeError(name)
        return getattr(self.data, name)

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r}: {self.data.get('status')}, {', '.join(self.data.get('analyses', {})) or 'no analysis'})"

    @property
    def converged(self) -> bool:
        """All analyses have come to their end and converged."""
        return self.data.get("status") == "converged" and bool(self.data.get("complete"))

    @property
    def tables(self) -> List[str]:
        """Names of the tables in the folder, also in folders of it (sweep/...)."""
        return self._files("*.csv")

    @property
    def fields(self) -> List[str]:
        """Names of the field sets for ParaView (*.pvd)."""
        return self._files("*.pvd")

    @property
    def pictures(self) -> List[str]:
        """Names of the figures that were drawn."""
        return self._files("*.png")

    def table(self, name: str) -> Table:
        """A table by its file name, e.g. "rolling.csv". Raises VibrocontactError that lists the tables there are."""
        return read_table(self._path(name, self.tables))

    def histories(self, name: str = "histories.h5") -> Table:
        """Histories in time of a transient or modal convolution (columns `time_s`, `normal_force_N`, ...) or, as "signals.h5", of
        its probes. Needs h5py. Raises VibrocontactError if the run has none."""
        return read_histories(self._path(name, self._files("*.h5")))

    @property
    def log(self) -> str:
        """Text of log.txt."""
        return (self.folder / "log.txt").read_text(encoding="utf-8")

    def case(self, **options: Any) -> "Case":
        """The case with all values that the run used (used.prm), to run again or to vary. options: those of Case.from_file."""
        from .case import Case
        return Case.from_file(self.folder / "used.prm", **options)

    def _files(self, pattern: str) -> List[str]:
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.rglob(pattern))

    def _path(self, name: str, there: List[str]) -> Path:
        if not (self.folder / name).is_file():
            raise VibrocontactError(f"{self.folder} has no {name}; there are {', '.join(there) or 'none of this kind'}")
        return self.folder / name

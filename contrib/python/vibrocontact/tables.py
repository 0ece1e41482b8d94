"""Tables (*.csv) and histories (*.h5) of the program as arrays with units."""
from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from .errors import VibrocontactError

Array = NDArray[Any]

# units at the end of names; in displacement_1_m and force_1_N, 1 is a direction; a swept entry has its unit with _ for what is no letter or digit
UNITS = {**{one: one for one in ("N", "J", "m", "s", "Hz", "Pa", "MB", "dB", "rad", "deg", "kg")},
         "displacement_1_m": "m", "force_1_N": "N", "rad_s": "rad/s", "rad_m": "rad/m", "dB_m": "dB/m", "dBA": "dB(A)", "m_Ns": "m/(N s)", "m_s2": "m/s^2",
         "m_s_2": "m/s^2", "1_s2": "1/s^2", "m_N": "m/N", "m_s": "m/s", "1_s": "1/s", "1_m": "1/m", "Nm": "N m", "Ns": "N s", "seconds": "s", "degrees": "deg",
         "m_2": "m^2", "m_4": "m^4", "m_6": "m^6", "kg_m": "kg/m", "kg_m_3": "kg/m^3", "Ns_m": "N s/m", "N_s_m_3": "N s/m^3", "N_m": "N/m", "N_m_2": "N/m^2", "N_m_3": "N/m^3",
         "bending_stiffness_N_m_2": "N m^2"}

LABELS = ("label", "root", "nearest", "unstable", "mode")
"""Columns that name a mode."""


def unit_of(name: str) -> str:
    """Unit of a quantity by its name: "slip_x_m_s" -> "m/s", "growth_1_s wheel:axial(0,2)" -> "1/s"; empty if it has none."""
    ending = max((one for one in UNITS if ("_" + name.split(" ")[0]).endswith("_" + one)), key=len, default="")
    return UNITS.get(ending, "")


class Quantity(Array):
    """An array with its `unit` (SI, "" for none). Parts and copies keep the unit; what is computed from it is a plain array."""
    unit: str

    def __new__(cls, values: Any, unit: str = "") -> "Quantity":
        made = np.asarray(values).view(cls)
        made.unit = unit
        return made

    def __array_finalize__(self, source: Any) -> None:
        self.unit = getattr(source, "unit", "")

    def __reduce__(self) -> Any:
        return Quantity, (self.view(np.ndarray), self.unit)

    def __array_ufunc__(self, ufunc: np.ufunc, method: Any, *inputs: Any, **kwargs: Any) -> Any:
        def plain(one: Any) -> Any:
            return one.view(np.ndarray) if isinstance(one, Quantity) else one

        if "out" in kwargs:
            kwargs["out"] = tuple(plain(one) for one in kwargs["out"])
        return getattr(ufunc, method)(*map(plain, inputs), **kwargs)


class Table(Mapping[str, Quantity]):
    """Columns by name, each an array with its unit.

    head  lines of the file's head: what it holds, signs
    """

    def __init__(self, columns: Dict[str, Quantity], head: List[str]):
        self.columns, self.head = columns, head

    def __getitem__(self, name: str) -> Quantity:
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f'no column "{name}"; there are {", ".join(self.columns)}') from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"Table({', '.join(f'{name} [{len(values)}]' for name, values in self.columns.items())})"

    def units(self) -> Dict[str, str]:
        """Units of the columns that have one."""
        return {name: unit_of(name) for name in self.columns if unit_of(name)}


def read_columns(name: Union[str, Path]) -> Dict[str, Array]:
    """Columns of a table by name; numbers where all cells are numbers, an empty cell is nan. Modes get their own names back, in tables
    axial(0;2)/2 stands for axial(0,2)#2."""
    return _head_and_columns(name)[1]


def read_table(name: Union[str, Path]) -> Table:
    """A table of the program. Raises FileNotFoundError."""
    head, columns = _head_and_columns(name)
    return Table({column: Quantity(values, unit_of(column)) for column, values in columns.items()}, head)


def _head_and_columns(name: Union[str, Path]) -> Tuple[List[str], Dict[str, Array]]:
    with open(name, newline="", encoding="utf-8") as file:
        lines = list(file)
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    columns: Dict[str, Array] = {}
    for i, column in enumerate(rows[0] if rows else []):
        cells = [row[i] for row in rows[1:]]
        try:
            columns[column] = np.array([float(cell) if cell else np.nan for cell in cells])
        except ValueError:
            if column in LABELS:
                cells = [cell.replace(";", ",").replace("/", "#") for cell in cells]
            columns[column] = np.array(cells)
    return [line[1:].strip() for line in lines if line.startswith("#")], columns


def read_histories(name: Union[str, Path]) -> Table:
    """All datasets of a file of histories by their paths in it. Needs h5py; raises FileNotFoundError."""
    try:
        import h5py
    except ImportError:
        raise VibrocontactError("histories are HDF5 files, and there is no h5py: install python3-h5py") from None
    columns: Dict[str, Quantity] = {}

    def take(path: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset):
            columns[path] = Quantity(node[()], unit_of(path))

    with h5py.File(name, "r") as file:
        file.visititems(take)
    return Table(columns, [])

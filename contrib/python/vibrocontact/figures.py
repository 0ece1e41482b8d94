"""The program's own figures (contrib/plot_results.py), drawn by a process of their own: the caller's matplotlib stays as it is."""
from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Dict, Sequence, Union

from .case import Case
from .errors import VibrocontactError
from .program import CONTRIB
from .results import Results

Folder = Union[Results, str, Path]


def draw(results: Folder, contact_table: Union[str, Path, None] = None) -> Dict[str, Path]:
    """Draws all figures of a run, those that contrib/plot_results.py lists: pictures by name, such as "centre_line_0" or "transient_force".

    contact_table  tractions of the program CONTACT, drawn on top of the centre lines

    Raises VibrocontactError without matplotlib, or if they cannot be drawn."""
    folder = _folder(results)
    _plot(str(folder), *(["--contact-table", str(contact_table)] if contact_table else []))
    return {path.stem: path for path in sorted((folder / "figures").glob("*.png"))}


def scene(case: Case, folder: Union[str, Path]) -> Path:
    """The scene of a case: bodies, contact points, supports. Nothing is run; the picture is in `folder`. Raises InputError too."""
    picture = Path(folder) / "figures" / "scene.png"
    picture.unlink(missing_ok=True)  # of another case
    case.check(folder)
    if not picture.exists():  # the program's own python has no matplotlib
        _plot("--scene", str(folder))
    return picture


def compare(results: Sequence[Folder], picture: Union[str, Path] = "compare.png") -> Path:
    """What two or more runs have in common, in one picture. Raises VibrocontactError if that is nothing."""
    _plot("--compare", *(str(_folder(one)) for one in results), "--picture", str(picture))
    return Path(picture)


def _folder(results: Folder) -> Path:
    return results.folder if isinstance(results, Results) else Path(results)


def _plot(*words: str) -> None:
    done = subprocess.run([sys.executable, str(CONTRIB / "plot_results.py"), *words], capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if done.returncode == 4:
        raise VibrocontactError("figures need matplotlib, and h5py after a run in time: install python3-matplotlib and python3-h5py")
    if done.returncode != 0:
        raise VibrocontactError(f"the figures cannot be drawn: {(done.stderr.strip().splitlines() or ['no word'])[-1]}")

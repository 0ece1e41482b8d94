"""Where the program is and how it is started."""
from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Dict, List, Union

from .errors import ProgramNotFound

CONTRIB = Path(__file__).resolve().parents[2]
"""Folder contrib of the sources or of the installation."""
EXAMPLES = CONTRIB.parent / "parameter_files" / "examples"
"""Shipped parameter files."""


def find_program(program: Union[str, Path, None] = None) -> Path:
    """Path of the program: the one given, or that of the variable VIBROCONTACT, or of the build tree or installation that this
    package belongs to, or of PATH. Raises ProgramNotFound."""
    named = program or os.environ.get("VIBROCONTACT")
    if named:
        found = shutil.which(str(named))
        if not found:
            raise ProgramNotFound(f"there is no program {named} that can be executed: build it, or name another by program=... or "
                                  "by the variable VIBROCONTACT")
        return Path(found).resolve()
    for path in ("build/vibrocontact", "../../bin/vibrocontact"):  # of the sources; beside share/vibrocontact
        beside = (CONTRIB.parent / path).resolve()
        if os.access(beside, os.X_OK) and beside.is_file():
            return beside
    found = shutil.which("vibrocontact")
    if not found:
        raise ProgramNotFound("there is no program vibrocontact beside this package or in PATH: build it (README.md), or name it by "
                              "program=... or by the variable VIBROCONTACT")
    return Path(found).resolve()


def environment() -> Dict[str, str]:
    """Variables of a run, as contrib/run.sh sets them: one BLAS thread per rank; mpirun also as root."""
    return dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def on_ranks(ranks: int) -> List[str]:
    """Words in front of the program: none for one rank, else mpirun, also with more ranks than cores."""
    if ranks == 1:
        return []
    mpirun = shutil.which("mpirun") or shutil.which("mpiexec")
    if not mpirun:
        raise ProgramNotFound(f"{ranks} ranks need mpirun, which is not in PATH: install it, or take ranks=1")
    return [mpirun, "-q", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]

#!/usr/bin/env python3
"""readable_results.py FOLDER|FOLDER=FOLDER ...: every table, field and UFF file of runs is read as users read them: pandas, numpy, meshio,
pyuff. Tables: same columns and rows by all readers, numbers in all columns but those that name something. Fields: each point
used by a cell; those of two runs FOLDER=FOLDER have the same cells. Exit code 77 if no reader is installed."""
import glob
import os
import sys

try:
    import meshio
    import numpy as np
    import pandas
except ImportError:
    if not os.environ.get("VIBROCONTACT_SYSTEM_PYTHON") and os.path.exists("/usr/bin/python3"):
        os.environ["VIBROCONTACT_SYSTEM_PYTHON"] = "yes"
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    print("pandas, numpy or meshio is missing: nothing was read")
    sys.exit(77)
try:
    import pyuff
except ImportError:
    pyuff = None

# columns of words
WORDS = {"label", "root", "nearest", "unstable", "curve", "case_name", "method", "basis", "weighting", "form", "law", "note", "state",
         "name", "scheme", "status_text", "row", "stable_text"}


def check_table(name):
    lines = open(name, encoding="utf-8").read().splitlines()
    n_comments = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    header = lines[n_comments].split(",")
    rows = len(lines) - n_comments - 1
    frame = pandas.read_csv(name, comment="#")
    assert list(frame.columns) == header and len(frame) == rows, f"{name}: pandas reads {frame.shape}, not {rows} x {len(header)}"
    words = {c for c in header if frame[c].dtype == object}
    assert words <= WORDS, f"{name}: no numbers in {sorted(words - WORDS)}"
    if rows:
        array = np.genfromtxt(name, delimiter=",", skip_header=n_comments + 1, ndmin=2)
        assert array.shape == (rows, len(header)), f"{name}: numpy reads {array.shape}, not {(rows, len(header))}"
        numbers = [i for i, c in enumerate(header) if c not in words and frame[c].notna().all()]
        assert np.allclose(array[:, numbers], frame.to_numpy()[:, numbers].astype(float), 1e-10, 0), f"{name}: numpy and pandas differ"


def check_field(name):
    mesh = meshio.read(name)
    used = np.unique(np.concatenate([block.data.ravel() for block in mesh.cells]))
    assert len(mesh.points) and len(used) == len(mesh.points), f"{name}: {len(used)} of {len(mesh.points)} points are used by cells"
    for key, values in mesh.point_data.items():
        assert len(values) == len(mesh.points) and np.isfinite(values).all(), f"{name}: {key}"
    return sum(len(block.data) for block in mesh.cells)


counts = {"tables": 0, "fields": 0, "UFF files": 0}


def check_run(folder):
    """Cells of each field of a run."""
    def files(extension):
        return sorted(glob.glob(os.path.join(folder, "**", "*." + extension), recursive=True))
    for name in files("csv"):
        check_table(name)
        counts["tables"] += 1
    for name in files("uff") if pyuff else []:
        assert pyuff.UFF(name).read_sets()
        counts["UFF files"] += 1
    counts["fields"] += len(files("vtu"))
    return {os.path.relpath(name, folder): check_field(name) for name in files("vtu")}


for argument in sys.argv[1:]:
    cells = [check_run(folder) for folder in argument.split("=")]
    assert all(one == cells[0] for one in cells), f"{argument}: other cells"
print(", ".join(f"{n} {what}" for what, n in counts.items()) + " are read")
assert counts["tables"]

"""What all figures share: reading tables, saving, meanings of colours."""
import csv
import os
import warnings

import numpy as np
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

# the same meaning in every figure
OPEN, STICK, SLIP, UNSTABLE, LINE, LIMIT = "#eeeeee", "#2a6fb0", "#e08a2e", "#c0392b", "#333333", "#9a9a9a"
LEAST_DIVERGENCE_RATE = 1e-9  # of an unstable root; what is below is round-off
warnings.filterwarnings("ignore")
plt.rcParams.update({"font.size": 9, "figure.dpi": 110, "axes.grid": False, "savefig.bbox": "tight"})


def read_table(name):
    """Columns of a table by name; numbers where all cells are numbers."""
    with open(name, newline="") as lines:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    columns = {}
    for i, column in enumerate(rows[0]):
        cells = [row[i] for row in rows[1:]]
        try:
            columns[column] = np.array([float(cell) for cell in cells])
        except ValueError:
            columns[column] = np.array(cells)
    return columns


def save(figure, folder, name):
    """Whole or not at all."""
    part = os.path.join(folder, "figures", name + ".part")
    figure.savefig(part, format="png")
    plt.close(figure)
    os.replace(part, os.path.join(folder, "figures", name + ".png"))


def legend_above(axis, handles=None, **style):
    """Outside of the data."""
    axis.legend(handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=4, frameon=False, fontsize=8,
                borderaxespad=0.2, handlelength=1.4, **style)


def case_title(case):
    words = [f"N = {case['normal_force_N'] / 1e3:.4g} kN", f"$\\mu$ = {case['friction']:g}"]
    if case.get("speed_m_s", 0) > 0:
        words.append(f"creepage {100 * case['longitudinal_creepage']:g} % / {100 * case['lateral_creepage']:g} %")
        if case["spin_1_m"] != 0:
            words.append(f"spin {case['spin_1_m']:g} /m")
        words.append(f"V = {case['speed_m_s']:g} m/s")
    if np.any(case.get("sliding_velocity_m_s", 0)):
        words.append("sliding {:g} / {:g} m/s".format(*case["sliding_velocity_m_s"]))
    return ", ".join(words)


def short(label):
    """wheel:axial(0,3) without the body"""
    return label.split(":", 1)[-1]


def plot_line(axis, time, values, **style):
    """A long signal by the least and the largest value of each of 2000 pieces."""
    pieces = len(values) // 4000
    if pieces >= 5:
        n = len(values) // (2 * pieces) * 2 * pieces
        parts = values[:n].reshape(-1, 2 * pieces)
        values = np.column_stack([parts.min(axis=1), parts.max(axis=1)]).ravel()
        time = time[:n:pieces][:len(values)]
    axis.plot(time, values, **style)

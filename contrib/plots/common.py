"""What all figures share: reading tables, saving, meanings of colours."""
import os
import sys
import warnings

import numpy as np
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "python"))
from vibrocontact import prm  # noqa: E402
from vibrocontact.tables import read_columns as read_table  # noqa: E402,F401

# the same meaning in every figure
OPEN, STICK, SLIP, UNSTABLE, LINE, LIMIT = "#eeeeee", "#2a6fb0", "#e08a2e", "#c0392b", "#333333", "#9a9a9a"
LEAST_DIVERGENCE_RATE = 1e-9  # of an unstable root; what is below is round-off
warnings.filterwarnings("ignore")
plt.rcParams.update({"font.size": 9, "figure.dpi": 110, "axes.grid": False, "savefig.bbox": "tight"})


def save(figure, folder, name):
    """Whole or not at all."""
    part = os.path.join(folder, "figures", name + ".part")
    figure.savefig(part, format="png")
    plt.close(figure)
    os.replace(part, os.path.join(folder, "figures", name + ".png"))


def plot_bands(folder, table, name):
    """1/3-octave bands of a force."""
    bands = read_table(os.path.join(folder, table))
    level = bands["level_dB"]
    if len(level) < 3:
        return
    figure, axis = plt.subplots(figsize=(8, 3.5))
    bottom = 10 * np.floor(max(level.min(), level.max() - 100) / 10 - 1)
    axis.bar(range(len(level)), level - bottom, bottom=bottom, color="0.5")
    axis.set_xticks(range(0, len(level), 3), [f"{f:g}" for f in bands["nominal_Hz"][::3]])
    axis.set_ylim(bottom, None)
    axis.set_xlabel("1/3-octave band [Hz]")
    axis.set_ylabel("contact force [dB re 1 N]")
    axis.grid(alpha=0.3, axis="y")
    save(figure, folder, name)


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


def edges(values):
    """Of the cells about values in a map."""
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def swept_axis(entry, column):
    """Words with a unit of a swept entry, e.g. lateral position [mm], and the factor of its values."""
    words = entry.split("/")[-1]
    unit = column[len(words) + 1:].replace("1_m", "1/m").replace("m_s", "m/s").replace("N_m", "N/m").replace("kg_m_3", "kg/m$^3$")
    words = words[0].lower() + words[1:]
    return (f"{words} [mm]", 1e3) if unit == "m" else (f"{words} [{unit}]" if unit else words, 1)


def read_entries(folder):
    """Values used in a run, texts by their paths such as Contact/Friction coefficient."""
    with open(os.path.join(folder, "used.prm"), encoding="utf-8") as file:
        return prm.read_entries(file.read())


def friction_factor(folder, speed, section="Contact"):
    """mu over the Friction coefficient at these slip speeds [m/s]; 1 without a law that depends on them."""
    name = os.path.join(folder, "used.prm")
    entries = read_entries(folder) if os.path.exists(name) else {}
    ratio = float(entries.get(section + "/Static friction ratio", 1))
    velocity = float(entries.get(section + "/Stribeck velocity", 1))
    return 1 + (ratio - 1) * np.exp(-np.asarray(speed, dtype=float) / velocity)


# longer signals are drawn by their envelope
LONG = 4000


def plot_line(axis, time, values, color=None, label=None, lw=0.9, ls="-"):
    """A signal; a long one by the band between the least and the largest value of each of 1000 pieces, with its mean."""
    pieces = len(values) // (LONG // 4)
    if len(values) <= LONG:
        return axis.plot(time, values, color=color, label=label, lw=lw, ls=ls)
    n = len(values) // pieces * pieces
    parts = np.asarray(values)[:n].reshape(-1, pieces)
    middle = np.asarray(time)[:n:pieces]
    line, = axis.plot(middle, parts.mean(axis=1), color=color, label=label, lw=lw, ls=ls)
    axis.fill_between(middle, parts.min(axis=1), parts.max(axis=1), color=line.get_color(), alpha=0.25, lw=0)
    return [line]

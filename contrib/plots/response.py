"""Frequency responses and their identification."""
import os
import re

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from plots.common import legend_above, read_table, save, plt

MAX_CURVES = 12


def plot_frequency_response(folder, analysis):
    """Magnitude at the driving points, one panel each, a line per body, as in Fig. 6; dashed: damping of a run in time."""
    curves = {}
    for body, one in analysis["bodies"].items():
        if one.get("kind") == "Green's functions":
            plot_green_functions(folder, body, one, analysis["quantity"])
            continue
        for table, style in ((one["table"], "-"), (one.get("time_domain_table"), "--")):
            if table is None:
                continue
            columns = read_table(os.path.join(folder, table))
            for name in columns:
                match = re.fullmatch(r"(\w+_[xyz])_\1_real_(m_\w+)", name.replace("-", "\u00b7"))
                if match:
                    point = match.group(1).replace("\u00b7", "-")
                    value = columns[name] + 1j * columns[name.replace("_real_", "_imag_")]
                    curves.setdefault(point, []).append((columns["frequency_Hz"], np.abs(value), style,
                                                         body + (", damping in time" if style == "--" else "")))
    if not curves:
        return
    figure, axes = plt.subplots(len(curves), 1, figsize=(8, 3.2 * len(curves)), squeeze=False)
    unit = "m/(N s)" if analysis["quantity"] == "mobility" else "m/N"
    for axis, (point, lines) in zip(axes[:, 0], curves.items()):
        for k, (frequency, magnitude, style, label) in enumerate(lines):
            axis.loglog(frequency, magnitude, style, lw=1, label=label)
        axis.set_title(point.replace("_", ", "))
        axis.set_ylabel(f"{analysis['quantity']} [{unit}]")
        axis.grid(alpha=0.3, which="both")
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.xaxis.set_minor_formatter(NullFormatter())
    legend_above(axes[0, 0])
    axes[0, 0].set_title(axes[0, 0].get_title(), pad=18)
    axes[-1, 0].set_xlabel("frequency [Hz]")
    figure.tight_layout()
    save(figure, folder, "frequency_response")


def plot_green_functions(folder, body, one, quantity):
    """Entries between the first point (each direction) and the others over frequency, as in Fig. 5 of Meftah & Duhamel (2011),
    and the impulse responses that belong to them."""
    columns = read_table(os.path.join(folder, one["table"]))
    impulse = read_table(os.path.join(folder, one["impulse_response"])) if one.get("impulse_response") else {}
    labels, panels = one["labels"], {}
    for name in one["entries"]:
        match = next((a, b) for a in labels for b in labels if name == f"{a}_{b}")
        points, directions = zip(*(label.rsplit("_", 1) for label in match))
        if points[0] == labels[0].rsplit("_", 1)[0]:
            panels.setdefault(directions, []).append((name, points[1]))
    figure, axes = plt.subplots(len(panels), 2 if impulse else 1, figsize=(11 if impulse else 7, 3 * len(panels)), squeeze=False)
    unit = "_m_Ns" if quantity == "mobility" else "_m_N"
    magnitude = {name: np.abs(columns[name + "_real" + unit] + 1j * columns[name + "_imag" + unit]) for name in one["entries"]}
    largest = max(values.max() for values in magnitude.values())
    for row, (directions, names) in zip(axes, panels.items()):
        for name, other in names[:MAX_CURVES]:
            if magnitude[name].max() < 1e-10 * largest:  # vanishes by symmetry
                continue
            label = f"$G_{{{labels[0].rsplit('_', 1)[0]}{other}}}$"
            row[0].semilogy(columns["frequency_Hz"], magnitude[name], lw=1, label=label)
            if impulse:
                row[1].plot(1e3 * impulse["time_s"], impulse[name + "_m_Ns"], lw=1, label=label.replace("G", "g"))
        title = f"displacement {directions[0]}, force {directions[1]}"
        row[0].set_title(title)
        row[0].set_ylabel(f"{quantity} [{'m/(N s)' if quantity == 'mobility' else 'm/N'}]")
        row[0].set_xlabel("frequency [Hz]")
        if impulse:
            row[1].set_title(title)
            row[1].set_ylabel("impulse response [m/(N s)]")
            row[1].set_xlabel("time [ms]")
        for axis in row:
            axis.grid(alpha=0.3, which="both")
            axis.legend(fontsize=8)
    figure.tight_layout()
    save(figure, folder, "green_functions_" + body)


def receptances(folder, table):
    """Complex columns by name of the pair, and the frequencies."""
    columns = read_table(os.path.join(folder, table))
    return columns["frequency_Hz"], {name[:-len("_real_m_N")]: columns[name] + 1j * columns[name.replace("_real_", "_imag_")]
                                     for name in columns if name.endswith("_real_m_N")}


def different_entries(data):
    """Names of the columns without those that repeat another, by symmetry or reciprocity."""
    names = []
    for name, values in data.items():
        if not any(np.abs(values - data[other]).max() <= 1e-6 * np.abs(values).max() for other in names):
            names.append(name)
    return names


def plot_identification(folder, fits):
    """Data and fits, one panel per entry (at most four, none twice), with the distance of each fit from the data."""
    frequency, data = receptances(folder, fits[0]["data"])
    names = different_entries(data)[:4]
    figure, axes = plt.subplots(len(names), 1, figsize=(8, 2.6 * len(names)), squeeze=False, sharex=True)
    fitted = [receptances(folder, fit["fit"])[1] for fit in fits]
    for axis, name in zip(axes[:, 0], names):
        axis.semilogy(frequency, np.abs(data[name]), "k", lw=1.6, label="data")
        for k, (fit, values) in enumerate(zip(fits, fitted)):
            error = fit["error_E_entries"][fit["entries"].index(name)]
            axis.semilogy(frequency, np.abs(values[name]), "--", lw=1, color=f"C{k}",
                          label=f"{fit['method']}, {fit['n_pole_pairs']:g} pairs, E = {error:.1e}")
            axis.semilogy(frequency, np.abs(values[name] - data[name]) + 1e-300, ":", lw=0.8, color=f"C{k}")
        axis.set_ylim(bottom=1e-6 * np.abs(data[name]).max())
        axis.set_title(name)
        axis.set_ylabel("receptance [m/N]")
        axis.grid(alpha=0.3, which="both")
        axis.legend(fontsize=7)
    axes[-1, 0].set_xlabel("frequency [Hz]; dotted: difference to the data")
    figure.tight_layout()
    save(figure, folder, "identification")
    if not fits[0].get("chart"):
        return
    chart = read_table(os.path.join(folder, fits[0]["chart"]))
    figure, axis = plt.subplots(figsize=(8, 5))
    for status, marker, colour, label in ((0, "x", "#bbbbbb", "new"), (1, "^", "#e08a2e", "frequency within 1 %"),
                                          (2, "o", "#2a6fb0", "damping within 5 %, too")):
        chosen = (chart["status"] == status) & (chart["frequency_Hz"] < 1.1 * frequency.max())
        axis.plot(chart["frequency_Hz"][chosen], chart["n_pole_pairs"][chosen], marker, ms=4, color=colour, ls="none", label=label)
    other = axis.twinx()
    other.semilogy(frequency, np.abs(data[names[0]]), "k", lw=0.8, alpha=0.6)
    other.set_ylabel(f"receptance of {names[0]} [m/N]")
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel("pole pairs")
    axis.set_title("Stabilisation chart, " + fits[0]["method"])
    axis.legend(fontsize=8, loc="lower right")
    figure.tight_layout()
    save(figure, folder, "stabilisation_chart")

"""Periodic motions against a stop."""
import os

import numpy as np

from plots.common import LINE, STICK, plt, read_table, save

SHORT = {"daubechies6": "DB6", "bspline": "B-spline", "fourier": "Fourier", "haar": "Haar"}


def pair_of(entry):
    return ":".join(SHORT.get(entry[key], entry[key]) for key in ("basis", "weighting"))


def shown_solutions(entries):
    """The first solution and one of every other pair: that with the number of functions nearest to 64."""
    shown = {0: entries[0]}
    for pair in dict.fromkeys(pair_of(entry) for entry in entries if pair_of(entry) != pair_of(entries[0])):
        numbered = [(abs(e["n_functions"] - 64), k) for k, e in enumerate(entries)
                    if k > 0 and e["converged"] and pair_of(e) == pair]
        if numbered:
            k = min(numbered)[1]
            shown[k] = entries[k]
    return shown


def plot_periodic(folder, entries):
    """Displacement, velocity and contact force over a period (the reference in time broad behind them), as in Figs 6 to 9 of
    Jones & Legrand (2014), and errors
    over the number of functions and over time, as in their Figs 10 and 11."""
    tables = {}
    for k, entry in shown_solutions(entries).items():
        name = os.path.join(folder, f"periodic_{k}.csv")
        if os.path.exists(name):
            tables[k] = read_table(name)
    name = os.path.join(folder, "periodic_reference.csv")
    reference = read_table(name) if os.path.exists(name) else None
    columns = (("displacement_m", "displacement [mm]", 1e3), ("velocity_m_s", "velocity [m/s]", 1),
               ("contact_force_N", "contact force [kN]", 1e-3))
    if tables:
        figure, axes = plt.subplots(3, len(tables), figsize=(3.2 * len(tables) + 1, 7), squeeze=False, sharex=True,
                                    sharey="row")
        for column, (k, table) in enumerate(tables.items()):
            axes[0, column].set_title(f"{pair_of(entries[k])}, {entries[k]['n_functions']}", fontsize=9)
            for row, (key, label, factor) in enumerate(columns):
                axis = axes[row, column]
                if reference is not None:
                    axis.plot(reference["phase"], reference[key] * factor, color=STICK, lw=2.5, alpha=0.5)
                axis.plot(table["phase"], table[key] * factor, color=LINE, lw=0.8)
                if column == 0:
                    axis.set_ylabel(label)
            axes[2, column].set_xlabel("phase of the force")
        save(figure, folder, "periodic_motion")
    name = os.path.join(folder, "periodic_errors.csv")
    if os.path.exists(name):
        plot_errors(folder, read_table(name))
    name = os.path.join(folder, "time_bases.csv")
    if os.path.exists(name):
        plot_bases(folder, read_table(name))


def plot_errors(folder, table):
    found = np.isfinite(table["error_displacement"])
    table = {key: column[found] for key, column in table.items()}
    pairs = [f"{SHORT.get(a, a)}:{SHORT.get(b, b)}" for a, b in zip(table["basis"], table["weighting"])]
    if len(pairs) < 2:
        return
    kinds = (("error_displacement", "displacement"), ("error_velocity", "velocity"),
             ("error_contact_force", "contact force"), ("error_impulse", "impulse"), ("error_energy_norm", "energy norm"))
    figure, axes = plt.subplots(2, len(kinds), figsize=(3 * len(kinds), 6.2), sharey="row")
    for column, (key, label) in enumerate(kinds):
        for pair in dict.fromkeys(pairs):
            chosen = np.array([p == pair for p in pairs])
            order = np.argsort(table["n_functions"][chosen])
            error = table[key][chosen][order]
            axes[0, column].loglog(table["n_functions"][chosen][order], error, marker="o", ms=3, lw=1, label=pair)
            axes[1, column].loglog(table["seconds"][chosen][order] * 1e3, error, marker="o", ms=3, lw=1)
        axes[0, column].set_title(label, fontsize=9)
        axes[0, column].set_xlabel("number of functions")
        axes[1, column].set_xlabel("time of a solution [ms]")
        for axis in axes[:, column]:
            axis.grid(alpha=0.3)
    axes[0, 0].set_ylabel("relative error")
    axes[1, 0].set_ylabel("relative error")
    axes[0, 0].legend(fontsize=7)
    figure.tight_layout()
    save(figure, folder, "periodic_errors")


def plot_bases(folder, table):
    """The first functions of Fourier's basis, and one scaling function of each other at six levels, as in Figs 2 to 5."""
    families = list(dict.fromkeys(column.rsplit("_", 1)[0] for column in table if column != "phase"))
    figure, axes = plt.subplots(len(families), 6, figsize=(13, 1.9 * len(families)), squeeze=False, sharex=True)
    for row, family in enumerate(families):
        columns = [column for column in table if column.rsplit("_", 1)[0] == family]
        for axis, column in zip(axes[row], columns):
            axis.plot(table["phase"], table[column], color=LINE, lw=0.8)
            axis.set_title(column.replace("_", " ", 1) if family == "fourier" else column, fontsize=7)
            axis.tick_params(labelsize=6)
            axis.ticklabel_format(useOffset=False)
            if np.ptp(table[column]) < 1e-6:
                axis.set_ylim(0, 2)
        axes[row, 0].set_ylabel(SHORT.get(family, family))
    figure.tight_layout()
    save(figure, folder, "time_bases")

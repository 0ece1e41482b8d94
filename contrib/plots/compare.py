"""What several runs say about the same quantity, on top of each other."""
import json
import os

import numpy as np

from plots.common import legend_above, LEAST_DIVERGENCE_RATE, plot_line, plt, read_entries, read_table


def panels_of(folder, analyses):
    """Panels of a run: title, axis labels, x, y, style, scale of y."""
    def table(name):
        path = os.path.join(folder, name)
        return read_table(path) if os.path.exists(path) else None

    panels = []
    cases = analyses.get("quasi_static_rolling", {}).get("cases", [])
    if cases:
        for key, label in (("lateral_creepage", "lateral creepage"), ("longitudinal_creepage", "longitudinal creepage"),
                           ("spin_1_m", "spin [1/m]")):
            x = [case[key] for case in cases]
            if np.ptp(x) > 0 or (key == "lateral_creepage" and len(cases) == 1):
                panels.append(("rolling", label, "utilisation |Ft| / (mu N)", x, [case["utilisation"] for case in cases], "o", "linear"))
    roots = table("stability.csv")
    if roots is not None:
        near = (roots["frequency_Hz"] > 0) & (roots["growth_1_s"] > -50)
        panels.append(("stability", "frequency [Hz]", "growth [1/s]", roots["frequency_Hz"][near], roots["growth_1_s"][near], "o", "linear"))
    name = os.path.join(folder, "histories.h5")
    if os.path.exists(name):
        import h5py
        with h5py.File(name) as file:
            time = np.asarray(file["time_s"])
            force = [np.asarray(file[key]) for key in file
                     if key == "normal_force_N" or (key.startswith("point_") and key.endswith("_force_N") and "tangential" not in key)]
        if force and len(time) > 1:
            panels.append(("contact force", "time [s]", "force [N]", time, np.sum(force, axis=0), "-", "linear"))
    signals = os.path.join(folder, "signals.h5")
    if os.path.exists(signals):
        import h5py
        from plots.transient import spectrum
        with h5py.File(signals) as file:
            time = np.asarray(file["time_s"])
            for key in file:
                if key != "time_s" and len(time) > 512:
                    frequency, amplitude = spectrum(time, np.asarray(file[key]))
                    chosen = (frequency > 0) & (frequency < 8000)
                    panels.append((key[:-len("_m_s")].replace("_", " "), "frequency [Hz]", "amplitude [m/s]", frequency[chosen],
                                   amplitude[chosen], "-", "log"))
    for name, x, y, labels in (("periodic_0.csv", "phase", "displacement_m", ("phase of the force", "displacement [m]")),
                               ("response.csv", "frequency_Hz", "amplitude_m", ("frequency [Hz]", "largest displacement [m]"))):
        columns = table(name)
        if columns is not None:
            panels.append((name[:-len(".csv")].split("_")[0], *labels, columns[x], columns[y], "-", "linear"))
    for body, one in analyses.get("frequency_response", {}).get("bodies", {}).items():
        columns = table(one["table"]) if one.get("table") else None
        real = [key for key in columns or {} if "_real" in key]
        if real:
            magnitude = np.abs(columns[real[0]] + 1j * columns[real[0].replace("_real", "_imag")])
            panels.append((f"{body}: {real[0].split('_real')[0]}", "frequency [Hz]", analyses["frequency_response"]["quantity"],
                           columns["frequency_Hz"], magnitude, "-", "log"))
    return panels


def differing_entries(folders):
    """Lines of the entries in which the runs differ."""
    used = [read_entries(folder) for folder in folders]
    names = dict.fromkeys(name for one in used for name in one)
    return [f"{name} = " + " | ".join(one.get(name, "-") for one in used) for name in names
            if len({one.get(name) for one in used}) > 1 and not name.startswith("Output/")]


def plot_comparison_of_runs(folders, picture):
    """One panel for each quantity that at least two runs have, a line per run; the title says in which entries they differ."""
    runs = []
    for folder in folders:
        with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
            runs.append({panel[:3]: panel[3:] for panel in panels_of(folder, json.load(file)["analyses"])})
    common = [key for key in dict.fromkeys(key for run in runs for key in run) if sum(key in run for run in runs) > 1]
    if not common:
        return []
    columns = min(2, len(common))
    rows = (len(common) + columns - 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(6.5 * columns, 3.4 * rows), squeeze=False)
    for axis, key in zip(axes.ravel(), common):
        title, x_label, y_label = key
        for k, (folder, run) in enumerate(zip(folders, runs)):
            if key not in run:
                continue
            x, y, style, scale = run[key]
            label = os.path.basename(os.path.normpath(folder))
            if style == "o":
                axis.plot(x, y, "os^vD"[k % 5], ms=4, mfc="none", color=f"C{k}", label=label)
            else:
                plot_line(axis, np.asarray(x), np.asarray(y), color=f"C{k}", label=label, lw=0.9)
            axis.set_yscale(scale)
        if title == "stability":
            axis.axhline(LEAST_DIVERGENCE_RATE, color="k", lw=0.6)
        axis.set_title(title, fontsize=9, loc="right")
        axis.set_xlabel(x_label)
        axis.set_ylabel(y_label)
        axis.grid(alpha=0.3)
        legend_above(axis)
    for axis in axes.ravel()[len(common):]:
        axis.set_axis_off()
    differences = differing_entries(folders)
    figure.suptitle("\n".join(differences[:6] + ["..."] * (len(differences) > 6)), fontsize=8)
    figure.tight_layout()
    figure.savefig(picture)
    plt.close(figure)
    return [key[0] for key in common]

"""Modal convolution and the comparison of propagators."""
import os

import numpy as np
import h5py

from plots.common import LONG, plot_line, save, plt


def plot_modal_convolution(folder, histories):
    """Displacements and forces of up to three contact points, as in Figs 2, 3, 6 and 7 of Meftah & Duhamel (2011)."""
    with h5py.File(os.path.join(folder, histories)) as file:
        time = np.asarray(file["time_s"])
        n_points = sum(1 for name in file if name.endswith("_force_N") and not name.endswith("_tangential_force_N"))
        shown = sorted({0, n_points // 2, n_points - 1})
        u = {i: np.asarray(file[f"point_{i}_displacement_m"]) for i in shown}
        q = {i: np.asarray(file[f"point_{i}_force_N"]) for i in shown}
        road = {i: np.asarray(file[f"point_{i}_road_m"]) for i in shown if f"point_{i}_road_m" in file}
        pictures = [(u, "displacement", "displacement [mm]", 1e3), (q, "force", "force [N]", 1)]
        for quantity, unit, label, factor in (("displacement", "m", "tangential displacement [mm]", 1e3),
                                              ("force", "N", "tangential force [N]", 1)):
            if f"point_0_tangential_{quantity}_{unit}" in file:  # with friction
                own = {i: np.asarray(file[f"point_{i}_tangential_{quantity}_{unit}"]) for i in shown}
                pictures.append((own, "tangential_" + quantity, label, factor))
    if len(time) < 2:
        return
    for values, name, label, factor in pictures:
        zooms = len(time) > LONG
        figure, axes = plt.subplots(1, 1 + zooms, figsize=(11 if zooms else 8, 3.5), sharey=True, squeeze=False)
        for axis, chosen in zip(axes[0], (slice(None), slice(-LONG // 8, None))):
            for i in shown:
                plot_line(axis, time[chosen], values[i][chosen] * factor, lw=0.8, label=f"point {i}", color=f"C{shown.index(i)}")
                if name == "displacement" and i in road:
                    plot_line(axis, time[chosen], road[i][chosen] * factor, lw=0.8, ls="--", label="road under it",
                              color=f"C{shown.index(i)}")
            axis.set_xlabel("time [s]")
        axes[0, 0].set_ylabel(label)
        if zooms:
            axes[0, 0].set_title("mean and envelope", fontsize=9)
            axes[0, 1].set_title("the end of it", fontsize=9)
        if len(shown) > 1 or name == "displacement":
            axes[0, 0].legend(fontsize=8)
        if name == "force":
            top = np.percentile(np.concatenate(list(values.values())), 99.8)
            axes[0, 0].set_ylim(min(0, min(v.min() for v in values.values())), 1.2 * top if top > 0 else None)
        save(figure, folder, f"modal_convolution_{name}")


def least_memory(entries, entry):
    """Of the same method in the same run; two stand there, the row's and that of the 1 % rule."""
    same = ("body", "step_s", "steps", "method")
    return min(other["memory_steps"] for other in entries if all(other[key] == entry[key] for key in same))


def plot_comparison(folder, entries):
    """Errors of displacement and force against cost, one column per body and run of the comparison."""
    def run_of(entry):
        return entry["body"], entry["step_s"], entry["steps"]
    runs = list(dict.fromkeys(run_of(entry) for entry in entries))
    methods = list(dict.fromkeys(entry["method"] for entry in entries))
    figure, axes = plt.subplots(2, len(runs), figsize=(3.6 * len(runs), 6.4), squeeze=False, sharex="col")
    for column, run in zip(axes.T, runs):
        for axis, quantity, label in zip(column, ("error_displacement_m", "error_force_N"),
                                         ("largest error of the displacement [m]", "rms error of the force [N]")):
            for entry in entries:
                k = methods.index(entry["method"])
                if run_of(entry) == run and entry.get(quantity) == 0:
                    # exact: its cost alone
                    axis.axvline(entry["seconds_per_step"] * 1e9, color=f"C{k % 10}", ls="--", lw=1)
                elif run_of(entry) == run and quantity in entry:
                    axis.loglog(entry["seconds_per_step"] * 1e9, entry[quantity], "os^vD<>PX*"[k % 10], color=f"C{k % 10}",
                                fillstyle="none" if entry["memory_steps"] > least_memory(entries, entry) else "full")
            axis.set_ylabel(label)
            axis.grid(alpha=0.3)
        column[0].set_title(f"{run[0]}, h = {run[1] * 1e3:g} ms, {run[2]} steps", fontsize=9)
        column[-1].set_xlabel("ns per step")
    handles = [plt.Line2D([], [], ls="", marker="os^vD<>PX*"[k % 10], color=f"C{k % 10}", label=method)
               for k, method in enumerate(methods)]
    handles.append(plt.Line2D([], [], color="k", ls="--", lw=1, label="dashed: cost of an exact method"))
    handles.append(plt.Line2D([], [], ls="", marker="o", color="k", fillstyle="none", label="hollow: memory of the 1 % rule"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0), ncols=5, frameon=False, fontsize=8)
    figure.tight_layout()
    save(figure, folder, "method_comparison")

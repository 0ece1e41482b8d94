"""Branches of periodic motions."""
import os

import numpy as np

from plots.common import LINE, UNSTABLE, legend_above, plt, read_table, save

COLOURS = (LINE, "#2a6fb0", "#e08a2e", "#3a8f5c", "#8e5fb0", "#9a7b4f")


def plot_response_curve(folder, response):
    """Amplitude over the parameter, unstable parts dashed, folds and grazing marked, as in Fig. 12 of Jones & Legrand (2014)."""
    curves = [response] + response.get("variants", [])
    figure, axis = plt.subplots(figsize=(8, 5))
    least_top = np.inf
    for colour, curve in zip(COLOURS * len(curves), curves):
        columns = read_table(os.path.join(folder, curve["table"]))
        name = next((n for n in ("force_N", "gap_m") if np.ptp(columns[n]) > 0), "frequency_Hz")
        if np.ptp(columns["frequency_Hz"]) > 0:
            name = "frequency_Hz"
        x, y, unstable = columns[name].copy(), 1e3 * columns["amplitude_m"], columns["stable"] == 0
        broken = curve.get("points_before_break", 0)
        if 0 < broken < len(x):
            x, y, unstable = (np.insert(values, broken, fill) for values, fill in ((x, np.nan), (y, np.nan), (unstable, False)))
            columns["kind"] = np.insert(columns["kind"], broken, "")
        least_top = min(least_top, np.nanmax(y))
        axis.plot(np.where(unstable, np.nan, x), np.where(unstable, np.nan, y), "-", color=colour, lw=1.3, label=curve["name"])
        # a dashed part reaches over to its neighbours
        wide = unstable | np.roll(unstable, 1) & (np.arange(len(x)) > 0) | np.roll(unstable, -1) & (np.arange(len(x)) < len(x) - 1)
        axis.plot(np.where(wide, x, np.nan), np.where(wide, y, np.nan), "--", color=colour, lw=1.3)
        for kind, marker in (("fold", "o"), ("grazing", "^")):
            there = columns["kind"] == kind
            axis.plot(x[there], y[there], marker, color=UNSTABLE if kind == "fold" else colour, ms=4, mfc="none")
    axis.set_xlabel({"frequency_Hz": "frequency [Hz]", "force_N": "force [N]", "gap_m": "gap [m]"}[name])
    axis.set_ylabel("largest displacement [mm]")
    axis.grid(alpha=0.3)
    # curves that run away on an undamped function would hide the rest
    axis.set_ylim(bottom=0, top=min(axis.get_ylim()[1], 1.3 * least_top))
    legend_above(axis)
    axis.annotate("dashed: unstable; circles: folds; triangles: grazing", (0.01, 0.98), xycoords="axes fraction", va="top",
                  fontsize=8)
    save(figure, folder, "response")

"""Basins of limit cycles: how motions go that start between each two of them, in the plane of how much of each they have."""
import os

import numpy as np

from plots.common import LIMIT, plt, read_table, save
from plots.limit_cycle import stability_of

MOST_COLUMNS = 3


def plot_basins(folder, basins, limit_cycle):
    if not basins.get("starts"):
        return
    paths = read_table(os.path.join(folder, "limit_cycle_basin_paths.csv"))
    cycles = basins["cycles"]
    unstable = {cycle["number"] for cycle in limit_cycle if stability_of(cycle) == "unstable"}
    colours = {cycle["number"]: f"C{k}" for k, cycle in enumerate(cycles)}
    frequencies = {cycle["number"]: f"{cycle['frequency_Hz']:.1f} Hz" for cycle in cycles}
    pairs = [(cycles[i]["number"], cycles[j]["number"]) for i in range(len(cycles)) for j in range(i + 1, len(cycles))]
    n_columns = min(MOST_COLUMNS, len(pairs))
    n_rows = -(-len(pairs) // n_columns)
    figure, axes = plt.subplots(n_rows, n_columns, figsize=(3.6 * n_columns, 3.6 * n_rows), squeeze=False)
    for axis in axes.flat[len(pairs):]:
        axis.axis("off")
    for (first, second), axis in zip(pairs, axes.flat):
        for number, start in enumerate(basins["starts"], 1):
            if start["between"] == [first, second] and np.any(paths["start"] == number):
                plot_path(axis, basins["size"], start, [paths[f"part_of_cycle_{k}"][paths["start"] == number] for k in (first, second)],
                          colours.get(start.get("winner"), LIMIT))
        for place, cycle in (((1, 0), first), ((0, 1), second)):
            axis.plot(*place, "o", ms=8, mfc="white" if cycle in unstable else colours[cycle], color=colours[cycle], clip_on=False)
        for border in basins["borders"]:
            if border["between"] == [first, second] and border["dividing_parts"]:
                parts = dict(zip(frequencies, border["dividing_parts"]))
                axis.plot(parts[first], parts[second], "x", color="black", ms=7)
        axis.set_xlabel(f"{frequencies[first]}, velocity over that of its cycle")
        axis.set_ylabel(f"{frequencies[second]}, velocity over that of its cycle")
        axis.set_xlim(0, None)
        axis.set_ylim(0, None)
        axis.grid(alpha=0.3)
    figure.suptitle("colour: the cycle that wins (grey: none)   \u25cf stable or not judged   \u25cb unstable   . start   x near the motion that divides the basins",
                    x=0.01, y=1.0, ha="left", va="bottom", fontsize=8)
    figure.tight_layout()
    save(figure, folder, "limit_cycle_basins")


def plot_path(axis, size, start, parts, colour):
    x, y = (np.concatenate([[begin], own]) for begin, own in zip((size * (1 - start["share"]), size * start["share"]), parts))
    axis.plot(x, y, "-", lw=1, color=colour)
    axis.plot(x[0], y[0], ".", color=colour)
    # where it goes
    k = len(x) // 2
    if k > 0:
        axis.annotate("", (x[k], y[k]), (x[k - 1], y[k - 1]), arrowprops={"arrowstyle": "->", "color": colour})

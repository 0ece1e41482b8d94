"""Roots and sweeps of the stability analysis."""
import os

import numpy as np
from matplotlib.colors import ListedColormap

from plots.common import edges, LEAST_DIVERGENCE_RATE, legend_above, read_table, save, short, swept_axis, UNSTABLE, plt

MAX_LABELS = 12


def axis_values(column):
    """Places on an axis, their ticks if they are words, and each row's place."""
    column = np.asarray(column)
    if column.dtype.kind == "f":
        values = np.unique(column)
        return values, None, np.searchsorted(values, column)
    words = list(dict.fromkeys(column))
    return np.arange(len(words), dtype=float), words, np.array([words.index(word) for word in column])


def at_least(limits, width):
    """Limits that far from each other, so that ticks do not resolve what stands still."""
    missing = max(0, width - (limits[1] - limits[0])) / 2
    return limits[0] - missing, limits[1] + missing


def plot_root_locus(folder, roots, names, columns, label, factor):
    n = min(3, len(names))
    rows = (len(names) + n - 1) // n
    figure, axes = plt.subplots(rows, n, figsize=(4 * n, 3.2 * rows), squeeze=False)
    for axis, name in zip(axes.ravel(), names):
        use = roots["root"] == name
        x, words, place = axis_values(roots[columns[0]][use])
        growth, frequency = roots["growth_1_s"][use], roots["frequency_Hz"][use]
        others = axis_values(roots[columns[-1]][use])[2] if len(columns) > 1 else np.zeros(len(growth))
        for other in np.unique(others):
            axis.plot(growth[others == other], frequency[others == other], "-", color="0.8", lw=0.8)
        points = axis.scatter(growth, frequency, c=(x if words else factor * x)[place], s=9)
        axis.axvline(0, color="k", lw=0.6)
        axis.set_title(short(name), fontsize=9)
        axis.set_ylim(at_least(axis.get_ylim(), 5e-3 * frequency.mean()))
        axis.set_xlabel("growth [1/s] (right of 0: unstable)")
        axis.set_ylabel("frequency [Hz]")
        axis.ticklabel_format(useOffset=False)
        bar = figure.colorbar(points, ax=axis, label=label)
        if words:
            bar.set_ticks(x, labels=words)
    for axis in axes.ravel()[len(names):]:
        axis.set_axis_off()
    figure.tight_layout()
    save(figure, folder, "root_locus")


def plot_sweep(folder, columns, entries):
    cases = read_table(os.path.join(folder, "stability_map.csv"))
    roots = read_table(os.path.join(folder, "stability_sweep.csv"))
    labels, factors = zip(*(swept_axis(entry, column) for entry, column in zip(entries, columns)))
    names = list(dict.fromkeys(roots["root"]))
    largest = {name: roots["divergence_rate"][roots["root"] == name].max() for name in names}
    names = sorted(names, key=lambda name: -largest[name])[:11]
    unstable = [name for name in names if largest[name] > LEAST_DIVERGENCE_RATE]
    plot_root_locus(folder, roots, unstable or names[:3], columns, labels[0], factors[0])

    if len(columns) == 1:
        figure, axis = plt.subplots(figsize=(7, 4))
        for name in names:
            use = roots["root"] == name
            x, words, place = axis_values(roots[columns[0]][use])
            x = x if words else factors[0] * x
            axis.plot(x[place], roots["divergence_rate"][use], ".-", label=short(name))
            if words:
                axis.set_xticks(x, words)
        axis.axhline(0, color="k", lw=0.6)
        axis.set_xlabel(labels[0])
        axis.set_ylabel("divergence rate Re$\\,\\lambda$ / Im$\\,\\lambda$ (> 0: unstable)")
        axis.set_title("" if unstable else "no unstable root in any case", fontsize=9)
        axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
        axis.grid(alpha=0.3)
        save(figure, folder, "stability_sweep")
        return
    x, x_words, i = axis_values(cases[columns[0]])
    y, y_words, j = axis_values(cases[columns[1]])
    x, y = x if x_words else factors[0] * x, y if y_words else factors[1] * y
    panels = [("number of unstable roots", i, j, cases["n_unstable"])]
    for name in unstable:
        use = roots["root"] == name
        panels.append((f"{short(name)}: divergence rate", axis_values(roots[columns[0]])[2][use],
                       axis_values(roots[columns[1]])[2][use], roots["divergence_rate"][use]))
    if not unstable:
        panels = [("stable in all cases;\nlargest divergence rate: " + ", ".join(short(n) for n in dict.fromkeys(cases["nearest"])),
                   i, j, cases["divergence_rate"])]
    # one scale for all roots
    scale = max((np.nanmax(values) for title, _, _, values in panels if not title.startswith("number")), default=1)
    n = min(3, len(panels))
    rows = (len(panels) + n - 1) // n
    figure, axes = plt.subplots(rows, n, figsize=(4.4 * n, 3.1 * rows), squeeze=False)
    for axis, (title, columns_i, rows_j, values) in zip(axes.ravel(), panels):
        field = np.full((len(y), len(x)), np.nan)
        field[rows_j, columns_i] = values
        axis.set_facecolor("0.8")  # left out
        if title.startswith("number"):
            most = int(np.nanmax(field))
            colours = ["white"] + list(plt.get_cmap("YlOrRd")(np.linspace(0.25, 1, most)))
            image = axis.pcolormesh(edges(x), edges(y), field, cmap=ListedColormap(colours), vmin=-0.5, vmax=most + 0.5)
            figure.colorbar(image, ax=axis, ticks=range(0, most + 1, 1 + most // 10), label="roots")
        elif unstable:
            image = axis.pcolormesh(edges(x), edges(y), field, cmap="RdBu_r", vmin=-scale, vmax=scale)
            if min(field.shape) > 3:
                axis.contour(x, y, field, [0], colors="k", linewidths=0.8)
            figure.colorbar(image, ax=axis, label="> 0: unstable", extend="min" if np.nanmin(field) < -scale else "neither")
        else:
            image = axis.pcolormesh(edges(x), edges(y), field, cmap="Blues_r", vmin=1.5 * np.nanmin(field), vmax=0)
            figure.colorbar(image, ax=axis, label="0: limit of stability")
        axis.set_title(title, fontsize=8)
        axis.set_xlabel(labels[0])
        axis.set_ylabel(labels[1])
        if x_words:
            axis.set_xticks(x, x_words)
        if y_words:
            axis.set_yticks(y, y_words)
    for axis in axes.ravel()[len(panels):]:
        axis.set_axis_off()
    figure.suptitle(f"Stability over {labels[0]} and {labels[1]}, {len(cases['case'])} cases", fontsize=10)
    figure.tight_layout()
    save(figure, folder, "stability_map")


def plot_divergence(folder):
    """Divergence rates Re(lambda) / Im(lambda) of all oscillating roots, the unstable ones named."""
    roots = read_table(os.path.join(folder, "stability.csv"))
    shown = roots["frequency_Hz"] > 0
    if "case" in roots:  # of a sweep the first
        shown &= roots["case"] == roots["case"][0]
    if not shown.any():
        return
    frequency, rate = roots["frequency_Hz"][shown], roots["divergence_rate"][shown]
    label = roots["label"][shown]
    unstable = rate > LEAST_DIVERGENCE_RATE
    figure, axis = plt.subplots(figsize=(8, 4.4))
    # heavily damped roots would hide what is near the axis
    near = max(1.5 * rate.max(), 2e-3)
    if rate.min() < -10 * near:
        axis.set_yscale("symlog", linthresh=near)
    axis.set_ylim(max(1.5 * min(rate.min(), -near / 10), -1), near)
    axis.plot(frequency[~unstable], rate[~unstable], "o", ms=3, color="#7f8c8d", label=f"stable ({np.sum(~unstable)})")
    if unstable.any():
        axis.plot(frequency[unstable], rate[unstable], "o", ms=5, color=UNSTABLE,
                  label=f"unstable: divergence rate > $10^{{{round(np.log10(LEAST_DIVERGENCE_RATE))}}}$ ({unstable.sum()})")
    axis.axhline(0, color="k", lw=0.6)
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel(r"divergence rate Re$\,\lambda$ / Im$\,\lambda$")
    axis.set_title("" if unstable.any() else "no unstable root", fontsize=9)
    legend_above(axis)
    axis.grid(alpha=0.3)
    figure.canvas.draw()
    taken, points = [], axis.transData.transform(np.column_stack([frequency, rate])[unstable])
    for i in sorted(np.flatnonzero(unstable), key=lambda i: -rate[i])[:MAX_LABELS]:
        for x, y in ((5, 2), (-5, 2), (5, 12), (-5, 12), (5, -2), (-5, -2)):
            text = axis.annotate(f"{short(label[i])}, {frequency[i]:.0f} Hz", (frequency[i], rate[i]), textcoords="offset points",
                                 xytext=(x, y), ha="left" if x > 0 else "right", va="bottom" if y > 0 else "top", fontsize=7)
            box = text.get_window_extent()
            inside = axis.bbox.x0 < box.x0 and box.x1 < axis.bbox.x1 and axis.bbox.y0 < box.y0 and box.y1 < axis.bbox.y1
            if inside and not any(box.overlaps(other) for other in taken) and not box.count_contains(points):
                taken.append(box)
                break
            text.remove()
    save(figure, folder, "divergence_rates")

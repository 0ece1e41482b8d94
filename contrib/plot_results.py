#!/usr/bin/env python3
"""plot_results.py FOLDER: figures of a run, from results.json and the tables in its output folder.

figures/contact_patch_<k>.png   pressure, traction and status over the patch
figures/centre_line_<k>.png     tractions along y = 0, as in Fig. 7 of Lai et al. (2018)
figures/creep_curves.png        tangential force (spin: moment too) against what is swept
figures/frequency_response.png  mobilities of the driving points over frequency, as in Fig. 6
figures/identification.png      receptances given, fitted by poles, and their differences
figures/stabilisation_chart.png identified poles over their number
figures/stability_sweep.png     divergence rates along a sweep of one entry
figures/stability_map.png       number of unstable roots and each one's divergence rate over a sweep of two entries
figures/root_locus.png          paths of the followed roots: growth against frequency
figures/mode_shapes_<body>.png  deformed shapes coloured by amplitude, as in Fig. 3 of the paper
figures/unstable_shapes.png     deformed shapes of the unstable roots at their largest, as in Figs 9 to 12
figures/divergence_rates.png    divergence rates of the roots, as in Fig. 8
figures/transient_force.png     tangential force with stick and slip counts, as in Fig. 13
figures/transient_status.png    status of the contact points through a period, as in Fig. 14 (needs Patch interval)
figures/transient_<signal>.png  velocity of a probe and its spectrogram, as in Fig. 15
figures/modal_convolution_*.png displacements, forces and 1/3-octave bands of the force, as in Figs 2, 3, 6, 7 of Meftah & Duhamel
figures/method_comparison.png   error against cost of the response methods
Needs matplotlib, after a transient also h5py; exit code 4 without. Tractions act on body 1; the contact travels towards -x.
"""
import base64
import csv
import glob
import json
import os
import re
import struct
import sys
import warnings
import xml.etree.ElementTree as ElementTree
import zlib

try:
    import numpy as np
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import ListedColormap
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
    if os.path.exists(os.path.join(sys.argv[1], "histories.h5")):
        import h5py
except ImportError:
    sys.exit(4)

MAX_PATCHES = 4
MAX_LABELS = 12
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


def on_grid(patch, values):
    x, y = np.unique(np.round(patch["x_m"], 12)), np.unique(np.round(patch["y_m"], 12))
    return 1e3 * x, 1e3 * y, np.asarray(values).reshape(len(y), len(x))


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


def legend_above(axis, handles=None, **style):
    """Outside of the data."""
    axis.legend(handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=4, frameon=False, fontsize=8,
                borderaxespad=0.2, handlelength=1.4, **style)


def status_legend(names):
    """Squares of the status's colours."""
    colours = {"open": OPEN, "stick": STICK, "slip": SLIP}
    return [plt.Line2D([], [], ls="", marker="s", ms=8, color=colours[name], markeredgecolor="0.6", label=name) for name in names]


def plot_patch(folder, k, case):
    patch = read_table(os.path.join(folder, f"contact_patch_{k}.csv"))
    traction = np.hypot(patch["traction_x_Pa"], patch["traction_y_Pa"])
    closed = patch["status"] > 0
    if not closed.any():
        return
    figure, axes = plt.subplots(1, 3, figsize=(11, 3), sharey=True, width_ratios=[1.25, 1.25, 1])
    x, y, _ = on_grid(patch, traction)
    half_x, half_y = (x[1] - x[0]) / 2 if len(x) > 1 else 0.5, (y[1] - y[0]) / 2 if len(y) > 1 else 0.5
    extent = [x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y]
    for axis, values, title, label in ((axes[0], patch["pressure_Pa"], "pressure", "MPa"),
                                       (axes[1], traction, "tangential traction on body 1", "MPa")):
        image = axis.imshow(np.ma.masked_equal(on_grid(patch, np.where(closed, values / 1e6, 0))[2], 0), origin="lower",
                            extent=extent, cmap="viridis", interpolation="nearest")
        figure.colorbar(image, ax=axis, label=label, shrink=0.8)
        axis.set_title(title)
    strong = closed & (traction > 0.02 * max(traction.max(), 1e-300))
    step = max(1, int(round(np.sqrt(strong.sum() / 150))))
    chosen = np.zeros(len(closed), bool).reshape(len(y), len(x))
    chosen[::step, ::step] = True
    strong &= chosen.ravel()
    if strong.any():
        axes[1].quiver(1e3 * patch["x_m"][strong], 1e3 * patch["y_m"][strong], patch["traction_x_Pa"][strong],
                       patch["traction_y_Pa"][strong], color="white", pivot="mid", width=0.004)
    colours = ListedColormap([OPEN, STICK, SLIP])
    axes[2].imshow(on_grid(patch, patch["status"])[2], origin="lower", extent=extent, cmap=colours, vmin=-0.5, vmax=2.5,
                   interpolation="nearest")
    axes[2].set_title("status")
    axes[2].legend(handles=status_legend(("open", "stick", "slip")), loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    for axis in axes:
        axis.set_xlabel("x [mm] (material flows to the right)")
        axis.set_aspect("equal")
    axes[0].set_ylabel("y [mm]")
    figure.suptitle(case_title(case), fontsize=9)
    figure.tight_layout()
    save(figure, folder, f"contact_patch_{k}")


def plot_centre_line(folder, k, case):
    patch = read_table(os.path.join(folder, f"contact_patch_{k}.csv"))
    line = np.abs(patch["y_m"] - patch["y_m"][np.argmin(np.abs(patch["y_m"]))]) < 1e-12
    if not (patch["pressure_Pa"][line] > 0).any():
        return
    x = 1e3 * patch["x_m"][line]
    figure, axis = plt.subplots(figsize=(6, 3.8))
    axis.plot(x, case["friction"] * patch["pressure_Pa"][line] / 1e6, "k--", lw=1, label=r"$\mu\, p$")
    axis.plot(x, -case["friction"] * patch["pressure_Pa"][line] / 1e6, "k--", lw=1)
    axis.plot(x, patch["traction_x_Pa"][line] / 1e6, "o-", ms=3, color="#6a3d9a", label=r"$r_x$")
    axis.plot(x, patch["traction_y_Pa"][line] / 1e6, "s-", ms=3, color="#27ae60", label=r"$r_y$")
    stick = patch["status"][line] == 1
    if stick.any():
        half = np.min(np.diff(x)) / 2 if len(x) > 1 else 0.5
        axis.axvspan(x[stick].min() - half, x[stick].max() + half, color=STICK, alpha=0.15, lw=0, label="stick")
    axis.set_xlabel("x [mm] (leading edge left)")
    axis.set_ylabel("traction on body 1 [MPa]")
    axis.set_title("Tractions along y = 0\n" + case_title(case), fontsize=9)
    axis.legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    axis.grid(alpha=0.3)
    save(figure, folder, f"centre_line_{k}")


SWEEPS = {"longitudinal_creepage": ("longitudinal creepage [%]", 100), "lateral_creepage": ("lateral creepage [%]", 100),
          "spin_1_m": ("spin [1/m]", 1), "friction": ("friction coefficient", 1),
          "normal_force_N": ("normal force [kN]", 1e-3)}


def plot_curves(folder, cases):
    """One panel per curve: |Ft| / N against the swept quantity, one line per friction."""
    curves = {}
    for case in cases:
        curves.setdefault(case.get("curve", "single"), []).append(case)
    panels = []
    for name, members in curves.items():
        varying = [q for q in SWEEPS if q != "friction" and np.ptp([c[q] for c in members]) > 1e-9 * max(abs(c[q]) for c in members)]
        exact = [q for q in varying if q.split("_")[0] in name.lower()]
        if len(members) >= 3 and (exact or varying):
            panels.append((name, members, (exact or varying)[0]))
        elif len(members) >= 3 and np.ptp([c["friction"] for c in members]) > 0:
            panels.append((name, members, "friction"))
    if not panels:
        return
    figure, axes = plt.subplots(1, len(panels), figsize=(5 * len(panels), 3.8), squeeze=False)
    for axis, (name, members, quantity) in zip(axes[0], panels):
        label, factor = SWEEPS[quantity]
        groups = {}
        for case in members:
            groups.setdefault(0 if quantity == "friction" else case["friction"], []).append(case)
        for friction, group in sorted(groups.items()):
            group.sort(key=lambda case: case[quantity])
            x = [factor * case[quantity] for case in group]
            force = [np.hypot(*case["tangential_force_N"]) / case["normal_force_N"] for case in group]
            line, = axis.plot(x, force, "o-", ms=3, label="" if quantity == "friction" else f"$\\mu$ = {friction:g}")
            if quantity == "spin_1_m":
                moment = [case["spin_moment_Nm"] / case["normal_force_N"] * 1e3 for case in group]
                axis.plot(x, moment, "s--", ms=3, color=line.get_color(), label=f"$M_z/N$ [mm], $\\mu$ = {friction:g}")
        axis.set_xlabel(label)
        axis.set_ylabel("$|F_t| / N$")
        axis.grid(alpha=0.3)
        if axis.get_legend_handles_labels()[1]:
            axis.legend(fontsize=8)
    figure.tight_layout()
    save(figure, folder, "creep_curves")


def short(label):
    """wheel:axial(0,3) without the body"""
    return label.split(":", 1)[-1]


def axis_values(column):
    """Places on an axis, their ticks if they are words, and each row's place."""
    column = np.asarray(column)
    if column.dtype.kind == "f":
        values = np.unique(column)
        return values, None, np.searchsorted(values, column)
    words = list(dict.fromkeys(column))
    return np.arange(len(words), dtype=float), words, np.array([words.index(word) for word in column])


def edges(values):
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
            limit = np.nanmax(field)
            image = axis.pcolormesh(edges(x), edges(y), field, cmap="RdBu_r", vmin=-limit, vmax=limit)
            if min(field.shape) > 3:
                axis.contour(x, y, field, [0], colors="k", linewidths=0.8)
            figure.colorbar(image, ax=axis, label="> 0: unstable", extend="min" if np.nanmin(field) < -limit else "neither")
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
    figure.tight_layout()
    save(figure, folder, "stability_map")


def read_vtu(name):
    """Points, outer quadrilaterals and point data of a VTU file as deal.II writes it (ascii or compressed base64)."""
    root = ElementTree.parse(name).getroot()
    types = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt32": "<u4", "Int64": "<i8", "UInt64": "<u8",
             "UInt8": "<u1", "Int8": "<i1"}
    header = "<u8" if root.get("header_type") == "UInt64" else "<u4"

    def array(node):
        kind = types[node.get("type")]
        if node.get("format") == "ascii":
            values = np.array((node.text or "").split(), dtype=float).astype(kind)
        else:
            text = "".join((node.text or "").split())
            size = np.dtype(header).itemsize
            first = np.frombuffer(base64.b64decode(text[:4 * ((size * 3 + 2) // 3) + 4])[:size * 3], header)
            n_blocks = int(first[0])
            length = 4 * ((size * (3 + n_blocks) + 2) // 3)
            sizes = np.frombuffer(base64.b64decode(text[:length])[:size * (3 + n_blocks)], header)[3:]
            data, raw, at = base64.b64decode(text[length:]), b"", 0
            for block in sizes:
                raw += zlib.decompress(data[at:at + int(block)])
                at += int(block)
            values = np.frombuffer(raw, kind)
        n = int(node.get("NumberOfComponents") or 1)
        return values.reshape(-1, n) if n > 1 else values

    # One piece per rank.
    points, quads, data = [], [], {}
    n_points = 0
    for piece in root.iter("Piece"):
        if int(piece.get("NumberOfCells")) == 0:
            continue
        points.append(array(piece.find("Points/DataArray")).reshape(-1, 3))
        cells = {node.get("Name"): array(node) for node in piece.findall("Cells/DataArray")}
        quads.append(surface_quads(points[-1], cells) + n_points)
        n_points += len(points[-1])
        for node in piece.findall("PointData/DataArray"):
            data.setdefault(node.get("Name"), []).append(array(node))
    return np.concatenate(points), np.concatenate(quads), {name: np.concatenate(parts) for name, parts in data.items()}


def surface_quads(points, cells):
    """Outer faces of hexahedra (or the quadrilaterals themselves) as rows of four point numbers."""
    offsets, connectivity = cells["offsets"].astype(int), cells["connectivity"].astype(int)
    sizes = np.diff(np.concatenate([[0], offsets]))
    if (sizes == 4).all():
        return connectivity.reshape(-1, 4)
    hexahedra = connectivity.reshape(-1, sizes[0])[:, :8]
    faces = np.concatenate([hexahedra[:, f] for f in
                            ([0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])])
    # Cells do not share points in the file: equal places are found by their coordinates.
    _, number = np.unique(np.round(points / 1e-7).astype(np.int64), axis=0, return_inverse=True)
    key = np.sort(number.ravel()[faces], axis=1)
    _, index, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    return faces[index[count == 1]]


def plot_plane_shape(axis, title, points, quads, values):
    """A plane body on its shape at rest (grey); of bodies that write their boundary alone its outline."""
    amplitude = np.linalg.norm(values, axis=1)
    moved = points + values * (0.08 * np.ptp(points, axis=0).max() / max(amplitude.max(), 1e-300))
    colour = plt.cm.turbo(amplitude[quads].mean(axis=1) / max(amplitude.max(), 1e-300))
    axis.add_collection(PolyCollection(points[quads], facecolors="none", edgecolors="0.8", linewidths=1))
    axis.add_collection(PolyCollection(moved[quads], facecolors=colour, edgecolors=colour, linewidths=2))
    axis.autoscale()
    axis.set_aspect("equal")
    axis.set_axis_off()
    axis.set_title(title, fontsize=8)


def plot_shapes(folder, name, panels, columns):
    """Deformed surfaces coloured by their displacement: title, points, quadrilaterals and displacement of each panel."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    rows = (len(panels) + columns - 1) // columns
    plane = (np.ptp(panels[0][1], axis=0) == 0).any()
    figure = plt.figure(figsize=(4 * columns, (2.6 if plane else 4) * rows))
    for position, (title, points, quads, values) in enumerate(panels):
        flat = np.ptp(points, axis=0) == 0
        if flat.any():
            plot_plane_shape(figure.add_subplot(rows, columns, position + 1), title, points[:, ~flat], quads, values[:, ~flat])
            continue
        axis = figure.add_subplot(rows, columns, position + 1, projection="3d")
        amplitude = np.linalg.norm(values, axis=1)
        size = np.ptp(points, axis=0).max()
        moved = points + values * (0.08 * size / max(amplitude.max(), 1e-300))
        # A wheel is looked at along its axle: y to the front.
        moved, points = moved[:, [1, 0, 2]], points[:, [1, 0, 2]]
        colour = plt.cm.turbo(amplitude[quads].mean(axis=1) / max(amplitude.max(), 1e-300))
        axis.add_collection3d(Poly3DCollection(moved[quads], facecolors=colour, edgecolors=colour, linewidths=0.2))
        centre = (points.max(axis=0) + points.min(axis=0)) / 2
        for set_limit, c in zip((axis.set_xlim, axis.set_ylim, axis.set_zlim), centre):
            set_limit(c - size / 2, c + size / 2)
        axis.set_box_aspect((1, 1, 1), zoom=1.4)
        axis.view_init(elev=18, azim=-35)
        axis.set_axis_off()
        axis.set_title(title)
    save(figure, folder, name)


def plot_modes(folder, body, modes):
    """Deformed shapes from fields/mode_<body>_<number>.vtu: those of the paper's Fig. 3, or else the first six."""
    frequencies, labels = modes["frequencies_Hz"], modes.get("labels", [])
    files = {int(re.findall(r"\d+", name)[-1]): name
             for name in glob.glob(os.path.join(folder, "fields", f"mode_{glob.escape(body)}_*.vtu"))}
    wanted = [labels.index(label) for label in ("axial(0,1)", "radial(1,5)", "axial(0,6)") if label in labels]
    elastic = [i for i in sorted(files) if i < len(frequencies) and frequencies[i] > 0]
    chosen = [i for i in wanted if i in files] or elastic[:6]
    if not chosen:
        return
    panels = []
    for i in chosen:
        points, quads, data = read_vtu(files[i])
        values = next(v for v in data.values() if v.ndim == 2 and v.shape[1] == 3)
        title = f"{labels[i]}, {frequencies[i]:.1f} Hz" if i < len(labels) else f"{frequencies[i]:.1f} Hz"
        panels.append((title, points, quads, values))
    plot_shapes(folder, f"mode_shapes_{body}", panels, min(3, len(panels)))


def plot_unstable(folder, analysis):
    """The first six unstable roots from unstable_<root>_<body>.pvd: the body that moves most, when it moves most."""
    cases = analysis.get("cases") or [analysis]
    panels = []
    for number, root in enumerate(cases[0].get("unstable", [])[:6]):
        most = None
        for index in glob.glob(os.path.join(folder, f"unstable_{number}_*.pvd")):
            frames = [node.get("file") for node in ElementTree.parse(index).getroot().iter("DataSet")]
            for frame in frames[:len(frames) // 2]:  # the other half of the period is the opposite
                points, quads, data = read_vtu(os.path.join(folder, frame))
                values = data["displacement_m"]
                largest = np.linalg.norm(values, axis=1).max()
                if most is None or largest > most[0]:
                    most = largest, points, quads, values
        if most:
            panels.append((f"{root['label']}, {root['frequency_Hz']:.1f} Hz, {root['growth_1_s']:+.2f} 1/s",) + most[1:])
    if panels:
        plot_shapes(folder, "unstable_shapes", panels, 2 if len(panels) in (2, 4) else min(3, len(panels)))


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


def plot_line(axis, time, values, **style):
    """A long signal by the least and the largest value of each of 2000 pieces."""
    pieces = len(values) // 4000
    if pieces >= 5:
        n = len(values) // (2 * pieces) * 2 * pieces
        parts = values[:n].reshape(-1, 2 * pieces)
        values = np.column_stack([parts.min(axis=1), parts.max(axis=1)]).ravel()
        time = time[:n:pieces][:len(values)]
    axis.plot(time, values, **style)


def last_period(transient, history):
    """Begin and end of the last period of the dominant frequency, as far as the run is long enough."""
    frequencies = transient.get("dominant_frequencies_Hz", [])
    end = history["time_s"][-1]
    if not frequencies or (end - history["time_s"][0]) * frequencies[0] < 2:
        return None
    return end - 1 / frequencies[0], end


def force_panels(history, friction):
    """What is not zero, a panel each: axis label and lines (values, style)."""
    normal = history["normal_force_N"] / 1e3
    forces = {c: history[f"tangential_force_{c}_N"] / 1e3 for c in "xy"}
    component = max("xy", key=lambda c: np.ptp(forces[c]) + np.abs(forces[c]).max())
    force = forces[component]
    panels = []
    if np.abs(force).max() > 1e-9 * np.abs(normal).max():
        lines = [(force, {"color": LINE, "lw": 0.9, "label": f"$F_{component}$ on body 1"})]
        if friction:
            lines.insert(0, ((-1 if force.mean() < 0 else 1) * friction * normal, {"color": LIMIT, "lw": 1.5, "label": r"$\mu N$"}))
        panels.append(("force [kN]", lines))
    if not panels or normal.min() <= 0:
        panels.append(("force [kN]", [(normal, {"color": LINE, "lw": 0.9, "label": "normal force $N$"})]))
        if normal.min() <= 0 < history["smallest_gap_m"].max():
            gap = np.where((history["smallest_gap_m"] == 0) & (history["contact_points"] == 0), np.nan, 1e3 * history["smallest_gap_m"])
            panels.append(("gap [mm]", [(gap, {"color": LINE, "lw": 0.9, "label": "smallest gap"})]))
    if history["contact_points"].max() > 1:
        counts = [("contact_points", LINE)] if not friction else [("stick_points", STICK), ("slip_points", SLIP)]
        panels.append(("points", [(history[name], {"color": colour, "lw": 1.2, "label": name.replace("_", " ")})
                                  for name, colour in counts]))
    return panels


def plot_force(folder, transient, history, frames, title):
    """Forces and counts over the run, then over the last three periods with the frames' numbers."""
    period = last_period(transient, history)
    panels = force_panels(history, transient.get("friction"))
    figure, axes = plt.subplots(len(panels), 2 if period else 1, figsize=(11 if period else 7, 1 + 2.2 * len(panels)), sharex="col",
                                squeeze=False)
    time = history["time_s"]
    for column in range(axes.shape[1]):
        chosen = time >= (period[1] - 3 * (period[1] - period[0]) if column == 1 else time[0])
        for axis, (label, lines) in zip(axes[:, column], panels):
            for values, style in lines:
                plot_line(axis, time[chosen], values[chosen], **style)
            axis.set_ylabel(label)
            axis.grid(alpha=0.3)
            if column == 0:
                legend_above(axis)
        axes[-1, column].set_xlabel("time [s]")
    if period:
        axes[0, 1].set_title("last three periods" + (", frames of transient_status numbered" if frames else ""), fontsize=8, loc="left")
        for number, (t, _) in enumerate(frames):
            value = np.interp(t, time, panels[0][1][-1][0])
            axes[0, 1].plot(t, value, ".", color=LINE, ms=5)
            axes[0, 1].annotate(str(number + 1), (t, value), textcoords="offset points", xytext=(2, 4), fontsize=8)
    figure.suptitle(title, fontsize=9)
    figure.tight_layout()
    save(figure, folder, "transient_force")


def patch_frames(folder, period):
    """At most eight frames of the contact patch, equally far from each other in the last period: (time, file)."""
    index = os.path.join(folder, "patch.pvd")
    if not os.path.exists(index):
        return []
    frames = [(float(node.get("timestep")), os.path.join(folder, node.get("file")))
              for node in ElementTree.parse(index).getroot().iter("DataSet")]
    if period:
        frames = [frame for frame in frames if period[0] - 1e-9 <= frame[0] <= period[1] + 1e-9] or frames[-8:]
    else:
        frames = frames[-8:]
    return [frames[i] for i in np.unique(np.linspace(0, len(frames) - 1, 8).round().astype(int))] if frames else []


def plot_status(folder, frames, title):
    """Status maps of the points in contact."""
    columns = min(4, len(frames))
    rows = (len(frames) + columns - 1) // columns
    read = [read_vtu(name) for _, name in frames]
    every = np.concatenate([points for points, _, _ in read])
    figure, axes = plt.subplots(rows, columns, figsize=(2.6 * columns, 2.8 * rows), squeeze=False, sharex=True, sharey=True)
    for axis in axes.ravel()[len(frames):]:
        axis.set_axis_off()
    colours = ListedColormap([OPEN, STICK, SLIP])
    for number, (axis, (time, _), (points, quads, data)) in enumerate(zip(axes.ravel(), frames, read)):
        axis.add_collection(PolyCollection(1e3 * points[quads][:, [0, 1, 3, 2] if crossed(points[quads[0]]) else [0, 1, 2, 3], :2],
                                           array=data["status"][quads[:, 0]], cmap=colours, clim=(-0.5, 2.5), edgecolors="w", linewidths=0.3))
        axis.set_title(f"{number + 1}: {1e3 * time:.4g} ms", fontsize=8)
        axis.set_aspect("equal")
        axis.set_xlim(1e3 * every[:, 0].min() - 1, 1e3 * every[:, 0].max() + 1)
        axis.set_ylim(1e3 * every[:, 1].min() - 1, 1e3 * every[:, 1].max() + 1)
    for axis in axes[-1]:
        axis.set_xlabel("x [mm] (leading edge left)", fontsize=8)
    for axis in axes[:, 0]:
        axis.set_ylabel("y [mm]", fontsize=8)
    figure.suptitle(title, fontsize=9)
    figure.tight_layout()
    figure.legend(handles=status_legend(("stick", "slip")), loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(figure, folder, "transient_status")


def crossed(corners):
    """Whether the corners of a quadrilateral are counted line by line and not around it."""
    a, b, c, d = corners
    return np.dot(b - a, d - c) > 0


def plot_signal(folder, name, time, values, title):
    """A velocity over time and its spectrogram up to 6 kHz."""
    if len(values) < 256:
        return
    step = (time[-1] - time[0]) / (len(time) - 1)
    figure, axes = plt.subplots(2, 1, figsize=(8, 5.5), sharex=True)
    plot_line(axes[0], time, values, color=LINE, lw=0.7)
    axes[0].set_ylabel("velocity [m/s]")
    axes[0].set_title(f"{name.replace('_', ' ')}\n{title}", fontsize=9)
    axes[0].grid(alpha=0.3)
    # a quarter of the samples per second are enough for 6 kHz; the transform cuts what is above
    length = len(values) * step
    n = min(len(values), int(24000 * length))
    if n >= 64:
        reduced = np.fft.irfft(np.fft.rfft(values)[:n // 2 + 1] * (n / len(values)), n)
        window = int(min(n // 4, 2 ** round(np.log2(max(64, 0.02 * n / length if length > 0.2 else n / 8)))))
        power, frequencies, instants = matplotlib.mlab.specgram(reduced, NFFT=window, Fs=n / length, noverlap=window * 3 // 4,
                                                                pad_to=4 * window)
        level = 10 * np.log10(np.maximum(power, 1e-30))
        image = axes[1].pcolormesh(time[0] + instants, frequencies, level, vmin=level.max() - 80, vmax=level.max(), cmap="magma",
                                   shading="auto", rasterized=True)
        axes[1].set_ylim(0, min(6000, frequencies[-1]))
        figure.colorbar(image, ax=axes, label="power spectral density [dB re 1 (m/s)$^2$/Hz]", shrink=0.8)
    axes[1].set_ylabel("frequency [Hz]")
    axes[1].set_xlabel("time [s]")
    save(figure, folder, f"transient_{name}")


def plot_transient(folder, transient, title):
    with h5py.File(os.path.join(folder, "histories.h5")) as file:
        history = {name: np.asarray(file[name]) for name in file if file[name].ndim == 1 and name != "key"}
    if len(history["time_s"]) < 2:
        return
    last = dict(transient.get("last", {}), friction=transient.get("friction", 0))
    if "speed_m_s" in last:
        if last["normal_force_N"] > 0:
            title += ("\n" if title else "") + "at the end: " + case_title(last)
        else:
            title += ("\n" if title else "") + f"impulse {transient['impulse_Ns']:.4g} N s; no contact at the end"
    frames = patch_frames(folder, last_period(transient, history))
    plot_force(folder, transient, history, frames, title)
    if frames:
        plot_status(folder, frames, title)
    name = os.path.join(folder, "signals.h5")
    if os.path.exists(name):
        with h5py.File(name) as file:
            time = np.asarray(file["time_s"])
            for column in file:
                if column != "time_s":
                    plot_signal(folder, column[:-len("_m_s")], time, np.asarray(file[column]), title)


def third_octaves(time, values):
    """Centres and rms values of 1/3-octave bands (base ten), from the spectrum of the second half of a history."""
    values = values[len(values) // 4:]
    n, step = len(values), time[1] - time[0]
    power = 2 * np.abs(np.fft.rfft((values - values.mean()) * np.hanning(n)) / n) ** 2 / 0.375
    frequency = np.fft.rfftfreq(n, step)
    centres = 10 ** (np.arange(10, 50) / 10)
    bands = [(c, power[(frequency >= c * 10 ** -0.05) & (frequency < c * 10 ** 0.05)].sum()) for c in centres
             if c * 10 ** -0.05 > 2 / (n * step) and c * 10 ** 0.05 < 0.5 / step]
    return np.array([c for c, _ in bands]), np.sqrt([p for _, p in bands])


def plot_modal_convolution(folder, analysis):
    """Displacements and forces of up to three contact points, as in Figs 2, 3, 6 and 7 of Meftah & Duhamel (2011), and
    third-octave bands of the whole force; error against cost of compared methods."""
    with h5py.File(os.path.join(folder, "histories.h5")) as file:
        time = np.asarray(file["time_s"])
        n_points = sum(1 for name in file if name.endswith("_force_N"))
        shown = sorted({0, n_points // 2, n_points - 1})
        u = {i: np.asarray(file[f"point_{i}_displacement_m"]) for i in shown}
        q = {i: np.asarray(file[f"point_{i}_force_N"]) for i in shown}
        whole = sum(np.asarray(file[f"point_{i}_force_N"]) for i in range(n_points))
    if len(time) < 2:
        return
    for values, name, label, factor in ((u, "displacement", "displacement [mm]", 1e3), (q, "force", "force [N]", 1)):
        figure, axis = plt.subplots(figsize=(8, 3.5))
        for i in shown:
            plot_line(axis, time, values[i] * factor, lw=0.8, label=f"point {i}")
        axis.set_xlabel("time [s]")
        axis.set_ylabel(label)
        if len(shown) > 1:
            axis.legend(fontsize=8)
        if name == "force":
            top = np.percentile(np.concatenate(list(values.values())), 99.8)
            axis.set_ylim(min(0, min(v.min() for v in values.values())), 1.2 * top if top > 0 else None)
        save(figure, folder, f"modal_convolution_{name}")
    centres, rms = third_octaves(time, whole) if len(time) > 64 else ([], [])
    if len(centres) > 2:
        figure, axis = plt.subplots(figsize=(8, 3.5))
        axis.bar(range(len(centres)), rms, color="0.5")
        axis.set_yscale("log")
        axis.set_xticks(range(0, len(centres), 3), [f"{c:.3g}" for c in centres[::3]])
        axis.set_xlabel("1/3-octave band [Hz]")
        axis.set_ylabel("rms of the contact force [N]")
        save(figure, folder, "modal_convolution_bands")


def plot_comparison(folder, entries):
    """Error of the displacement against cost, one panel per run of the comparison."""
    runs = sorted({(entry["step_s"], entry["steps"]) for entry in entries})
    figure, axes = plt.subplots(1, len(runs), figsize=(4.2 * len(runs), 3.8), squeeze=False, sharey=True)
    for axis, run in zip(axes[0], runs):
        for k, entry in enumerate(e for e in entries if (e["step_s"], e["steps"]) == run):
            if "error_displacement_m" in entry:
                label = entry["method"] + (f", {entry['memory_steps']} steps" if entry["memory_steps"] else "")
                axis.loglog(entry["seconds_per_step"] * 1e9, max(entry["error_displacement_m"], 1e-16),
                            "os^vD<>PX*"[k % 10], label=label)
        axis.set_title(f"h = {run[0] * 1e3:g} ms, {run[1]} steps")
        axis.set_xlabel("ns per step")
        axis.legend(fontsize=6)
        axis.grid(alpha=0.3)
    axes[0, 0].set_ylabel("largest error of the displacement [m]")
    figure.tight_layout()
    save(figure, folder, "method_comparison")


def plot_frequency_response(folder, analysis):
    """Magnitude at the driving points, one panel each, a line per body, as in Fig. 6; dashed: damping of a run in time."""
    curves = {}
    for body, one in analysis["bodies"].items():
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


def receptances(folder, table):
    """Complex columns by name of the pair, and the frequencies."""
    columns = read_table(os.path.join(folder, table))
    return columns["frequency_Hz"], {name[:-len("_real_m_N")]: columns[name] + 1j * columns[name.replace("_real_", "_imag_")]
                                     for name in columns if name.endswith("_real_m_N")}


def plot_identification(folder, fits):
    """Data and fits, one panel per entry of the first row (at most four), with the distance of each fit from the data."""
    frequency, data = receptances(folder, fits[0]["data"])
    names = list(data)[:4]
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


def main():
    folder = sys.argv[1]
    with open(os.path.join(folder, "results.json")) as file:
        results = json.load(file)
    analyses = results["analyses"]
    os.makedirs(os.path.join(folder, "figures"), exist_ok=True)
    cases = analyses.get("quasi_static_rolling", {}).get("cases", [])
    patches = [k for k in range(len(cases)) if os.path.exists(os.path.join(folder, f"contact_patch_{k}.csv"))]
    for k in patches if len(patches) <= MAX_PATCHES else patches[:1] + patches[-1:]:
        plot_patch(folder, k, cases[k])
        plot_centre_line(folder, k, cases[k])
    plot_curves(folder, cases)
    if "frequency_response" in analyses:
        plot_frequency_response(folder, analyses["frequency_response"])
    if analyses.get("identification"):
        plot_identification(folder, analyses["identification"])
    if analyses.get("stability", {}).get("sweep"):
        plot_sweep(folder, analyses["stability"]["swept_columns"], analyses["stability"]["swept_entries"])
    for body, modes in analyses.get("modes", {}).items():
        if isinstance(modes, dict) and "frequencies_Hz" in modes:
            plot_modes(folder, body, modes)
    if "stability" in analyses and os.path.exists(os.path.join(folder, "stability.csv")):
        plot_divergence(folder)
        plot_unstable(folder, analyses["stability"])
    convolution = analyses.get("modal_convolution", {})
    if "method_comparison" in convolution:
        plot_comparison(folder, convolution["method_comparison"])
    if convolution and os.path.exists(os.path.join(folder, "histories.h5")):
        plot_modal_convolution(folder, convolution)
    elif os.path.exists(os.path.join(folder, "histories.h5")):
        plot_transient(folder, analyses.get("transient", {}), results.get("title", ""))


if __name__ == "__main__":
    main()

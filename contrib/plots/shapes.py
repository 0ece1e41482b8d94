"""Deformed shapes from the .vtu files."""
import base64
import glob
import os
import re
import zlib
import xml.etree.ElementTree as ElementTree

import numpy as np
from matplotlib.collections import PolyCollection

from plots.common import save, plt


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


# faces of a cell by its first, linear corners, by VTK's number of the type; a triangle names its last corner twice
FACES = {
    10: ([0, 1, 2, 2], [0, 1, 3, 3], [1, 2, 3, 3], [0, 2, 3, 3]),  # tetrahedron
    12: ([0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]),  # hexahedron
    13: ([0, 1, 2, 2], [3, 4, 5, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]),  # prism
}
# cells of higher order and their linear likes
LIKE = {24: 10, 71: 10, 25: 12, 29: 12, 72: 12, 26: 13, 32: 13, 73: 13}


def surface_quads(points, cells):
    """Outer faces of solid cells (or the quadrilaterals themselves) as rows of four point numbers."""
    offsets, connectivity = cells["offsets"].astype(int), cells["connectivity"].astype(int)
    sizes = np.diff(np.concatenate([[0], offsets]))
    kinds = {LIKE.get(int(kind), int(kind)) for kind in np.unique(cells["types"])}
    if len(kinds) != 1 or kinds.isdisjoint(FACES):
        return connectivity.reshape(-1, sizes[0])[:, :4]
    corners = connectivity.reshape(-1, sizes[0])
    faces = np.concatenate([corners[:, f] for f in FACES[kinds.pop()]])
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


def has_surface(points):
    """Whether they are more than one point or points in a line."""
    apart = points - points.mean(axis=0)
    return np.linalg.matrix_rank(apart, tol=1e-9 * max(np.linalg.norm(apart), 1e-300)) > 1


def plot_shapes(folder, name, panels, columns):
    """Deformed surfaces coloured by their displacement over the largest of the panel: title, then points, quadrilaterals and
    displacement of the body in the middle and, as triples, of those beside it."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    panels = [panel for panel in panels if has_surface(panel[1])]
    if not panels:
        return
    columns = min(columns, len(panels))
    rows = (len(panels) + columns - 1) // columns
    plane = (np.ptp(panels[0][1], axis=0) == 0).any()
    figure = plt.figure(figsize=(4 * columns, (2.6 if plane else 4) * rows))
    for position, (title, points, quads, values, *others) in enumerate(panels):
        flat = np.ptp(points, axis=0) == 0
        if flat.any():
            plot_plane_shape(figure.add_subplot(rows, columns, position + 1), title, points[:, ~flat], quads, values[:, ~flat])
            continue
        axis = figure.add_subplot(rows, columns, position + 1, projection="3d")
        size = np.ptp(points, axis=0).max()
        bodies = [(points, quads, values), *others]
        largest = max(np.linalg.norm(displacement, axis=1).max() for _, _, displacement in bodies) or 1
        # one collection, whose faces are drawn from back to front: of several the later one would hide the others
        faces, colours = [], []
        middle = (points.max(axis=0) + points.min(axis=0)) / 2
        for body_points, body_quads, displacement in bodies:
            near = np.abs(body_points[body_quads].mean(axis=1) - middle).max(axis=1) < 0.75 * size
            shown = body_quads[near]
            # A wheel is looked at along its axle: y to the front.
            faces.append((body_points + displacement * (0.08 * size / largest))[shown][:, :, [1, 0, 2]])
            colours.append(plt.cm.turbo(np.linalg.norm(displacement, axis=1)[shown].mean(axis=1) / largest))
        axis.add_collection3d(Poly3DCollection(np.concatenate(faces), facecolors=np.concatenate(colours),
                                               edgecolors=np.concatenate(colours), linewidths=0.2))
        points = points[:, [1, 0, 2]]
        centre = (points.max(axis=0) + points.min(axis=0)) / 2
        for set_limit, c in zip((axis.set_xlim, axis.set_ylim, axis.set_zlim), centre):
            set_limit(c - size / 2, c + size / 2)
        axis.set_box_aspect((1, 1, 1), zoom=1.4)
        axis.view_init(elev=18, azim=-35)
        axis.set_axis_off()
        axis.set_title(title)
    figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(0, 1), plt.cm.turbo), ax=figure.axes, shrink=0.5, pad=0.02,
                    label="displacement over its largest")
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
    """Up to six unstable roots from unstable_<root>_<body>.pvd, when most moves: in the middle the body whose mode the root
    began as, or else the one that moves most."""
    cases = analysis.get("cases") or [analysis]
    panels = []
    for number, root in enumerate(cases[0].get("unstable", [])):
        frames = {}
        for index in glob.glob(os.path.join(folder, f"unstable_{number}_*.pvd")):
            files = [node.get("file") for node in ElementTree.parse(index).getroot().iter("DataSet")]
            body = re.sub(rf"^unstable_{number}_|\.pvd$", "", os.path.basename(index))
            # the other half of the period is the opposite
            frames[body] = [read_vtu(os.path.join(folder, file)) for file in files[:len(files) // 2]]
        if not frames:
            continue
        largest = {body: [np.linalg.norm(data["displacement_m"], axis=1).max() for _, _, data in moments]
                   for body, moments in frames.items()}
        moment = int(np.argmax(np.max(list(largest.values()), axis=0)))
        main = root["label"].split(":")[0]
        if main not in frames:
            main = max(largest, key=lambda body: largest[body][moment])
        shown = [main] + [body for body in frames if body != main]
        bodies = [(points, quads, data["displacement_m"]) for points, quads, data in (frames[body][moment] for body in shown)]
        panels.append((f"{root['label']}, {root['frequency_Hz']:.1f} Hz, {root['growth_1_s']:+.2f} 1/s", *bodies[0], *bodies[1:]))
    panels = panels[:6]
    if panels:
        plot_shapes(folder, "unstable_shapes", panels, 2 if len(panels) in (2, 4) else min(3, len(panels)))

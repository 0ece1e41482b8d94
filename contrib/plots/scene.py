"""The scene that a file describes: bodies from the side and from the front, the contact grid from above."""
import json
import os

import numpy as np
from matplotlib.collections import PolyCollection

from plots.common import LIMIT, STICK, UNSTABLE, save, plt
from plots.shapes import read_vtu

COLOURS = ["#7f9fbf", "#bfa27f"]


def outlines(body, above, extent):
    """Lines of a body without a mesh, in (x, z) and in (y, z) [m]; `extent` is the size of what is shown of an endless one."""
    kind, side = body["type"], 1 if above else -1
    if kind == "ring":
        angle = np.linspace(0, 2 * np.pi, 200)
        radius = body["radius_m"]
        return [np.c_[radius * np.sin(angle), radius * (1 - np.cos(angle))]], [[[0, 0], [0, 2 * radius]]]
    if kind in ("beam rail", "layer"):
        length, height = body["length_m"], body.get("height_m", 0)
        frame = np.array([[-length / 2, 0], [length / 2, 0], [length / 2, side * height], [-length / 2, side * height], [-length / 2, 0]])
        return [frame] + [np.array([[x, 0], [x, side * 0.02 * length]]) for x in body.get("supports_m", [])], \
            [[[0, 0], [0, side * max(height, 0.02 * length)]]]
    if kind == "bar":
        line = [[0, 0], [0, side * body["length_m"]]]
        return [line], [line]
    if kind in ("oscillator", "identified"):
        box = extent * np.array([[-1, 0], [1, 0], [1, side], [-1, side], [-1, 0]]) / 4
        return [box], [box]
    across = np.linspace(-extent, extent, 101)
    return [[np.c_[across, side * across**2 / (2 * radius)]] if radius else []
            for radius in (body.get("radius_x_m", 0), body.get("radius_y_m", 0))]


def plot_scene(folder):
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    contacts = scene.get("contacts", [])
    # the grid of the first is shown
    grid = contacts[0]["grid"] if contacts else None
    if grid and min(grid["n_x"], grid["n_y"]) == 1:
        grid = None
    curved_only = all(body["type"] in ("half-space", "rigid") for body in scene["bodies"])
    figure, axes = plt.subplots(1, 3 if grid else 2, figsize=(13 if grid else 9, 5))
    extent = max(grid["n_x"] * grid["spacing_x_m"], grid["n_y"] * grid["spacing_y_m"]) if grid else 1.
    for number, body in enumerate(scene["bodies"]):
        colour, above = COLOURS[number % 2], number == 0
        label = f"{body['name']} ({body['type']}"
        if "surface" in body:
            points, quads, _ = read_vtu(os.path.join(folder, body["surface"]))
            label += ", {:.3g} x {:.3g} x {:.3g} m".format(*np.ptp(points, axis=0))
            for axis, across, depth in ((axes[0], 0, 1), (axes[1], 1, 0)):
                order = np.argsort(points[quads][:, :, depth].mean(axis=1))
                order = order[::-1] if depth else order
                axis.add_collection(PolyCollection(points[quads[order]][:, :, [across, 2]], facecolors=colour, edgecolors="0.35",
                                                   linewidths=0.15))
        else:
            for axis, lines in zip(axes, outlines(body, above, extent)):
                if not lines:  # flat
                    axis.axhline(0, color=colour, lw=1.5)
                for line in lines:
                    axis.plot(*np.asarray(line).T, color=colour, lw=1.5)
        axes[0].plot([], [], color=colour, lw=6, label=label + ")")
    for axis, name in zip(axes, "xy"):
        places = np.array([contact["place_m"] for contact in contacts] or [[0, 0, 0]])
        axis.plot(places[:, "xy".index(name)], places[:, 2], "o", ms=4, color=UNSTABLE,
                  label=("contacts" if len(places) > 1 else "contact") if name == "x" else None)
        axis.autoscale()
        half = 0.75 * np.ptp(axis.get_ylim())
        width = np.ptp(axis.get_xlim())
        # the middle of a long rail, and room beside a thin bar
        if not curved_only and (name == "x" and width > 4 * half or width < 0.5 * half):
            axis.set_xlim(-half, half)
        axis.set_aspect("auto" if curved_only else "equal")
        axis.set_xlabel(f"{name} [m]" + (" (leading edge left)" if name == "x" else ""))
        axis.set_ylabel("z [m]")
        axis.set_title("from the side" if name == "x" else "from the front", fontsize=9)
        axis.grid(alpha=0.3)
    if grid:
        x = 1e3 * (grid["x_first_m"] + grid["spacing_x_m"] * np.arange(grid["n_x"]))
        y = 1e3 * (grid["y_first_m"] + grid["spacing_y_m"] * np.arange(grid["n_y"]))
        axes[2].plot(*[a.ravel() for a in np.meshgrid(x, y)], ".", ms=2, color=STICK)
        axes[2].axhline(0, color=LIMIT, lw=0.8)
        axes[2].axvline(0, color=LIMIT, lw=0.8)
        axes[2].set_aspect("equal")
        axes[2].set_xlabel("x [mm]")
        axes[2].set_ylabel("y [mm]")
        which = f" of {contacts[0]['name']}" if contacts[0]["name"] else ""
        axes[2].set_title(f"contact grid{which}, {grid['n_x']} x {grid['n_y']} points of {1e3 * grid['spacing_x_m']:g} mm x "
                          f"{1e3 * grid['spacing_y_m']:g} mm", fontsize=9)
    figure.legend(loc="lower center", ncols=4, frameon=False)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    save(figure, folder, "scene")

"""Contact patches and creep curves of quasi-static rolling."""
import os

import numpy as np
from matplotlib.colors import ListedColormap

from plots.common import case_title, friction_factor, OPEN, read_table, save, SLIP, STICK, plt


def on_grid(patch, values):
    x, y = np.unique(np.round(patch["x_m"], 12)), np.unique(np.round(patch["y_m"], 12))
    return 1e3 * x, 1e3 * y, np.asarray(values).reshape(len(y), len(x))


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


def plot_contact_table(axis, name):
    """Tractions along y = 0 of the program CONTACT from a table with x_mm, y_mm, px_MPa and py_MPa. It rolls towards +x: x and
    px are mirrored."""
    table = read_table(name)
    line = np.abs(table["y_mm"]) < 1e-9
    for values, marker, colour, label in ((-table["px_MPa"], "o", "#6a3d9a", "$r_x$"), (table["py_MPa"], "s", "#27ae60", "$r_y$")):
        axis.plot(-table["x_mm"][line], values[line], marker, ms=7, mfc="none", mec=colour, ls="none", label=label + ", CONTACT")


def plot_centre_line(folder, k, case, contact_table=None):
    patch = read_table(os.path.join(folder, f"contact_patch_{k}.csv"))
    line = np.abs(patch["y_m"] - patch["y_m"][np.argmin(np.abs(patch["y_m"]))]) < 1e-12
    if not (patch["pressure_Pa"][line] > 0).any():
        return
    x = 1e3 * patch["x_m"][line]
    figure, axis = plt.subplots(figsize=(6, 3.8))
    slip = np.hypot(patch["slip_x_m_s"], patch["slip_y_m_s"])[line]
    section = str(k).rpartition("_")[0] or "Contact"
    limit = friction_of(case) * friction_factor(folder, slip, section) * patch["pressure_Pa"][line] / 1e6
    axis.plot(x, limit, "k--", lw=1, label=r"$\mu\, p$")
    axis.plot(x, -limit, "k--", lw=1)
    if contact_table:
        plot_contact_table(axis, contact_table)
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


def friction_of(case):
    """Of a case; not a number where its contacts have different ones."""
    return float("nan") if case["friction"] is None else case["friction"]


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
        elif len(members) >= 3 and np.ptp([friction_of(c) for c in members]) > 0:
            panels.append((name, members, "friction"))
    if not panels:
        return
    figure, axes = plt.subplots(1, len(panels), figsize=(5 * len(panels), 3.8), squeeze=False)
    for axis, (name, members, quantity) in zip(axes[0], panels):
        label, factor = SWEEPS[quantity]
        groups = {}
        known = quantity != "friction" and all(case["friction"] is not None for case in members)
        for case in members:
            groups.setdefault(case["friction"] if known else 0, []).append(case)
        for friction, group in sorted(groups.items()):
            group.sort(key=lambda case: case[quantity])
            x = [factor * case[quantity] for case in group]
            force = [np.hypot(*case["tangential_force_N"]) / case["normal_force_N"] for case in group]
            line, = axis.plot(x, force, "o-", ms=3, label=f"$\\mu$ = {friction:g}" if known else "")
            if quantity == "spin_1_m":
                moment = [case["spin_moment_Nm"] / case["normal_force_N"] * 1e3 for case in group]
                axis.plot(x, moment, "s--", ms=3, color=line.get_color(), label="$M_z/N$ [mm]" + (f", $\\mu$ = {friction:g}" if known else ""))
        axis.set_xlabel(label)
        axis.set_ylabel("$|F_t| / N$")
        axis.grid(alpha=0.3)
        if axis.get_legend_handles_labels()[1]:
            axis.legend(fontsize=8)
    figure.tight_layout()
    save(figure, folder, "creep_curves")

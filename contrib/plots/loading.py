"""Loops and contact patches of quasi-static loading."""
import os

import numpy as np
from matplotlib.colors import ListedColormap

from plots.common import OPEN, read_table, save, SLIP, STICK, plt
from plots.contact import on_grid, status_legend


def plot_loading(folder, loading):
    steps = read_table(os.path.join(folder, "loading.csv"))
    plot_loops(folder, steps)
    # pressing alone has no traction to show
    driven = [k + 1 for k, step in enumerate(loading["steps"]) if step["ends_part"] and np.hypot(*step["tangential_force_N"]) > 0]
    for contact in [f"{name}_" for name in loading.get("contacts", {})] or [""]:
        numbers = [k for k in driven if os.path.exists(os.path.join(folder, f"loading_patch_{contact}{k}.csv"))]
        if numbers:
            plot_patches(folder, contact, numbers[-4:])


def plot_loops(folder, steps):
    """Driving force over displacement along x and y, and what friction has taken step by step."""
    axes_used = [d for d in "xy" if np.ptp(steps[f"displacement_{d}_m"]) > 0] or ["x"]
    pressed = np.ptp(steps["approach_m"]) > 1e-6 * np.max(np.abs(steps["approach_m"]))
    figure, axes = plt.subplots(1, len(axes_used) + 1 + pressed, figsize=(4 * (len(axes_used) + 1 + pressed), 3.4))
    panels = list(axes)
    if pressed:
        axis = panels.pop(0)
        axis.plot(1e6 * np.append(0, steps["approach_m"]), np.append(0, steps["normal_force_N"]), ".-", color=STICK)
        axis.set_xlabel("approach [um]")
        axis.set_ylabel("normal force [N]")
    for d in axes_used:
        axis = panels.pop(0)
        axis.plot(1e6 * np.append(0, steps[f"displacement_{d}_m"]), np.append(0, steps[f"driving_force_{d}_N"]), ".-", color=STICK)
        axis.set_xlabel(f"displacement {d} [um]")
        axis.set_ylabel(f"driving force {d} [N]")
    axis = panels.pop(0)
    axis.plot(np.append(0, steps["step"]), 1e6 * np.append(0, steps["dissipated_sum_J"]), ".-", color=SLIP)
    axis.set_xlabel("step")
    axis.set_ylabel("taken by friction [uJ]")
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.tight_layout()
    save(figure, folder, "loading")


def plot_patches(folder, contact, numbers):
    """Tangential traction and status at the ends of the last parts."""
    figure, axes = plt.subplots(2, len(numbers), figsize=(2.9 * len(numbers) + 0.8, 5.2), squeeze=False, sharex=True, sharey=True)
    for column, number in enumerate(numbers):
        patch = read_table(os.path.join(folder, f"loading_patch_{contact}{number}.csv"))
        closed = patch["status"] > 0
        traction = np.where(closed, np.hypot(patch["traction_x_Pa"], patch["traction_y_Pa"]) / 1e6, 0)
        x, y, values = on_grid(patch, traction)
        half_x, half_y = (x[1] - x[0]) / 2 if len(x) > 1 else 0.5, (y[1] - y[0]) / 2 if len(y) > 1 else 0.5
        extent = [x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y]
        image = axes[0, column].imshow(np.ma.masked_equal(values, 0), origin="lower", extent=extent, cmap="viridis", interpolation="nearest")
        figure.colorbar(image, ax=axes[0, column], shrink=0.8, label="traction [MPa]")
        axes[1, column].imshow(on_grid(patch, patch["status"])[2], origin="lower", extent=extent,
                               cmap=ListedColormap([OPEN, STICK, SLIP]), vmin=-0.5, vmax=2.5, interpolation="nearest")
        axes[0, column].set_title(f"step {number}")
        axes[1, column].set_xlabel("x [mm]")
    for axis in axes[:, 0]:
        axis.set_ylabel("y [mm]")
    axes[1, -1].legend(handles=status_legend(("open", "stick", "slip")), loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    figure.tight_layout()
    save(figure, folder, f"loading_patches_{contact}".rstrip("_"))

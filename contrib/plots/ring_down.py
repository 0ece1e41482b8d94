"""Frequency and damping over amplitude of a hub that was let go."""
import numpy as np

from plots.common import LINE, plt, save
from vibrocontact.ring_down import ring_down, turning_points


def panels():
    """A figure with two axes: frequency and damping over amplitude."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    for axis, label in zip(axes, ("frequency [Hz]", "damping ratio [%]")):
        axis.set_xlabel("amplitude [um]")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    return figure, axes


def draw(axes, motion, style="o", **look):
    """A ring-down (vibrocontact.ring_down.RingDown) into panels()."""
    axes[0].plot(1e6 * motion.amplitude_m, motion.frequency_Hz, style, ms=4, **look)
    axes[1].plot(1e6 * motion.amplitude_m, 100 * motion.damping_ratio, style, ms=4, **look)


def plot_ring_down(folder, history, title):
    """Of the hub, along x or y, whichever goes further; nothing without three half cycles."""
    column = max((f"hub_{d}" for d in "xy" if f"hub_{d}_displacement_m" in history), default=None,
                 key=lambda name: np.ptp(history[name + "_displacement_m"]))
    if column is None:
        return
    motion = ring_down(*turning_points(history["time_s"], history[column + "_displacement_m"], history[column + "_velocity_m_s"]))
    if len(motion.amplitude_m) < 3:
        return
    figure, axes = panels()
    draw(axes, motion, "o-", color=LINE, lw=0.8)
    figure.suptitle(f"{column.replace('_', ' along ')}, half cycle by half cycle\n{title}", fontsize=9)
    figure.tight_layout()
    save(figure, folder, "ring_down")

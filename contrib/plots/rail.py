"""The receptance of a periodic rail beside what poles make of it."""
import os

import numpy as np

from plots.common import read_table, save, plt, LINE, LIMIT


def plot_rail_fit(folder, body, table, fit):
    """Magnitude and loss under the contact, exact and by poles; below, the error of all six motions. Grey: where it has to be small."""
    columns = read_table(os.path.join(folder, table + ".csv"))
    figure, axes = plt.subplots(3, 1, figsize=(8, 8), sharex=True)
    for axis, motion in zip(axes, ("vertical", "lateral")):
        for name, style, label in ((motion, "-", "track"), ("fitted_" + motion, "--", "poles")):
            value = columns[name + "_real_m_N"] + 1j * columns[name + "_imaginary_m_N"]
            axis.loglog(columns["frequency_Hz"], np.abs(value), style, lw=1, color=LINE, label="modulus, " + label)
            axis.loglog(columns["frequency_Hz"], np.abs(value.imag), style, lw=1, color="C0", label="loss, " + label)
        axis.set_title(f"{body}, {motion}")
        axis.set_ylabel("receptance [m/N]")
        axis.legend(fontsize=7)
    axes[2].loglog(columns["frequency_Hz"], 100 * columns["error"], lw=1, color=LINE)
    axes[2].set_ylabel("error [%]")
    axes[2].set_xlabel("frequency [Hz]")
    for axis in axes:
        axis.grid(alpha=0.3, which="both")
        for band in fit.get("bands", []):
            axis.axvspan(band["from_Hz"], band["to_Hz"], color=LIMIT, alpha=0.4, lw=0)
    figure.tight_layout()
    save(figure, folder, table)


def plot_rails(folder, reductions):
    for body, one in reductions.items():
        fit = one.get("fit") if isinstance(one, dict) else None
        for name, part in (("receptance_fit_", fit), ("receptance_in_time_", fit and fit.get("in_time"))):
            if part and os.path.exists(os.path.join(folder, name + body + ".csv")):
                plot_rail_fit(folder, body, name + body, part)

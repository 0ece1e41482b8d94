"""Forces, contact status and signals of a transient."""
import os
import xml.etree.ElementTree as ElementTree

import numpy as np
import h5py
import matplotlib
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap

from plots.common import case_title, friction_factor, legend_above, LIMIT, LINE, OPEN, plot_line, read_entries, read_table, save, short, SLIP, STICK, plt
from plots.contact import status_legend
from plots.ring_down import plot_ring_down
from plots.shapes import read_vtu


def last_period(transient, history):
    """Begin and end of the last period of the dominant frequency, as far as the run is long enough."""
    frequencies = transient.get("dominant_frequencies_Hz", [])
    end = history["time_s"][-1]
    if not frequencies or (end - history["time_s"][0]) * frequencies[0] < 2:
        return None
    return end - 1 / frequencies[0], end


def force_panels(history, friction, largest_factor=1):
    """What is not zero, a panel each: axis label and lines (values, style)."""
    normal = history["normal_force_N"] / 1e3
    forces = {c: history[f"tangential_force_{c}_N"] / 1e3 for c in "xy"}
    component = max("xy", key=lambda c: np.ptp(forces[c]) + np.abs(forces[c]).max())
    force = forces[component]
    panels = []
    if np.abs(force).max() > 1e-9 * np.abs(normal).max():
        lines = [(force, {"color": LINE, "lw": 0.9, "label": f"$F_{component}$ on body 1"})]
        if friction:
            sign = -1 if force.mean() < 0 else 1
            lines.insert(0, (sign * friction * normal, {"color": LIMIT, "lw": 1.5, "label": r"$\mu N$"}))
            if largest_factor != 1:  # friction depends on the slip speed
                lines[0][1]["label"] = r"$\mu N$ at high slip speed"
                lines.insert(0, (sign * largest_factor * friction * normal, {"color": LIMIT, "lw": 0.8, "label": r"$\mu N$ at rest"}))
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
    panels = force_panels(history, transient.get("friction"), float(friction_factor(folder, 0.)))
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


def spectrum(time, values):
    """Frequencies [Hz] and amplitudes of the second half of a signal, of a sine its own amplitude (Hann window)."""
    values = np.asarray(values)[len(values) // 2:]
    step = (time[-1] - time[0]) / (len(time) - 1)
    window = np.hanning(len(values))
    amplitude = 2 * np.abs(np.fft.rfft((values - values.mean()) * window)) / window.sum()
    return np.fft.rfftfreq(len(values), step), amplitude


def name_of_peak(frequency, known, fundamental):
    """The root or mode within 1 % of a frequency, or the multiple of the fundamental that it is."""
    near = [(abs(f - frequency), label) for f, label in known if abs(f - frequency) < 0.01 * frequency]
    if near:
        return short(min(near)[1])
    multiple = frequency / fundamental
    return f"{round(multiple)} x {fundamental:.0f} Hz" if round(multiple) > 1 and abs(multiple - round(multiple)) < 0.02 else ""


def plot_spectrum(folder, name, time, values, known, title):
    """Amplitudes over frequency with the largest peaks named by roots, modes and harmonics."""
    if len(values) < 512:
        return
    frequency, amplitude = spectrum(time, values)
    shown = (frequency > 0) & (frequency < 8000)
    frequency, amplitude = frequency[shown], amplitude[shown]
    if len(amplitude) < 3 or not amplitude.max() > 0:
        return
    inner = amplitude[1:-1]
    peaks = 1 + np.flatnonzero((inner >= amplitude[:-2]) & (inner > amplitude[2:]) & (inner > 1e-3 * amplitude.max()))
    chosen = []
    for peak in peaks[np.argsort(-amplitude[peaks])]:
        if all(abs(frequency[peak] - frequency[other]) > 0.02 * frequency[peak] for other in chosen):
            chosen.append(peak)
    figure, axis = plt.subplots(figsize=(8, 4))
    axis.semilogy(frequency, np.maximum(amplitude, 1e-6 * amplitude.max()), color=LINE, lw=0.8)
    for peak in chosen[:8]:
        words = name_of_peak(frequency[peak], known, frequency[chosen[0]])
        axis.annotate(f"{frequency[peak]:.1f} Hz\n{words}".strip(), (frequency[peak], amplitude[peak]), textcoords="offset points",
                      xytext=(3, 3), fontsize=7)
    axis.set_ylim(top=6 * amplitude.max())
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel("amplitude [m/s]")
    axis.set_title(f"{name.replace('_', ' ')}, second half of the run\n{title}", fontsize=9)
    axis.grid(alpha=0.3)
    save(figure, folder, f"spectrum_{name}")


def plot_growth(folder, modes, title):
    """Amplitudes of the modes over time, logarithmic; dashed: as the root of the linearised contact would let them grow."""
    columns = read_table(os.path.join(folder, "mode_amplitudes.csv"))
    time = columns["time_s"]
    amplitudes = [columns[mode["column"]] for mode in modes]
    highest = max((values.max() for values in amplitudes), default=0)
    if len(time) < 2 or not highest > 0:
        return
    figure, axis = plt.subplots(figsize=(8, 4.5))
    for mode, values in zip(modes, amplitudes):
        fitted = mode.get("growth_1_s")
        words = f"{short(mode['label'])}, {mode['frequency_Hz']:.1f} Hz: " \
            + (f"{fitted:+.4g} 1/s" if fitted is not None else "no exponential") + f" (root {mode['root_growth_1_s']:+.4g})"
        line, = axis.semilogy(time, np.where(values > 0, values, np.nan), lw=1, label=words)
        begin = int(np.argmax(values > 0))
        expected = values[begin] * np.exp(np.minimum(mode["root_growth_1_s"] * (time - time[begin]), 300))
        shown = expected <= 3 * highest
        axis.semilogy(time[shown], expected[shown], "--", lw=0.8, color=line.get_color())
    axis.set_ylim(1e-8 * highest, 3 * highest)
    axis.set_xlabel("time [s]")
    axis.set_ylabel("velocity amplitude in the contact [m/s]")
    axis.set_title(title, fontsize=9)
    axis.grid(alpha=0.3)
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=2, frameon=False, fontsize=8)
    save(figure, folder, "mode_growth")


def known_frequencies(analyses):
    """Frequencies with names: unstable roots, then modes of the bodies."""
    known = [(root["frequency_Hz"], root["label"]) for root in analyses.get("stability", {}).get("unstable", [])]
    for body, modes in analyses.get("modes", {}).items():
        if isinstance(modes, dict):
            known += [(f, f"{body}:{label}") for f, label in zip(modes.get("frequencies_Hz", []), modes.get("labels", []))]
    return known


def plot_transient(folder, transient, title, known=()):
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
    if transient.get("modes") and os.path.exists(os.path.join(folder, "mode_amplitudes.csv")):
        plot_growth(folder, transient["modes"], title)
    if read_entries(folder).get("Transient/Release") == "true":
        plot_ring_down(folder, history, title)
    name = os.path.join(folder, "signals.h5")
    if os.path.exists(name):
        with h5py.File(name) as file:
            time = np.asarray(file["time_s"])
            for column in file:
                if column != "time_s":
                    plot_signal(folder, column[:-len("_m_s")], time, np.asarray(file[column]), title)
                    plot_spectrum(folder, column[:-len("_m_s")], time, np.asarray(file[column]), known, title)

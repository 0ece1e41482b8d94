"""Limit cycles: a period of each, its harmonics, and what its Floquet multipliers say of small disturbances."""
import os

import numpy as np

from matplotlib.colors import ListedColormap

from plots.common import edges, LIMIT, LINE, OPEN, plt, read_table, save, short, STICK, swept_axis, UNSTABLE

# followed entries with a unit, as a sweep names their columns
FOLLOWED_COLUMNS = {"Rolling/Hub displacement": "hub_displacement_m", "Rolling/Normal force": "normal_force_N", "Rolling/Speed": "speed_m_s",
                    "Rolling/Spin": "spin_1_m", "Rolling/Sliding velocity x": "sliding_velocity_x_m_s",
                    "Rolling/Sliding velocity y": "sliding_velocity_y_m_s"}


def plot_limit_cycles(folder, limit_cycle):
    found = [(cycle["number"], cycle) for cycle in limit_cycle if os.path.exists(os.path.join(folder, f"limit_cycle_{cycle['number']}.csv"))]
    if not found:
        return
    figure, axes = plt.subplots(len(found), 3, figsize=(11, 2.5 * len(found) + 0.4), squeeze=False)
    for (k, cycle), row in zip(found, axes):
        plot_period(row[0], read_table(os.path.join(folder, f"limit_cycle_{k}.csv")), cycle)
        plot_harmonics(row[1], read_table(os.path.join(folder, f"limit_cycle_{k}_harmonics.csv")), cycle["main_signal"])
        plot_disturbances(row[2], cycle)
    axes[-1][0].set_xlabel("time [ms]")
    axes[-1][1].set_xlabel("frequency [Hz]")
    axes[-1][2].set_xlabel("frequency of a disturbance [Hz]")
    figure.tight_layout()
    save(figure, folder, "limit_cycles")


def plot_harmonic_balance(folder, limit_cycle):
    """How far harmonic balance is from the steps over the number of harmonics, and what it costs."""
    balanced = [(cycle, sorted((one for one in cycle["harmonic_balance"] if one["converged"]), key=lambda one: one["harmonics"])) for cycle in limit_cycle if cycle.get("harmonic_balance")]
    balanced = [(cycle, rows) for cycle, rows in balanced if rows]
    if not balanced:
        return
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4))
    for cycle, rows in balanced:
        harmonics = [one["harmonics"] for one in rows]
        for axis, name in zip(axes, ("frequency_difference", "first_harmonic_difference")):
            axis.loglog(harmonics, [abs(one.get(name, float("nan"))) for one in rows], "o-", ms=4, lw=1, label=f"{cycle['frequency_Hz']:.1f} Hz")
        axes[2].loglog(harmonics, [one["seconds"] for one in rows], "o-", ms=4, lw=1)
    for axis, label in zip(axes, ("frequency, difference from the steps", "first harmonic of the signal, difference", "time [s]")):
        axis.set_xlabel("harmonics")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8, frameon=False)
    figure.tight_layout()
    save(figure, folder, "limit_cycle_harmonic_balance")


def label_of(name):
    """"wheel_rim_axial_velocity_m_s" as "wheel rim axial [m/s]"."""
    if name.endswith("_velocity_m_s"):
        return name.replace("_velocity_m_s", "").replace("_", " ") + " [m/s]"
    return name[:-len("_N")].replace("_", " ") + " [N]"


def plot_period(axis, table, cycle):
    name = cycle["main_signal"]
    axis.plot(1e3 * table["time_s"], table[name], color=LINE)
    axis.set_ylabel(label_of(name))
    axis.set_title(f"{cycle['frequency_Hz']:.2f} Hz", loc="left")
    points = axis.twinx()
    points.fill_between(1e3 * table["time_s"], table["contact_points"], color=OPEN, step="pre", zorder=0)
    points.fill_between(1e3 * table["time_s"], table["stick_points"], color=STICK, alpha=0.5, step="pre", zorder=1)
    points.set_ylabel("points (blue: stick)")
    axis.set_zorder(points.get_zorder() + 1)
    axis.patch.set_visible(False)


def plot_harmonics(axis, table, name):
    audible = table["harmonic"] > 0
    axis.stem(table["frequency_Hz"][audible], table[name][audible], linefmt=LINE, markerfmt=".", basefmt=" ")
    axis.set_yscale("log")
    axis.set_ylabel(label_of(name))
    axis.grid(alpha=0.3)


def plot_disturbances(axis, cycle):
    multipliers = cycle.get("multipliers", [])
    growth = np.array([one["growth_1_s"] for one in multipliers])
    frequency = np.array([one["frequency_Hz"] for one in multipliers])
    axis.axhline(0, color=LIMIT, lw=1)
    axis.plot(frequency[growth < 0], growth[growth < 0], "o", color=STICK, ms=4)
    axis.plot(frequency[growth >= 0], growth[growth >= 0], "o", color=UNSTABLE, ms=4)
    axis.set_ylabel("growth [1/s]")
    axis.set_title(cycle.get("stability", {}).get("verdict", ""), loc="left")
    axis.grid(alpha=0.3)


def plot_branches(folder, limit_cycle):
    """Amplitude and frequency of cycles that were followed over an entry, with onset, first stick and stability."""
    followed = [cycle for cycle in limit_cycle if cycle.get("branch")]
    if not followed:
        return
    figure, (loud, pitch) = plt.subplots(1, 2, figsize=(10, 3.8))
    for cycle in followed:
        branch = cycle["branch"]
        points = branch["points"]
        value = np.array([point["value"] for point in points])
        amplitude = np.array([amplitude_of(point, cycle["main_signal"]) for point in points])
        line, = loud.plot(value, amplitude, "-", lw=1, label=cycle["root"]["label"])
        color = line.get_color()
        for one, marker, face in (("stable", "o", color), ("unstable", "o", "white"), ("neutral", ".", color)):
            chosen = [k for k, point in enumerate(points) if stability_of(point) == one]
            loud.plot(value[chosen], amplitude[chosen], marker, ms=4, mfc=face, color=color)
        pitch.plot(value, [point["frequency_Hz"] for point in points], ".-", lw=1, ms=4, color=color)
        for end in (branch.get("begin", {}), branch.get("end", {})):
            if "onset" in end:
                loud.plot(end["onset"], 0, "^", color=color, clip_on=False)
        if "first_stick" in branch:
            loud.axvline(branch["first_stick"]["value"], color=color, lw=0.5, ls=":")
    loud.set_ylabel(label_of(followed[0]["main_signal"]))
    loud.set_title("\u25cf stable   \u25cb unstable   . neutral or not judged   \u25b2 onset   : first stick", loc="left", fontsize=8)
    loud.set_ylim(0, 1.05 * loud.get_ylim()[1])
    pitch.set_ylabel("frequency [Hz]")
    for axis in (loud, pitch):
        axis.set_xlabel(followed[0]["branch"]["entry"].rpartition("/")[2])
        axis.grid(alpha=0.3)
    loud.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    save(figure, folder, "limit_cycle_branches")


def stability_of(cycle):
    """stable, unstable, or neutral, which also stands for cycles that were not judged."""
    verdict = cycle.get("stability", {}).get("verdict", "neutral")
    return verdict if verdict in ("stable", "neutral") else "unstable"


def loudest_of(cycle):
    """The loudest velocity of a cycle, or its normal force in scenes without probes."""
    velocities = [one for one in cycle["signals"] if "level_dB" in one]
    return max(velocities, key=lambda one: one["level_dB"]) if velocities else cycle["signals"][0]


def amplitude_of(cycle, name):
    return next(one for one in cycle["signals"] if one["name"] == name)["amplitude"]


def plot_amplitudes(folder, sweep):
    """Amplitude of the loudest signal of each cycle over the swept entry, by the root that it began from; onset where it ends."""
    column = sweep["swept_columns"][0]
    if len(sweep["swept_columns"]) > 1:
        return
    curves = {}
    for case in sweep["cases"]:
        for cycle in case.get("limit_cycle", []):
            velocities = [one for one in cycle.get("signals", []) if "level_dB" in one]
            if velocities:
                loudest = max(velocities, key=lambda one: one["level_dB"])
                curves.setdefault(cycle["root"]["label"], []).append(
                    (case["swept"][column], loudest["amplitude"], cycle["frequency_Hz"], stability_of(cycle)))
    if not curves:
        return
    figure, (loud, pitch) = plt.subplots(1, 2, figsize=(10, 3.8))
    for label, points in sorted(curves.items()):
        value, amplitude, frequency, stable = zip(*points)
        line, = loud.plot(value, amplitude, "-", lw=1, label=label)
        for one, marker, face in (("stable", "o", line.get_color()), ("unstable", "o", "white"), ("neutral", ".", line.get_color())):
            chosen = [k for k, found in enumerate(stable) if found == one]
            loud.plot([value[k] for k in chosen], [amplitude[k] for k in chosen], marker, ms=4, mfc=face, color=line.get_color())
        pitch.plot(value, frequency, ".-", color=line.get_color())
    loud.set_ylabel("velocity of the loudest probe [m/s]")
    loud.set_title("o stable   \u25cb unstable   . not judged", loc="left", fontsize=8)
    loud.set_ylim(0, None)
    pitch.set_ylabel("frequency [Hz]")
    for axis in (loud, pitch):
        axis.set_xlabel(sweep["swept_entries"][0].rpartition("/")[2])
        axis.grid(alpha=0.3)
    loud.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    save(figure, folder, "limit_cycle_amplitudes")


def plot_map(folder, sweep):
    """Velocity and power of the loudest cycle over two entries, and from which root it began: both swept, or one swept and one followed."""
    columns, entries = list(sweep["swept_columns"]), list(sweep["swept_entries"])
    followed = next((cycle["branch"]["entry"] for case in sweep["cases"] for cycle in case.get("limit_cycle", []) if cycle.get("branch")), None)
    if len(columns) == 1 and followed:
        loudest = followed_loudest(sweep["cases"], columns[0])
        columns.append(FOLLOWED_COLUMNS.get(followed, followed.rpartition("/")[2]))
        entries.append(followed)
    elif len(columns) == 2 and not followed:
        loudest = swept_loudest(sweep["cases"], columns)
    else:
        return
    x, y = (np.unique([place[k] for place in loudest]) if all(isinstance(place[k], (int, float)) for place in loudest) else None for k in (0, 1))
    if x is None or y is None or not any(cycle for cycle in loudest.values()):
        return
    labels = sorted({cycle[2] for cycle in loudest.values() if cycle})
    fields = np.full((3, len(y), len(x)), np.nan)
    for (at, over), cycle in loudest.items():
        if cycle:
            fields[:, np.searchsorted(y, over), np.searchsorted(x, at)] = [cycle[0], cycle[1], labels.index(cycle[2])]
    # a body without probes is heard by its contact force
    names = [label_of(loudest_of(cycle)["name"]) for case in sweep["cases"] for cycle in case.get("limit_cycle", [])]
    amplitude = "velocity [m/s]" if all("[m/s]" in name for name in names) else names[0] if len(set(names)) == 1 else "amplitude, velocities and forces"
    panels = [(amplitude, "viridis"), ("power into body 1 [W]", "magma")] + ([("which motion is loudest", None)] if len(labels) > 1 else [])
    figure, axes = plt.subplots(1, len(panels), figsize=(4.6 * len(panels), 3.6), squeeze=False)
    titles, factors = zip(*(swept_axis(entry, column) for entry, column in zip(entries, columns)))
    for axis, (title, colours), field in zip(axes[0], panels, fields):
        if colours:
            image = axis.pcolormesh(edges(factors[0] * x), edges(factors[1] * y), field, cmap=colours, vmin=min(0, np.nanmin(field)))
            figure.colorbar(image, ax=axis)
        else:
            image = axis.pcolormesh(edges(factors[0] * x), edges(factors[1] * y), field, cmap=ListedColormap([plt.get_cmap("tab20")(k % 20) for k in range(len(labels))]),
                                    vmin=-0.5, vmax=len(labels) - 0.5)
            figure.colorbar(image, ax=axis, ticks=range(len(labels))).ax.set_yticklabels([short(label) for label in labels], fontsize=7)
        axis.set_title(title, loc="left")
        axis.set_xlabel(titles[0])
        axis.set_ylabel(titles[1])
    failed = np.array([(factors[0] * case["swept"][columns[0]], factors[1] * (case["swept"][columns[1]] if len(sweep["swept_columns"]) > 1 else y[0]))
                       for case in sweep["cases"] if case["status"] != "converged"])
    if len(failed):
        axes[0][0].plot(failed[:, 0], failed[:, 1], "x", color=UNSTABLE, ms=4, mew=1)
    figure.suptitle("white: no cycle was found or followed   stability is not shown" + ("   x: not all of it converged" if len(failed) else ""), x=0.01, ha="left", fontsize=8)
    figure.tight_layout()
    save(figure, folder, "limit_cycle_map")


def swept_loudest(cases, columns):
    """Of each case, by its two values: velocity, power and root of its loudest cycle; None: there is none."""
    return {tuple(case["swept"][column] for column in columns):
            max(((loudest_of(cycle)["amplitude"], cycle["power_into_body_1_W"], cycle["root"]["label"]) for cycle in case.get("limit_cycle", [])), default=None)
            for case in cases}


def followed_loudest(cases, column):
    """The same by the swept value and 60 values of the followed entry, between neighbours of a branch linearly."""
    branches = [(case["swept"][column], cycle) for case in cases for cycle in case.get("limit_cycle", []) if cycle.get("branch")]
    values = [point["value"] for _, cycle in branches for point in cycle["branch"]["points"]]
    grid = np.linspace(min(values), max(values), 60)
    loudest = {(case["swept"][column], over): None for case in cases for over in grid}
    for at, cycle in branches:
        points = cycle["branch"]["points"]
        rows = [(point["value"], amplitude_of(point, cycle["main_signal"]), point["power_into_body_1_W"]) for point in points]
        for before, after in zip(rows, rows[1:]):
            low, high = sorted((before, after))
            for over in grid[(grid >= low[0]) & (grid <= high[0])]:
                share = (over - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 1
                amplitude, power = ((1 - share) * low[k] + share * high[k] for k in (1, 2))
                loudest[at, over] = max(loudest[at, over] or (0,), (amplitude, power, cycle["root"]["label"]))
    return loudest

"""Writes the report: one page, a picture and a table per study."""
import csv
import html
import os
import platform
import subprocess
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

import program

STYLE = """body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}
img{max-width:100%}table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #ccc;padding:.15em .6em;text-align:left}
.caption{color:#555}.bad{color:#b00020}"""


def environment(bench):
    """Machine, versions and date, as pairs."""
    def first_line(command):
        try:
            return subprocess.run(command, text=True, stdout=subprocess.PIPE, env=program.ENVIRONMENT).stdout.splitlines()[0]
        except (OSError, IndexError):
            return "unknown"
    model = platform.machine()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
    with open("/proc/meminfo", encoding="utf-8") as file:
        memory = int(file.readline().split()[1]) / 1024 ** 2
    version = subprocess.run([bench.path, "--version"], text=True, stdout=subprocess.PIPE, env=program.ENVIRONMENT).stdout
    return [("date", time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())),
            ("machine", f"{model}, {os.cpu_count()} cores, {memory:.0f} GB"),
            ("load at the begin", f"{os.getloadavg()[0]:.1f}: with other work beside it, take costs as ratios"
             if os.getloadavg()[0] > 1.5 else f"{os.getloadavg()[0]:.1f}"),
            ("system", f"{platform.system()} {platform.release()}, {first_line(['mpirun', '--version'])}"),
            ("program", ", ".join(line.strip() for line in version.splitlines() if line.strip())),
            ("runs", f"{bench.repetitions} of each point unless its study says otherwise; medians, bars from least to most"
             + (", quick part" if bench.quick else ""))]


def draw_quantity(study, quantity, axis):
    """One diagram of a picture."""
    def errors(points):
        return [study.error_of(point, quantity) for point in points]
    curves = list(dict.fromkeys(point.curve for point in study.points))
    colours = plt.get_cmap("tab10" if len(curves) <= 10 else "tab20").colors
    for k, curve in enumerate(curves):
        points = sorted((point for point in study.points if point.curve == curve), key=lambda point: point.median)
        bars = [[point.median - min(point.seconds) for point in points], [max(point.seconds) - point.median for point in points]]
        axis.errorbar([point.median for point in points], errors(points), xerr=bars,
                      marker="osD^vP*X"[k // len(colours) % 8 if len(curves) > 20 else k % 8], ms=5, lw=0.8,
                      color=colours[k % len(colours)], label=curve, capsize=2)
    front, defaults = study.front([quantity]), [point for point in study.points if point.default]
    axis.plot([point.median for point in front], errors(front), color="0.75", lw=5, zorder=0, solid_capstyle="round",
              drawstyle="steps-post", label="front")
    axis.plot([point.median for point in defaults], errors(defaults), "o", ms=14, mew=2, mfc="none", mec="#c0392b", ls="none",
              label="default")
    axis.set(xscale="log", yscale="log", ylabel=study.further[quantity] if quantity else study.error)
    axis.grid(alpha=0.3)


def draw(study, name):
    """Error over cost of all points, spread as bars, the front as a line, defaults ringed; one below the other for each quantity, with
    the front of that quantity alone. Whole or not at all."""
    quantities = study.quantities()
    figure, axes = plt.subplots(len(quantities), figsize=(6.4, 4.4 if len(quantities) == 1 else 3.6 * len(quantities)), squeeze=False, sharex=True)
    for axis, quantity in zip(axes[:, 0], quantities):
        draw_quantity(study, quantity, axis)
    axes[0, 0].set_title(study.title)
    axes[-1, 0].set_xlabel(study.cost)
    axes[0, 0].legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    figure.savefig(name + ".part", format="png", dpi=100, bbox_inches="tight")
    plt.close(figure)
    os.replace(name + ".part", name)


def write_table(study, name):
    """CSV behind the picture."""
    front = study.front()
    with open(name + ".part", "w", newline="", encoding="utf-8") as file:
        file.write(f"# {study.title}\n# truth: {study.truth}\n# cost: {study.cost}\n# error: {study.error}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["label", "curve", "cost_median_s", "cost_least_s", "cost_most_s", "runs", "error", *study.further,
                         "default", "on_front"])
        for point in study.points:
            writer.writerow([point.label, point.curve, point.median, min(point.seconds), max(point.seconds), len(point.seconds),
                             point.error, *(point.further[quantity] for quantity in study.further), int(point.default), int(point in front)])
    os.replace(name + ".part", name)


def table(head, rows):
    cells = "".join(f"<th>{html.escape(cell)}</th>" for cell in head)
    return f"<table><tr>{cells}</tr>" + "".join(
        "<tr>" + "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row) + "</tr>" for row in rows) + "</table>"


def default_rows(studies):
    """Each default: study, label, cost, errors, whether on the front, and what beats it, by one quantity alone too, or why it stays."""
    def those(better, study, point, quantities):
        def errors(other):
            return ", ".join(f"{study.error_of(other, quantity):.2g}" for quantity in quantities)
        return "; ".join(f"{other.label} ({other.median / point.median:.2g} of the cost, error {errors(other)})" for other in better[:3])
    rows = []
    for study in studies:
        for point in study.points:
            if not point.default:
                continue
            quantities = study.quantities()
            better = study.better_than(point)
            verdict = "NOT on the front: " + those(better, study, point, quantities) if better else "on the front"
            if better and study.reason:
                verdict += ". Stays because " + study.reason
            for quantity in quantities if study.further and not better else ():
                alone = study.better_than(point, [quantity])
                if alone:
                    verdict += f"; by {quantity or 'the first error'} alone better: " + those(alone, study, point, [quantity])
            rows.append([study.name, point.label, f"{point.median:.3g}",
                         ", ".join(f"{study.error_of(point, quantity):.2g}" for quantity in quantities), verdict])
    return rows


def write(studies, failures, worse, said, head, folder, sections=""):
    """The page. failures: sentences by study that has no picture; worse, said: sentences of what became worse than the
    baseline and on what was compared, both empty without one; sections: further html of others."""
    text = [f"<!DOCTYPE html><meta charset='utf-8'><title>Error against cost</title><style>{STYLE}</style>",
            "<h1>Error against cost</h1>", table(["", ""], head),
            "<p>Each picture: error against an independent truth over cost in seconds. Grey: the front, the points that no other "
            "one beats in both; of several errors, in all of them. Red ring: what the program does by default.</p>"]
    for name, sentence in failures.items():
        text.append(f"<p class='bad'>{html.escape(name)} has no picture: {html.escape(sentence)}</p>")
    text += ["<h2>Defaults</h2>", table(["study", "default", "cost [s]", "error", "verdict"], default_rows(studies))]
    if worse or said:
        text.append("<h2>Against the baseline</h2>" + "".join(f"<p class='bad'>{html.escape(one)}</p>" for one in worse)
                    + "".join(f"<p>{html.escape(one)}</p>" for one in said))
    for study in studies:
        text += [f"<h2 id='{study.name}'>{html.escape(study.title)}</h2>", f"<img src='{study.name}.png' alt='{study.name}'>",
                 f"<p class='caption'>Truth: {html.escape(study.truth)} <a href='{study.name}.csv'>Table</a>.</p>"]
    name = os.path.join(folder, "report.html")
    with open(name + ".part", "w", encoding="utf-8") as file:
        file.write("\n".join(text) + sections + "\n")
    os.replace(name + ".part", name)

#!/usr/bin/env python3
"""Reduced models of section Stability against unreduced finite elements; see README.md.

usage: run.py [PROGRAM] [--only layer|segment|brake]
"""
import argparse
import csv
import json
import os
import subprocess
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--only", default="")
options = arguments.parse_args()

EXAMPLES = os.path.join(top, "parameter_files", "examples")
# undamped, as more than 1,500 dofs have to be; one friction in place of the sweep, and roots of all frequencies
BRAKE = {"Stability/Upper frequency": 0, "Stability/Sweep/Entry": "", "Stability/Sweep/Range": "", "Stability/Number of roots": 60}
BRAKE.update({body + "/Material/Loss factor": 0 for body in ("pad_above", "disc", "pad_below")})
BRAKE_AT_0 = dict(BRAKE, **{contact + "/Friction coefficient": 0 for contact in ("upper", "lower")})
PADS = ["pad_above", "disc", "pad_below"]

# name, file, bodies, numbers of modes of each body or of all, roots that are compared: the unstable ones, the lowest, or those
# below a frequency; entries
CASES = [("layer", os.path.join(EXAMPLES, "sliding_layer.prm"), ["layer"], [10, 20, 40, 80, 160], "unstable", {}),
         ("segment", os.path.join(here, "wheel_segment.prm"), ["segment"], [10, 20, 40, 80], "lowest", {}),
         ("brake", os.path.join(EXAMPLES, "disc_brake.prm"), PADS, [20, 40, [40, 60, 40], 60, 100], 8000, BRAKE),
         ("brake without friction", os.path.join(EXAMPLES, "disc_brake.prm"), PADS, [20, 40, [40, 60, 40], 60, 100], 8000, BRAKE_AT_0)]
MODELS = [("paper (a)", "reduced", "paper"), ("consistent (d)", "reduced", "consistent"),
          ("attachment inertia (b)", "attachment inertia", "consistent")]


def counts_of(bodies, modes):
    return modes if isinstance(modes, list) else [modes] * len(bodies)


def run(file, bodies, model, linearisation, modes, given):
    """Roots (frequency, growth) of a model, seconds of its eigenvalues and of everything."""
    with tempfile.TemporaryDirectory() as folder:
        entries = {"Analyses": "stability", "Stability/Model": model,
                   "Output/Cache directory": "", "Output/Figures": "false", "Output/Fields": "false"}
        entries.update({body + "/Modes/Count": n for body, n in zip(bodies, counts_of(bodies, modes))})
        entries.update(given)
        if model != "finite elements":
            entries.pop("Stability/Number of roots", None)
        # in the plane strain of the layer both linearisations are one
        if bodies != ["layer"]:
            entries["Stability/Linearisation"] = linearisation
        command = [options.program, file, "--quiet", "--output", folder]
        for entry, value in entries.items():
            command += ["--set", "%s=%s" % (entry, value)]
        subprocess.run(command, check=True, cwd=here if os.path.dirname(file) == here else top)
        results = json.load(open(os.path.join(folder, "results.json")))
        lines = [line for line in open(os.path.join(folder, "stability.csv")) if not line.startswith("#")]
        roots = [(float(r["frequency_Hz"]), float(r["growth_1_s"])) for r in csv.DictReader(lines) if float(r["frequency_Hz"]) > 0]
        return roots, results["analyses"]["stability"]["cases"][0]["seconds"], results["wall_s"]


table = open(os.path.join(here, "reduced_stability.csv"), "w")


def row(*values):
    print(",".join(values), flush=True)
    table.write(",".join(values) + "\n")
    table.flush()


table.write("# Roots of reduced models against those of the unreduced finite elements; nearest root in the complex plane\n")
table.write("# error_frequency: relative; error_growth: of the growth over 2 pi frequency; largest of the compared roots; seconds: shared cores\n")
row("scene", "model", "modes", "roots", "error_frequency", "error_growth", "seconds_eigenvalues", "seconds_in_all")
for name, file, bodies, counts, which, entries in CASES:
    if options.only and not name.startswith(options.only):
        continue
    exact, seconds, wall = run(file, bodies, "finite elements", "consistent", 40, entries)
    if which == "unstable":
        compared = [r for r in exact if r[1] > 1e-6 * r[0]][:3]
    else:
        compared = exact[:6] if which == "lowest" else [r for r in exact if r[0] < which]
    row(name, "finite elements (c)", "", " ".join("%.1f Hz %+.1f 1/s;" % r for r in compared), "", "", "%.2g" % seconds, "%.2g" % wall)
    for title, model, linearisation in MODELS:
        for n in counts:
            roots, seconds, wall = run(file, bodies, model, linearisation, n, entries)
            frequency = growth = 0
            for f, g in compared:
                near = min(roots, key=lambda r: abs(r[0] - f) + abs(r[1] - g) / 6.283185307179586)
                frequency = max(frequency, abs(near[0] / f - 1))
                growth = max(growth, abs(near[1] - g) / (6.283185307179586 * f))
            row(name, title, " + ".join(map(str, counts_of(bodies, n))) if isinstance(n, list) else str(n), str(len(compared)), "%.1e" % frequency, "%.1e" % growth, "%.2g" % seconds, "%.2g" % wall)

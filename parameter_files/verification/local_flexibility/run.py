#!/usr/bin/env python3
"""Does the local flexibility under the contact matter to squeal? See README.md.

usage: run.py [PROGRAM] [--cache DIRECTORY] [--only CASE] [--step SECONDS] [--end SECONDS]
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:  # a Python of one's own may lack what the system's has
    if os.environ.get("VIBROCONTACT_SYSTEM_PYTHON"):
        raise
    os.environ["VIBROCONTACT_SYSTEM_PYTHON"] = "yes"
    os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--cache", default="")
arguments.add_argument("--only", default="")
arguments.add_argument("--step", default="5e-6")
arguments.add_argument("--end", default="0.4")
options = arguments.parse_args()

HALF_SPACE = {"Contact/Local flexibility": "half-space"}
UNCOUPLED = {"Contact/Normal-tangential coupling": "false"}
CASES = [("finite elements", {}), ("half-space", HALF_SPACE), ("uncoupled", UNCOUPLED),
         ("half-space uncoupled", {**HALF_SPACE, **UNCOUPLED}), ("consistent", {"Contact/Quadrature": "consistent"})]
MODES = ("axial(0,2)", "axial(0,3)", "axial(0,4)", "axial(0,6)")


def run(folder, analyses, entries):
    """The analyses in results.json of the shipped file with some entries changed."""
    entries = {"Analyses": analyses, "Output/Figures": "false", "Output/Fields": "false", **entries}
    if options.cache:
        entries["Output/Cache directory"] = os.path.abspath(options.cache)
    command = [options.program, os.path.join(top, "parameter_files", "examples", "curve_squeal_solid.prm"), "--quiet", "--output", folder]
    for entry, value in entries.items():
        command += ["--set", "%s=%s" % (entry, value)]
    subprocess.run(command, check=True)
    return json.load(open(os.path.join(folder, "results.json")))["analyses"]


def roots(folder):
    """Of each mode its root that grows most: frequency, growth."""
    lines = [line for line in open(os.path.join(folder, "stability.csv")) if not line.startswith("#")]
    table = list(csv.DictReader(lines))
    found = []
    for mode in MODES:
        own = [(float(r["growth_1_s"]), float(r["frequency_Hz"])) for r in table if r["label"].startswith("wheel:" + mode.replace(",", ";"))]
        growth, frequency = max(own)
        found += [frequency, growth]
    return found


def sticking(folder, period):
    """Over the last 20 periods: most sticking points, share of the time with any."""
    with h5py.File(os.path.join(folder, "histories.h5")) as file:
        time, stick = file["time_s"][:], file["stick_points"][:]
    last = stick[time > time[-1] - 20 * period]
    return int(last.max()), (last > 0).mean()


table = open(os.path.join(here, "local_flexibility.csv"), "w")


def row(*values):
    text = ",".join(v if isinstance(v, str) else "%.7g" % v for v in values)
    print(text, flush=True)
    table.write(text + "\n")
    table.flush()


table.write("# curve_squeal_solid.prm with another local flexibility, coupling or quadrature; normal_force_at_hub: at 0.35 mm; all others at the\n")
table.write("# hub displacement that gives the normal force of the first row. growth in time: axial(0,3) from 0.0005 m/s; limit cycle: rim, axially\n")
row("case", "normal_force_at_hub_N", "hub_m", "normal_force_N", "contact_points", "max_pressure_Pa",
    *[name % mode for mode in MODES for name in ("%s_Hz", "%s_1_s")], "n_unstable", "growth_in_time_1_s", "amplitude_m_s", "cycle_Hz", "drift",
    "most_stick_points", "stick_share_of_time")
force = None
for name, changes in CASES:
    if options.only and name not in ("finite elements", options.only):
        continue
    with tempfile.TemporaryDirectory() as folder:
        at_hub = run(folder, "quasi-static rolling", changes)["quasi_static_rolling"]["cases"][0]
        force = force or at_hub["normal_force_N"]
        if options.only and name != options.only:
            continue
        loaded = run(folder, "quasi-static rolling", {**changes, "Rolling/Normal force": "%.17g" % force})["quasi_static_rolling"]["cases"][0]
        hub = 0.35e-3 + loaded["approach_m"] - at_hub["approach_m"]
        changes = {**changes, "Rolling/Hub displacement": "%.17g" % hub, "Transient/Time step": options.step}
        stability = run(folder, "stability", changes)["stability"]
        found = roots(folder)
        grown = run(folder, "transient", {**changes, "Transient/End time": "0.08", "Transient/Perturbation velocity": "0.0005",
                                          "Transient/Signals/Growth begin": "0.01"})
        growth = min(grown["transient"]["signals"][0]["growth"], key=lambda g: abs(g["frequency_Hz"] - found[2]))["growth_1_s"]
        cycle = run(folder, "transient", {**changes, "Transient/End time": options.end, "Transient/Perturbation velocity": "0.04"})
        cycle = cycle["transient"]["signals"][0]["cycle"]
        row(name, at_hub["normal_force_N"], hub, stability["cases"][0]["normal_force_N"], loaded["contact_points"],
            loaded["max_pressure_Pa"], *found, len(stability["unstable"]), growth, cycle["amplitude"], cycle["frequency_Hz"], cycle["drift"],
            *sticking(folder, 1 / cycle["frequency_Hz"]))

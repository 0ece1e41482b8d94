#!/usr/bin/env python3
"""Errors of the wheel's frequencies against those of its section; see README.md.

usage: run.py [PROGRAM] [--upper FREQUENCY] [--only "MESH;..."]
"""
import argparse
import json
import os
import subprocess
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--upper", type=float, default=8000)
arguments.add_argument("--only", default="")
options = arguments.parse_args()

# label, frequency of the section [Hz] (Fourier finite elements, converged to 0.02 %)
SECTION = [("axial(0,1)", 136.3), ("axial(0,0)", 197.6), ("axial(0,2)", 334.1), ("torsion(0,0)", 510.7), ("axial(0,3)", 918.0),
           ("axial(0,4)", 1670.1), ("radial(1,2)", 1799.0), ("radial(1,2)", 1916.0), ("axial(0,5)", 2515.8),
           ("radial(1,5)", 3278.0), ("axial(0,6)", 3413.0), ("axial(0,7)", 4336.9), ("axial(0,10)", 7170.0)]
# name, coarse division [m], contact division [m], degree, section refinements
MESHES = [("coarse", 0.24, 0.24, 2, 0), ("middle", 0.12, 0.12, 2, 0), ("default", 0.055, 0.008, 2, 0),
          ("cubic 10 cells around", 0.16, 0.16, 3, 0), ("cubic 19 cells around", 0.08, 0.08, 3, 0)]

table = open(os.path.join(here, "wheel_frequencies.csv"), "w")
table.write("# Frequencies of the wheel by finite elements against the section's, bore held, no contact patch; errors in %\n")
table.write("mesh,n_dofs,seconds,n_modes," + ",".join(name.replace(",", " ") + " " + str(f) + " Hz" for name, f in SECTION) + "\n")
for name, coarse, contact, degree, refinements in MESHES:
    if options.only and name not in options.only.split(";"):
        continue
    with tempfile.TemporaryDirectory() as folder:
        entries = {"wheel/Modes/Upper frequency": options.upper, "wheel/Wheel/Coarse division": coarse,
                   "wheel/Wheel/Contact division": contact, "wheel/Wheel/Element degree": degree,
                   "wheel/Wheel/Section refinements": refinements, "Output/Cache directory": "", "Output/Figures": "false",
                   "Output/Fields": "false"}
        command = [options.program, os.path.join(here, "wheel.prm"), "--quiet", "--output", folder]
        for entry, value in entries.items():
            command += ["--set", "%s=%s" % (entry, value)]
        subprocess.run(command, check=True)
        modes = json.load(open(os.path.join(folder, "results.json")))["analyses"]["modes"]["wheel"]
    errors = []
    for label, frequency in SECTION:
        number, nearest = min(enumerate(modes["frequencies_Hz"]), key=lambda mode: abs(mode[1] - frequency))
        error = 100 * (nearest / frequency - 1)
        errors.append("%+.3f" % error if abs(error) < 5 else "")
        if errors[-1] and modes["labels"][number].split("#")[0] != label:
            print("%s: %.1f Hz is labelled %s, not %s" % (name, nearest, modes["labels"][number], label))
    row = [name, str(modes["n_dofs"]), "%.0f" % modes["seconds"], str(len(modes["frequencies_Hz"]))] + errors
    print(" ".join(row), flush=True)
    table.write(",".join(row) + "\n")
    table.flush()

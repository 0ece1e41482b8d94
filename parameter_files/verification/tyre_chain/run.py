#!/usr/bin/env python3
"""Ways from a tyre to its contact forces on a road, against the exact modes; see README.md. Usage: run.py [PROGRAM]"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
program = sys.argv[1] if len(sys.argv) > 1 else os.path.join(top, "build", "vibrocontact")
examples = os.path.join(top, "parameter_files", "examples")
ring, data = (os.path.join(examples, name) for name in ("tyre_three_points.prm", "tyre_from_data.prm"))


def run(file, *settings):
    """Forces of the three points and what results.json says."""
    command = [program, file, "--quiet", "--output", folder, "--set", "Output/Figures=false"]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, check=True)
    with open(os.path.join(folder, "results.json")) as text:
        results = json.load(text)["analyses"]
    forces = []
    for point in range(3):
        with open(os.path.join(folder, f"contact_point_{point}.csv")) as table:
            forces.append([float(row["force_N"]) for row in
                           csv.DictReader(line for line in table if not line.startswith("#"))])
    return forces, results


def fit(method, pairs, zero=False):
    # the tread makes every fit usable, so that none is repaired; fits as they are, not the passive models near them
    return (data, "Identification/Repair for contact=false", "Identification/Enforce passivity=false", f"Identification/Method={method}", f"Identification/Numbers of pole pairs={pairs}",
            f"Identification/Impose zero initial value={str(zero).lower()}")


def elements(model, divisions, upper):
    return (ring, f"tyre/Ring/Model={model} elements", f"tyre/Ring/Divisions={divisions}",
            f"tyre/Modes/Upper frequency={upper}")


transform = (data, "Analyses=modal convolution", "tyre/Identified/Inverse transform=true")
ways = [("exact modes, 60 orders and residual", (ring,)),
        ("exact modes, 25 orders and residual", (ring, "tyre/Ring/Highest order=25"))]
ways += [(f"vector fitting, {n} pairs", fit("vector fitting", n)) for n in (20, 25, 30)]
ways += [(f"vector fitting with g(0+) = 0, {n} pairs", fit("vector fitting", n, True)) for n in (20, 25, 30)]
ways += [(f"LSCE, {n} pairs", fit("lsce", n)) for n in (25, 30)]
ways += [(f"LSCE with real amplitudes, {n} pairs", fit("lsce with real amplitudes", n)) for n in (25, 30)]
ways += [("inverse FFT, direct convolution", transform + ("Modal convolution/Method=direct convolution",)),
         ("inverse FFT, block convolution", transform + ("Modal convolution/Method=block convolution",))]
ways += [("104 beam elements, modes to 1.5 kHz", elements("beam", 104, 1500)),
         ("104 beam elements, modes to 10 kHz", elements("beam", 104, 10000)),
         ("208 beam elements, modes to 10 kHz", elements("beam", 208, 10000)),
         ("76 cubic solid elements, modes to 1.5 kHz", elements("solid", 76, 1500)),
         ("76 cubic solid elements, modes to 10 kHz", elements("solid", 76, 10000))]

lines = []
with tempfile.TemporaryDirectory() as folder:
    exact, results = run(ring, "tyre/Ring/Highest order=400")
    impulse = results["modal_convolution"]["impulse_Ns"]
    largest = max(map(max, exact))
    print(f"exact modes, |n| <= 400: largest force {largest:.2f} N, impulse at B {impulse[1]:.5f} N s")
    for name, way in ways:
        forces, results = run(*way)
        rms = [math.sqrt(sum((a - b)**2 for a, b in zip(found, right)) / len(right)) / largest
               for found, right in zip(forces, exact)]
        convolution = results["modal_convolution"]
        error = results["identification"][0]["error_E"] if "identification" in results else ""
        lines.append((name, error, max(rms), convolution["impulse_Ns"][1] / impulse[1] - 1,
                      1e9 * convolution["seconds_per_step"]))
        print("%-42s E %-9s rms force error %.2e, impulse at B %+.2e, %.0f ns per step"
              % (name, "%.2e" % error if error else "-", *lines[-1][2:]))

with open(os.path.join(here, "tyre_chain.csv"), "w") as table:
    table.write("# Three contact points with tread, 20 us, 0.2 s; against exact modes |n| <= 400. E: of the fit, Eq. 9, worst entry; force error: rms over "
                "the largest force, worst point; impulse: of the middle point, relative\n")
    writer = csv.writer(table, lineterminator="\n")
    writer.writerow(("way", "error_E", "force_error", "impulse_error", "ns_per_step"))
    for line in lines:
        writer.writerow("%.3g" % value if isinstance(value, float) else value for value in line)

#!/usr/bin/env python3
"""Errors of both creep schemes against Carter's closed form; see README.md. Usage: run.py [PROGRAM]"""
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
example = os.path.join(top, "parameter_files", "examples", "carter.prm")
a, a_stick, mu, radius, modulus = 5e-3, 3e-3, 0.3, 0.46, 205e9 / (2 * (1 - 0.3**2))
p0 = modulus * a / (2 * radius)


def traction(x):
    full = math.sqrt(max(0, 1 - (x / a)**2))
    stick = math.sqrt(max(0, 1 - ((x + a - a_stick) / a_stick)**2)) * a_stick / a
    return -mu * p0 * (full - stick)


def mean_traction(x, h, n=200):
    return sum(traction(x + h * ((k + 0.5) / n - 0.5)) for k in range(n)) / n


rows, curves = [], {}
with tempfile.TemporaryDirectory() as folder:
    for scheme in ("first-order upwind", "second-order upwind"):
        previous = None
        for cells in (20, 40, 80, 160):
            h = 2 * a / cells
            subprocess.run([program, example, "--quiet", "--output", folder, "--set", "Output/Figures=false",
                            "--set", "Output/Fields=false", "--set", "Rolling/Grids=one",
                            "--set", f"Contact/Creep scheme={scheme}",
                            "--set", f"Contact/Grid spacing={h}"], check=True)
            with open(os.path.join(folder, "results.json")) as file:
                case = json.load(file)["analyses"]["quasi_static_rolling"]["cases"][0]
            with open(os.path.join(folder, "contact_patch_0.csv")) as file:
                patch = list(csv.DictReader(line for line in file if not line.startswith("#")))
            patch = [p for p in patch if p["status"] != "0"]
            force = case["tangential_force_N"][0] / (mu * case["normal_force_N"])
            error = abs(force + 0.64) / 0.64
            rms = math.sqrt(sum((float(p["traction_x_Pa"]) - mean_traction(float(p["x_m"]), h))**2
                                for p in patch) / len(patch)) / (mu * p0)
            orders = tuple(math.log2(old / new) for old, new in zip(previous, (error, rms))) if previous else ("", "")
            previous = (error, rms)
            rows.append((scheme, cells, force, error, orders[0], rms, orders[1]))
            print("%-20s %4d cells: force %.6f, error %.3e %s, rms traction %.3e %s"
                  % (scheme, cells, force, error, "(order %.2f)" % orders[0] if orders[0] else "", rms,
                     "(order %.2f)" % orders[1] if orders[1] else ""))
            curves[scheme, cells] = [(1e3 * float(p["x_m"]), 1e-6 * float(p["traction_x_Pa"])) for p in patch]

with open(os.path.join(here, "carter.csv"), "w") as table:
    table.write("# Carter's problem, closed form F / (mu P) = -0.64; errors relative, rms of traction over mu p0\n")
    table.write("scheme,cells_across_contact,force_over_mu_p,force_error,force_order,traction_rms,traction_order\n")
    for row in rows:
        table.write(",".join("%.7g" % v if isinstance(v, float) else str(v) for v in row) + "\n")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit(0)
for scheme in ("first-order upwind", "second-order upwind"):
    plt.plot(*zip(*curves[scheme, 20]), "o", label=scheme + ", 20 cells")
xs = [a * (k / 500 - 1) for k in range(1001)]
plt.plot([1e3 * x for x in xs], [1e-6 * traction(x) for x in xs], "k-", label="closed form")
plt.xlabel("x, mm (rolling towards -x)")
plt.ylabel("traction on the upper body, MPa")
plt.legend()
plt.savefig(os.path.join(here, "carter.png"), dpi=110, bbox_inches="tight")

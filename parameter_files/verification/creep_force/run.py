#!/usr/bin/env python3
"""Creep force over spacing, alignment and scheme; see README.md. Usage: run.py [PROGRAM]"""
import json
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
program = sys.argv[1] if len(sys.argv) > 1 else os.path.join(top, "build", "vibrocontact")
example = os.path.join(top, "parameter_files", "examples", "half_space_rolling.prm")
limit = -0.712

rows = []
with tempfile.TemporaryDirectory() as folder:
    for scheme in ("first-order upwind", "second-order upwind"):
        for spacing in (1.25, 1, 0.8, 0.5, 0.25):
            for x in (0, 0.5):
                for y in (0, 0.5):
                    subprocess.run(
                        [program, example, "--quiet", "--output", folder, "--set", "Output/Figures=false",
                         "--set", "Output/Fields=false", "--set", "Rolling/Grids=one", "--set", f"Contact/Creep scheme={scheme}",
                         "--set", f"Contact/Grid spacing={spacing}e-3", "--set", f"Contact/Offset x={x}",
                         "--set", f"Contact/Offset y={y}"], check=True)
                    with open(os.path.join(folder, "results.json")) as file:
                        case = json.load(file)["analyses"]["quasi_static_rolling"]["cases"][0]
                    force = case["tangential_force_N"][1] / (case["friction"] * case["normal_force_N"])
                    rows.append((scheme, spacing, x, y, force, force / limit - 1, case["contact_points"]))
                    print("%-20s %5.2f mm, shift %.1f %.1f: %.5f (%+.2f %% of the limit)"
                          % (scheme, spacing, x, y, force, 100 * (force / limit - 1)))

with open(os.path.join(here, "creep_force.csv"), "w") as table:
    table.write("# Fy / (mu N) at 66 kN, mu 0.3, lateral creepage 0.2 %; limit -0.712 +- 0.002\n")
    table.write("scheme,spacing_mm,shift_x_cells,shift_y_cells,fy_over_mu_n,relative_to_limit,contact_points\n")
    for row in rows:
        table.write("%s,%g,%g,%g,%.7f,%.5f,%d\n" % row)

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit(0)
for scheme, marker in (("first-order upwind", "o"), ("second-order upwind", "s")):
    plt.plot([r[1] for r in rows if r[0] == scheme], [r[4] for r in rows if r[0] == scheme], marker, label=scheme)
plt.axhspan(limit - 0.002, limit + 0.002, color="0.85", label="limit")
plt.xlabel("grid spacing, mm")
plt.ylabel("$F_y / (\\mu N)$")
plt.legend()
plt.savefig(os.path.join(here, "creep_force.png"), dpi=110, bbox_inches="tight")

#!/usr/bin/env python3
"""Parts from STEP: errors against closed forms, and a part of 300,000 unknowns from STEP to stability; see README.md. Usage: run.py [PROGRAM] [--quick]

--quick: the closed forms alone, and the exit code says whether they are met."""
import json
import math
import os
import subprocess
import sys
import tempfile
import time

here = os.path.dirname(os.path.abspath(__file__))
quick = "--quick" in sys.argv
given = [word for word in sys.argv[1:] if word != "--quick"]
program = os.path.abspath(given[0]) if given else os.path.join(here, "..", "..", "..", "build", "vibrocontact")
sys.path.insert(0, os.path.join(here, "..", "cell_types"))
import closed_forms  # noqa: E402
environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
E, NU, RHO = 2.1e11, 0.3, 7850.
SHEAR_SPEED = math.sqrt(E / (2 * (1 + NU)) / RHO)
RADIUS, BORE, RIM = 0.1, 0.05, 0.15
SCRIPTS = {"sphere": "Sphere(1) = {0, 0, 0, 100};",
           "plate": "Cylinder(1) = {0, 0, 0, 0, 0, 100, 150}; Cylinder(2) = {0, 0, 0, 0, 0, 100, 50};"
                    "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }"}
# entries, modes: exact frequency and how many have it; springs of 1e5 N/m^3 hold the sphere, which is free
CASES = {"sphere": ({"CAD/Faces": "skin: number 1", "Foundation groups": "skin", "Foundation stiffness": "1e5, 1e5, 1e5"},
                    [(closed_forms.sphere_torsion() * SHEAR_SPEED / RADIUS / (2 * math.pi), 5),
                     (closed_forms.sphere_spheroidal(NU) * SHEAR_SPEED / RADIUS / (2 * math.pi), 5)]),
         "plate": ({"CAD/Faces": "bore: cylinder z 0.05 at 0 0", "Held groups": "bore"},
                   [(closed_forms.plate_torsion(BORE, RIM) * SHEAR_SPEED / (2 * math.pi), 1)])}


def run(parameters, entries, folder, ranks=1):
    """Results, seconds by the clock and of the processors."""
    command = (["mpirun", "-n", str(ranks)] if ranks > 1 else []) + [program, parameters, "--output", os.path.join(folder, "results")]
    for entry, value in entries.items():
        command += ["--set", f"{entry}={value}"]
    before, start = os.times(), time.time()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment, cwd=folder)
    after = os.times()
    with open(os.path.join(folder, "results", "results.json"), encoding="utf-8") as file:
        results = json.load(file)
    return results, time.time() - start, (after.children_user + after.children_system) - (before.children_user + before.children_system)


failed = False
for name, (entries, modes) in CASES.items():
    curve = []
    for size in (0.03, 0.02):
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "part.geo")
            with open(script, "w", encoding="utf-8") as file:
                file.write('SetFactory("OpenCASCADE");' + SCRIPTS[name] + 'Save "part.step";\n')
            subprocess.run(["gmsh", "-0", script], check=True, stdout=subprocess.DEVNULL, cwd=folder)
            own = {"body/Mesh/File": os.path.join(folder, "part.step"), "body/Mesh/Unit": 1, "body/Mesh/Held groups": "",
                   "body/Mesh/CAD/Cell size": size}
            own.update({"body/Mesh/" + entry: value for entry, value in entries.items()})
            results, seconds, _ = run(os.path.join(here, "..", "cell_types", "cell_types.prm"), own, folder)
        body = results["analyses"]["modes"]["body"]
        found = [f for f in body["frequencies_Hz"] if f > 0.1 * modes[0][0]]
        errors, first = [], 0
        for exact, n in modes:
            errors += [abs(f / exact - 1) for f in found[first:first + n]]
            first += n
        print(f"{name}, cells of {size} m: {body['n_dofs']} unknowns, largest error of a frequency {max(errors):.2e}, {seconds:.1f} s", flush=True)
        curve.append((body["n_dofs"], max(errors)))
    # lengths of cells go as the third root of their number
    order = 3 * math.log(curve[0][1] / curve[1][1]) / math.log(curve[1][0] / curve[0][0])
    print(f"{name}: order {order:.1f}", flush=True)
    failed = failed or max(errors) > 1e-3 or order < 3

if not quick:
    with tempfile.TemporaryDirectory() as folder:
        parameters = os.path.join(here, "step_part.prm")
        for what in ("from STEP", "again, by the cache"):
            results, seconds, processor = run(parameters, {}, folder, 2)
            print(f"step_part.prm {what}: {seconds:.0f} s by the clock on 2 ranks, {processor:.0f} s of processor time", flush=True)
sys.exit(failed)

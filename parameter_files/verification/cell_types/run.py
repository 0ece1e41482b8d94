#!/usr/bin/env python3
"""Errors of frequencies over their cost for every type and degree of cell, against closed forms; see README.md. Usage: run.py [PROGRAM] [--quick]

--quick: two coarse meshes of degree 2 of each, and the exit code says whether orders and errors are as expected."""
import json
import math
import os
import subprocess
import sys
import tempfile

import closed_forms
import meshes

here = os.path.dirname(os.path.abspath(__file__))
quick = "--quick" in sys.argv
given = [word for word in sys.argv[1:] if word != "--quick"]
program = os.path.abspath(given[0]) if given else os.path.join(here, "..", "..", "..", "build", "vibrocontact")
E, NU, RHO = 2.1e11, 0.3, 7850.
SHEAR_SPEED = math.sqrt(E / (2 * (1 + NU)) / RHO)

RADIUS = 0.1
BORE, RIM, THICKNESS = 0.05, 0.15, 0.1
LENGTH, WIDTH, HEIGHT = 0.4, 0.03, 0.02


def sphere(name, cells, order, n):
    if cells == "hexahedra":
        meshes.sphere_of_hexahedra(name, RADIUS, n, order)
    else:
        meshes.sphere_of_tetrahedra(name, RADIUS, RADIUS / n, order)


def plate(name, cells, order, n):
    def place(s, t, u):
        r, angle = BORE + (RIM - BORE) * s, 2 * math.pi * t
        return r * math.cos(angle), r * math.sin(angle), THICKNESS * u
    meshes.write_deck(name, cells, order, (2 * n, 8 * n, n), [place], {"held": lambda x, y, z: abs(math.hypot(x, y) / BORE - 1) < 1e-9})


def cantilever(name, cells, order, n):
    meshes.write_deck(name, cells, order, (10 * n, n, n), [lambda s, t, u: (LENGTH * s, WIDTH * t, HEIGHT * u)],
                      {"held": lambda x, y, z: x < 1e-9})


# springs under all of the surface, which hold a body that is free: 3e-8 of its frequencies
FREE = {"body/Mesh/Held groups": "", "body/Mesh/Foundation groups": "skin", "body/Mesh/Foundation stiffness": "1e5, 1e5, 1e5"}
HELD = {"body/Mesh/Held groups": "held"}
# name, mesh, entries, frequencies of modes: exact [Hz], how many modes have it
BODIES = [
    ("sphere", sphere, FREE, [(closed_forms.sphere_torsion() * SHEAR_SPEED / RADIUS / (2 * math.pi), 5),
                              (closed_forms.sphere_spheroidal(NU) * SHEAR_SPEED / RADIUS / (2 * math.pi), 5)]),
    ("annular plate", plate, HELD, [(closed_forms.plate_torsion(BORE, RIM) * SHEAR_SPEED / (2 * math.pi), 1)]),
    ("cantilever", cantilever, {**HELD, "body/Material/Poisson ratio": "0"}, [(closed_forms.cantilever(E, 0, RHO, LENGTH, HEIGHT), 1)])]
SIZES = {"hexahedra": {1: (2, 4, 8), 2: (1, 2, 4)}, "prisms": {1: (2, 4, 8), 2: (1, 2, 4)}, "tetrahedra": {1: (2, 4, 8), 2: (1, 2, 4)}}


def frequencies(body, mesh, entries, cells, order, n):
    """Of a body's mesh [Hz], unknowns, processor seconds of the run."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "mesh.msh" if body == "sphere" and cells == "tetrahedra" else "mesh.inp")
        mesh(name, cells, order, n)
        command = [program, os.path.join(here, "cell_types.prm"), "--quiet", "--output", os.path.join(folder, "results")]
        for entry, value in {"body/Mesh/File": name, "body/Mesh/Unit": 1, "body/Mesh/Element degree": order, **entries}.items():
            command += ["--set", f"{entry}={value}"]
        before = os.times()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1"))
        after = os.times()
        with open(os.path.join(folder, "results", "results.json"), encoding="utf-8") as file:
            modes = json.load(file)["analyses"]["modes"]["body"]
    return modes["frequencies_Hz"], modes["n_dofs"], after.children_user + after.children_system - before.children_user - before.children_system


def error_of(found, exact):
    """Largest relative error of the modes that have closed forms: the lowest ones, without six rigid motions on springs."""
    elastic, errors, first = [f for f in found if f > 0.1 * exact[0][0]], [], 0
    for frequency, n in exact:
        errors += [f / frequency - 1 for f in elastic[first:first + n]]
        first += n
    return max(errors, key=abs)


rows, curves = [], {}
for body, mesh, entries, exact in BODIES:
    for cells in SIZES:
        if body == "sphere" and cells == "prisms":
            continue
        for order, sizes in SIZES[cells].items():
            if quick and order == 1:
                continue
            for n in sizes[:2] if quick else sizes:
                found, n_dofs, seconds = frequencies(body, mesh, entries, cells, order, n)
                error = error_of(found, exact)
                curve = curves.setdefault((body, cells, order), [])
                curve.append((seconds, error, n_dofs))
                rate = math.log2(curve[-2][1] / error) if len(curve) > 1 and curve[-2][1] / error > 0 else None
                rows.append((body, cells, order, n, n_dofs, seconds, error, rate))
                print(f"{body}, {cells}, degree {order}: {n_dofs} unknowns, {seconds:.2f} s, error {error:.2e}"
                      + (f", order {rate:.2f}" if rate is not None else ""), flush=True)

if quick:
    # near order 4; that of the sphere's irregular tetrahedra and of the first halving is lower
    for (body, cells, order), curve in curves.items():
        (_, first, _), (_, last, _) = curve
        if not 0 < last < first or math.log2(first / last) < 2.7 or last > 0.03:
            sys.exit(f"FAILED: {body}, {cells}, degree {order}: errors {first:.2e}, {last:.2e}")
    sys.exit(0)

with open(os.path.join(here, "cell_types.csv"), "w", encoding="utf-8") as table:
    table.write("# Largest relative error of frequencies against closed forms; seconds: processor time of the whole run\n")
    table.write("body,cells,degree,n,unknowns,seconds,error,order\n")
    for row in rows:
        table.write(",".join("" if v is None else "%.4g" % v if isinstance(v, float) else str(v) for v in row) + "\n")

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit(0)
figure, axes = plt.subplots(1, len(BODIES), figsize=(12, 4.2), sharey=True)
for axis, (body, *_) in zip(axes, BODIES):
    for (name, cells, order), curve in curves.items():
        if name == body:
            colour = {"hexahedra": "tab:blue", "prisms": "tab:green", "tetrahedra": "tab:red"}[cells]
            axis.loglog([c[0] for c in curve], [abs(c[1]) for c in curve], "o-" if order == 2 else "s--", color=colour,
                        label=f"{cells}, degree {order}")
    axis.set_title(body)
    axis.set_xticks([0.3, 0.5, 1, 2, 5], ["0.3", "0.5", "1", "2", "5"])
    axis.set_xticks([], minor=True)
    axis.set_xlabel("processor time of the whole run, s")
    axis.grid(True, which="both", alpha=0.3)
axes[0].set_ylabel("relative error of the frequency")
figure.legend(*axes[-1].get_legend_handles_labels(), fontsize=8, ncol=6, loc="lower center", bbox_to_anchor=(0.5, -0.08))
figure.savefig(os.path.join(here, "cell_types.png"), dpi=110, bbox_inches="tight")

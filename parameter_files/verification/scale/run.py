#!/usr/bin/env python3
"""Time and memory of the stages of a reduction over the number of unknowns, with exponents; see README.md.

usage: run.py [PROGRAM] [--divisions 8 12 16 20] [--ranks 1 2] [--solver automatic] [--output TABLE.csv]
       run.py --million: 34 cells along an edge (985,527 unknowns), on one rank with two threads of BLAS
"""
import argparse
import csv
import json
import os
import subprocess
import tempfile
import time

import numpy

here = os.path.dirname(os.path.abspath(__file__))
stages = ["mesh and assembly", "factorisation", "count of modes", "modes", "contact compliance"]
environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1",
                   OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def measure(program, divisions, ranks, solver, threads):
    """Unknowns, seconds of each stage and in all, peak memory [MB] of all ranks, of a cube with so many cells along an edge."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        command += [program, os.path.join(here, "cube.prm"), "--quiet", "--output", folder]
        entries = {"Output/Cache directory": "", "Output/Figures": "false", "Output/Fields": "false"}
        entries.update({f"cube/Block/Divisions {axis}": divisions for axis in "xyz"})
        entries["cube/Solver/Method"] = solver
        for entry, value in entries.items():
            command += ["--set", f"{entry}={value}"]
        start = time.time()
        subprocess.run(command, check=True, env=dict(environment, OPENBLAS_NUM_THREADS=str(threads)))
        total = time.time() - start
        results = json.load(open(os.path.join(folder, "results.json")))
    reduction = results["reductions"]["cube"]
    memory = sum(rank["peak_memory_MB"] for rank in reduction["ranks"])
    seconds = [reduction["stages_s"].get(stage, 0) for stage in stages]
    return results["analyses"]["modes"]["cube"]["n_dofs"], seconds + [total], memory


def main():
    """Measures all sizes, prints and writes the table."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", nargs="?", default=os.path.join(here, "..", "..", "..", "build", "vibrocontact"))
    arguments.add_argument("--divisions", nargs="+", type=int, default=[8, 12, 16, 20])
    arguments.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    arguments.add_argument("--solver", default="automatic", choices=["automatic", "direct", "iterative"])
    arguments.add_argument("--threads", type=int, default=1, help="of BLAS, on each rank")
    arguments.add_argument("--million", action="store_true", help="985,527 unknowns, one rank with two threads")
    arguments.add_argument("--output", default=os.path.join(here, "scale.csv"))
    options = arguments.parse_args()
    if options.million:
        options.divisions, options.ranks, options.threads = [34], [1], 2
    print(f"load of the machine {os.getloadavg()[0]:.2f}")
    with open(options.output, "w", newline="") as file:
        file.write("# Cube: wall time of each stage [s], peak memory of all ranks [MB]; exponent: slope of the logarithm over that of the unknowns\n")
        writer = csv.writer(file)
        writer.writerow(["ranks", "n_dofs"] + [f"{stage} [s]" for stage in stages + ["whole run"]] + ["memory [MB]"])
        for ranks in options.ranks:
            rows = []
            for divisions in options.divisions:
                n_dofs, seconds, memory = measure(options.program, divisions, ranks, options.solver, options.threads)
                rows.append([n_dofs] + seconds + [memory])
                writer.writerow([ranks, n_dofs] + [f"{value:.4g}" for value in seconds + [memory]])
                file.flush()
                print(ranks, n_dofs, *(f"{value:.4g}" for value in seconds + [memory]), flush=True)
            if len(rows) > 1:
                table = numpy.log(numpy.maximum(numpy.array(rows), 1e-3))
                slopes = [numpy.polyfit(table[:, 0], column, 1)[0] for column in table[:, 1:].T]
                writer.writerow([ranks, "exponent"] + [f"{slope:.2f}" for slope in slopes])
                print(ranks, "exponent", *(f"{slope:.2f}" for slope in slopes), flush=True)


if __name__ == "__main__":
    main()

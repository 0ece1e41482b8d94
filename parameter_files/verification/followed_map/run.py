#!/usr/bin/env python3
"""A map of 100 x 100 cases by followed roots against direct solutions of 100 cells drawn by seed; see README.md.

usage: run.py [PROGRAM] [--ranks 2] [--seed 1] [--cells 100] [--folder FOLDER]
"""
import argparse
import csv
import json
import os
import random
import subprocess
import sys
import time

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--ranks", type=int, default=2)
arguments.add_argument("--seed", type=int, default=1)
arguments.add_argument("--cells", type=int, default=100)
arguments.add_argument("--folder", default="followed_map")
options = arguments.parse_args()
file = os.path.join(here, "map.prm")
cache = os.path.join(options.folder, "cache")


def run(name, ranks, *entries):
    """stability.csv by case: swept values, roots."""
    folder = os.path.join(options.folder, name)
    command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    command += [options.program, file, "--quiet", "--output", folder]
    for entry in entries + ("Output/Cache directory=" + cache, "Output/Figures=false"):
        command += ["--set", entry]
    begin = time.time()
    subprocess.run(command, check=True)
    seconds = time.time() - begin
    cases = {}
    with open(os.path.join(folder, "stability.csv")) as lines:
        for row in csv.DictReader(line for line in lines if not line.startswith("#")):
            cases.setdefault(int(float(row["case"])), []).append(row)
    return cases, json.load(open(os.path.join(folder, "results.json")))["analyses"]["stability"], seconds


cases, results, seconds = run("map", options.ranks)
print("map of %d cases: %.1f s on %d ranks; followed %s" % (len(results["cases"]), seconds, options.ranks, results["followed"]))

# distance to the boundary of stability: the growth of the root that is nearest to 0
nearest = sorted(cases, key=lambda k: min(abs(float(root["growth_1_s"])) for root in cases[k] if float(root["growth_1_s"]) > -0.5) if any(
    float(root["growth_1_s"]) > -0.5 for root in cases[k]) else 1e9)
draw = random.Random(options.seed)
near = draw.sample(nearest[:len(nearest) // 10], options.cells // 2)
drawn = near + draw.sample([k for k in nearest if k not in near], options.cells - len(near))
worst, wrong, n_roots, n_names = 0, 0, 0, 0
with open(os.path.join(options.folder, "cells.csv"), "w") as table:
    table.write("# cells of the map against direct solutions; lateral position and friction of each, roots that grow, largest error of a growth\n")
    table.write("case,near_boundary,lateral_position_m,friction,unstable,error_growth_1_s\n")
    for k in drawn:
        at = results["cases"][k]["swept"]
        direct, found, _ = run("direct", 1, "Stability/Sweep/Entry=", "Stability/Sweep/Range=", "Stability/Sweep/Second entry=", "Stability/Sweep/Second range=",
                               "Stability/Roots of a sweep=complete", "Contact/Lateral position=%.12g" % at["lateral_position_m"],
                               "Contact/Friction coefficient=%.12g" % at["friction_coefficient"])
        error = 0
        for root in cases[k]:
            f, g = float(root["frequency_Hz"]), float(root["growth_1_s"])
            error = max(error, abs(g - float(min(direct[0], key=lambda other: abs(6.2832 * (float(other["frequency_Hz"]) - f)) + abs(
                float(other["growth_1_s"]) - g))["growth_1_s"])))
            n_roots += 1
        here_unstable, there = len(results["cases"][k]["unstable"]), len(found["unstable"])
        if here_unstable != there:
            wrong += 1
            print("case %d at %s: %d roots grow in the map, %d in the direct solution" % (k, at, here_unstable, there))
        worst = max(worst, error)
        table.write("%d,%d,%.17g,%.17g,%d,%.3g\n" % (k, k in near, at["lateral_position_m"], at["friction_coefficient"], there, error))
print("%d cells, %d roots: largest error of a growth %.2g 1/s, cells with another number of growing roots: %d" % (len(drawn), n_roots, worst, wrong))
sys.exit(1 if wrong or worst > 1e-3 else 0)

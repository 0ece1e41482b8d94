#!/usr/bin/env python3
"""Errors of a wheel's frequencies against what they cost, by harmonics and by solid elements in one run; see README.md.

usage: run.py [PROGRAM] [--without-solid]
"""
import argparse
import json
import os
import re
import subprocess
import tempfile
import time

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--without-solid", action="store_true")
options = arguments.parse_args()


def modes(limit, model, degree, refinements):
    """Ascending frequencies [Hz] for each number of nodal diameters, dofs, wall time [s], peak memory [MB] of the whole program."""
    with tempfile.TemporaryDirectory() as folder:
        command = [options.program, os.path.join(here, "..", "wheel_frequencies", "wheel.prm"), "--quiet", "--output", folder]
        for entry, value in {"wheel/Modes/Upper frequency": limit, "wheel/Wheel/Model": model, "wheel/Wheel/Element degree": degree,
                             "wheel/Wheel/Section refinements": refinements, "Output/Cache directory": "", "Output/Figures": "false",
                             "Output/Fields": "false"}.items():
            command += ["--set", f"{entry}={value}"]
        begin = time.time()
        process = subprocess.Popen(command)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"{model}, degree {degree}: the program ended with status {status}")
        seconds = time.time() - begin
        found = json.load(open(os.path.join(folder, "results.json")))["analyses"]["modes"]["wheel"]
    by_n = {}
    for label, frequency in sorted(zip(found["labels"], found["frequencies_Hz"]), key=lambda mode: mode[1]):
        n = int(re.search(r"(\d+)\)", label).group(1))
        by_n.setdefault(n, []).append(frequency)
    return by_n, found["n_dofs"], seconds, usage.ru_maxrss / 1024


def error(found, finest):
    """Largest of all modes; None if another number of them lies below the limit."""
    if {n: len(f) for n, f in found.items()} != {n: len(f) for n, f in finest.items()}:
        return None
    return max(abs(a / b - 1) for n in finest for a, b in zip(found[n], finest[n]))


table = open(os.path.join(here, "wheel_by_harmonics.csv"), "w")
table.write("# Largest error of all frequencies against degree 4 with halved cells; wall time and peak memory of the whole program, one rank\n")
table.write("limit [Hz],model,degree,halvings,n_dofs,n_modes,largest error,seconds,memory [MB]\n")
print(f"load {os.getloadavg()[0]:.2f}")


def row(limit, model, degree, refinements, finest):
    found, n_dofs, seconds, memory = modes(limit, model, degree, refinements)
    of_it = error(found, finest or found)
    cells = [str(limit), model, str(degree), str(refinements), str(n_dofs), str(sum(map(len, found.values()))),
             "reference" if finest is None else "other modes" if of_it is None else f"{of_it:.1e}", f"{seconds:.1f}", f"{memory:.0f}"]
    print(",".join(cells), flush=True)
    table.write(",".join(cells) + "\n")
    return found, of_it, seconds, memory


wrong = []
for limit, bound in ((8000, 1e-3), (20000, 1e-3)):
    finest = row(limit, "harmonics", 4, 1, None)[0]
    lean = {}
    for degree, refinements in ((2, 0), (2, 1), (3, 0), (3, 1), (4, 0)) if limit == 8000 else ((3, 0), (4, 0)):
        lean[degree, refinements] = row(limit, "harmonics", degree, refinements, finest)[1:]
    if not lean[3, 0][0] or lean[3, 0][0] > bound or lean[4, 0][0] > bound / 5:
        wrong.append(f"below {limit} Hz")
    if limit == 8000 and not options.without_solid:
        _, of_solid, seconds, memory = row(limit, "solid", 2, 0, finest)
        # the cheapest one that is not worse
        at_least = [cost for cost in lean.values() if cost[0] is not None and of_solid is not None and cost[0] <= of_solid]
        if not at_least:
            wrong.append("solid elements have other modes")
            continue
        best = min(at_least, key=lambda cost: cost[1])
        print(f"solid elements, error {of_solid:.1e}: {seconds / best[1]:.0f} times the time and {memory / best[2]:.1f} times the memory of harmonics with error {best[0]:.1e}")
        if seconds < 50 * best[1]:
            print("less than 50 times the time")
raise SystemExit("wrong: " + "; ".join(wrong) if wrong else 0)

#!/usr/bin/env python3
"""Extrapolated creep forces of random cases against limits by refinement; see README.md.
Usage: run.py [PROGRAM] [--seed N]: the cases of cases.csv, or 30 new ones with limits of their own (20 minutes)"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import creep_cases

here = os.path.dirname(os.path.abspath(__file__))
arguments = sys.argv[1:]
seed = None
if "--seed" in arguments:
    seed = int(arguments.pop(arguments.index("--seed") + 1))
    arguments.remove("--seed")
program = arguments[0] if arguments else os.path.join(here, "..", "..", "..", "build", "vibrocontact")
n_cases = 30
first, second = "first-order upwind", "second-order upwind"

def solve(case, refined=1, offset=None, **entries):
    """Fx, Fy over mu N, moment over mu N sqrt(a b), their stated errors and what else the program says."""
    settings = [f"{entry}={value!r}" for entry, value in creep_cases.settings(case, refined, offset).items()]
    settings += [f"{entry.replace('__', '/').replace('_', ' ')}={value}" for entry, value in entries.items()]
    with tempfile.TemporaryDirectory() as folder:
        command = [program, creep_cases.FILE, "--quiet", "--output", folder]
        for one in settings:
            command += ["--set", one]
        subprocess.run(command, check=True)
        with open(os.path.join(folder, "results.json")) as file:
            found = json.load(file)["analyses"]["quasi_static_rolling"]["cases"][0]
    bound = case["friction"] * found["normal_force_N"]
    arm = math.sqrt(case["a_m"] * case["b_m"])
    return (creep_cases.over_friction(case, found), found["force_error_N"] / bound,
            found["spin_moment_error_Nm"] / bound / arm, found)


def limit(case):
    """Mean of 2 F(h / 8) - F(h / 4) of the two schemes, each the mean of some alignments."""
    total = [0., 0., 0.]
    for scheme in (first, second):
        for refined, weight, offsets in ((4, -1, [(0, 0), (.5, .5), (.25, -.25), (-.25, .25)]),
                                         (8, 2, [(.1, .1), (-.35, .4)])):
            for offset in offsets:
                F = solve(case, refined, offset, Rolling__Grids="one", Contact__Creep_scheme=scheme)[0]
                total = [t + 0.5 * weight / len(offsets) * f for t, f in zip(total, F)]
    return dict(zip(("fx", "fy", "moment"), total))


if seed is None:
    cases = creep_cases.stored()
else:
    generator = random.Random(seed)
    cases = [creep_cases.draw(generator) for _ in range(n_cases)]
    for case in cases:
        case.update(limit(case))

beyond = []
for name, entries in (("two grids, the file's and its half", {}),
                      ("one grid, second order", {"Rolling__Grids": "one", "Contact__Creep_scheme": second}),
                      ("one grid, first order", {"Rolling__Grids": "one", "Contact__Creep_scheme": first})):
    force, moment, stated, covered, iterations, seconds, points = [], [], [], [0, 0], 0, 0., []
    for case in cases:
        F, force_error, moment_error, found = solve(case, **entries)
        force.append(math.hypot(F[0] - case["fx"], F[1] - case["fy"]))
        moment.append(abs(F[2] - case["moment"]))
        stated.append(force_error)
        # a limit is known to 1e-4
        covered[0] += force_error + 1e-4 >= force[-1]
        covered[1] += moment_error + 1e-4 >= moment[-1]
        iterations = max(iterations, found["iterations"])
        seconds += found["seconds"]
        points.append(found["contact_points"])
    n = len(cases)
    # the bounds of README.md
    if not entries and (sum(force) / n > 0.004 or max(force) > 0.01 or iterations > 16):
        beyond.append(f"{name}: force or iterations beyond their bounds")
    if min(covered) < 0.9 * n:
        beyond.append(f"{name}: the stated error is below the true one in more than a tenth of the cases")
    print(f"{name}: force off by {100 * sum(force) / n:.2f} % of mu N on average, {100 * max(force):.2f} % at worst; moment "
          f"{100 * sum(moment) / n:.2f} and {100 * max(moment):.2f} % of mu N sqrt(a b); stated error {100 * sum(stated) / n:.2f} % "
          f"on average, not below the true one in {covered[0]} and {covered[1]} of {n} cases; at most {iterations} iterations, "
          f"{min(points)} to {max(points)} points, {seconds:.1f} s")
if beyond:
    sys.exit("BEYOND THE BOUNDS: " + "; ".join(beyond))

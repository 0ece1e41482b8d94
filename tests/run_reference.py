#!/usr/bin/env python3
"""run_reference.py PROGRAM FILE.prm REFERENCE N_RANKS MPIRUN: runs the file and compares results.json.

Lines of the reference (# begins a comment):  path  value  tolerance
  path       keys and indices into results.json, e.g. analyses.quasi_static_rolling.cases[0].max_pressure_Pa;
             a part in braces is evaluated as a formula of such paths: {a.b / a.c}
  value      number or word
  tolerance  absolute, or relative with a %; none for words
"""
import json, re, shutil, subprocess, sys

program, prm, reference, n_ranks, mpirun = sys.argv[1:6]
folder = prm[:-4] + ".ranks=" + n_ranks
shutil.rmtree(folder, ignore_errors=True)
command = [program, prm, "--quiet", "--output", folder]
if int(n_ranks) > 1:
    command = [mpirun, "-n", n_ranks] + command
code = subprocess.run(command).returncode
if code != 0:
    sys.exit(f"exit code {code}: {' '.join(command)}")
results = json.load(open(folder + "/results.json"))


def find(path):
    node = results
    for part in re.findall(r"[^.\[\]]+|\[-?\d+\]", path):
        node = node[int(part[1:-1])] if part.startswith("[") else node[part]
    return node


def evaluate(text):
    if not text.startswith("{"):
        return find(text)
    formula = re.sub(r"[A-Za-z_][\w.]*(\[-?\d+\]|\.\w+)+|\bwall_s\b", lambda m: repr(find(m.group(0))), text[1:-1])
    return eval(formula, {"abs": abs, "max": max, "min": min, "sum": sum, "len": len})


n_failed = n_checked = 0
for line in open(reference):
    line = line.split("#")[0].strip()
    if not line:
        continue
    match = re.match(r"(\{.*\}|\S+)\s+(\S+)(?:\s+(\S+))?$", line)
    path, expected, tolerance = match.groups()
    got = evaluate(path)
    if tolerance is None:
        good = str(got) == expected
    else:
        limit = abs(float(expected)) * float(tolerance[:-1]) / 100 if tolerance.endswith("%") else float(tolerance)
        good = abs(float(got) - float(expected)) <= limit
    n_checked += 1
    n_failed += not good
    print("ok    " if good else "WRONG ", path, "=", got, "expected", expected, tolerance or "")
if n_checked == 0:
    sys.exit("the reference holds no numbers")
sys.exit(1 if n_failed else 0)

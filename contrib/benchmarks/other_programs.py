"""Comparisons with other programs for the report: peers/with_*.py, each run where its program is installed."""
import csv
import glob
import html
import os
import subprocess
import sys

import program
import report

FOLDER = os.path.join(program.HERE, "peers")
# Siconos comes for Debian's own Python only
PYTHON = "/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable
SKIPPED = 77


def compare(bench, folder):
    """Runs all comparisons; html of their tables and failures by name. What is not installed is said, not a failure."""
    sections, failures = ["<h2>Other programs</h2>"], {}
    for script in sorted(glob.glob(os.path.join(FOLDER, "with_*.py"))):
        name = os.path.basename(script)[len("with_"):-len(".py")]
        command = [PYTHON, "-B", script, "--build", bench.build, "--output", folder] + (["--quick"] if bench.quick else [])
        done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=program.ENVIRONMENT)
        last = (done.stdout.strip().splitlines() or ["no word"])[-1]
        if done.returncode == SKIPPED:
            sections.append(f"<p>{html.escape(last)}</p>")
        elif done.returncode != 0:
            failures[name] = last
        print(f"{name}: {'done' if done.returncode == 0 else last}", flush=True)
        if done.returncode == 0:
            sections += [section(file) for file in sorted(glob.glob(os.path.join(folder, f"peer_{name}*.csv"))) if "_each" not in file]
    return "\n".join(sections), failures


def section(name):
    """Table of a CSV file below its title."""
    with open(name, encoding="utf-8") as file:
        title, *rows = file.read().splitlines()
    head, *rows = csv.reader(rows)

    def short(cell):
        try:
            return f"{float(cell):.4g}"
        except ValueError:
            return cell
    return f"<p class='caption'>{html.escape(title.lstrip('# '))}</p>" + report.table(head, [[short(cell) for cell in row] for row in rows])

#!/usr/bin/env python3
"""Ring-down of the lap joint against Masing's rule from its own loading. See README.md.

usage: run.py [PROGRAM] [--steps 1e-6 5e-7] [--picture FILE]
"""
import argparse
import csv
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, here)
from masing import compared  # noqa: E402

top = os.path.join(here, "..", "..", "..")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--steps", nargs="+", default=["1e-6", "5e-7"], help="the last half of the one before")
arguments.add_argument("--picture", default="", help="needs matplotlib")
options = arguments.parse_args()


def percent(value, truth):
    return 100 * (value / truth - 1)


rows, by_step = [], []
with tempfile.TemporaryDirectory() as scratch:
    for step in options.steps:
        folder = os.path.join(scratch, step)
        subprocess.run([options.program, os.path.join(top, "parameter_files", "examples", "lap_joint.prm"), "--quiet",
                        "--output", folder, "--set", f"Transient/Time step={step}", "--set", "Transient/Signals/Table=true",
                        "--set", "Output/Figures=false", "--set", "Output/Cache directory=" + os.path.join(scratch, "cache")],
                       check=True)
        by_step.append(compared(folder, 1e4))
        rows += [{"step_s": step, **row} for row in by_step[-1]]
print("amplitude [um], decrement by Masing, of the march in %, with steps of", ", ".join(options.steps), "s and extrapolated; period in %")
for cycles in zip(*by_step):
    finest = cycles[-1]
    errors = [percent(one["decrement"], one["decrement_masing"]) for one in cycles]
    print(f"{finest['amplitude_m'] * 1e6:.4f}  {finest['decrement_masing']:.4e}",
          *(f"{error:+.2f}" for error in errors),
          f"{2 * errors[-1] - errors[-2]:+.2f}  {percent(finest['period_s'], finest['period_masing_s']):+.4f}")
if options.picture:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4))
    amplitude = [1e6 * row["amplitude_m"] for row in by_step[-1]]
    for axis, key, factor in ((axes[0], "decrement", 1), (axes[1], "period", 1e3)):
        masing = "decrement_masing" if key == "decrement" else "period_masing_s"
        axis.plot(amplitude, [factor * row[masing] for row in by_step[-1]], "-", color="0.5", label="Masing's rule from the loading")
        for step, cycles in zip(options.steps, by_step):
            axis.plot([1e6 * row["amplitude_m"] for row in cycles],
                      [factor * row["decrement" if key == "decrement" else "period_s"] for row in cycles], "o", ms=4,
                      label=f"march, {float(step) * 1e6:g} us")
        axis.set_xlabel("amplitude [um]")
        axis.grid(alpha=0.3)
    axes[0].plot(amplitude, [b["decrement_masing"] * (2 * b["decrement"] / b["decrement_masing"] - a["decrement"] / a["decrement_masing"])
                             for a, b in zip(by_step[-2], by_step[-1])], "x", color="k", label="extrapolated")
    axes[0].set_ylabel("logarithmic decrement")
    axes[1].set_ylabel("period [ms]")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(options.picture, dpi=90)
with open(os.path.join(here, "lap_joint.csv"), "w", newline="", encoding="utf-8") as file:
    writer = csv.DictWriter(file, list(rows[0]))
    writer.writeheader()
    writer.writerows(rows)

#!/usr/bin/env python3
"""Loops and ring-down of the lap joint against Masing's rule from its first loading. See README.md.

usage: run.py [PROGRAM] [--file lap_joint.prm] [--steps 2e-6 1e-6] [--set ENTRY=VALUE ...] [--picture FILE]
"""
import argparse
import csv
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
top = os.path.join(here, "..", "..", "..")
sys.path.insert(0, here)
from masing import alone, compared, cycles, error, loops, to_and_fro, turns, vc  # noqa: E402

example = os.path.join(top, "parameter_files", "examples", "lap_joint.prm")
arguments = argparse.ArgumentParser()
arguments.add_argument("program", nargs="?", default=os.path.join(top, "build", "vibrocontact"))
arguments.add_argument("--file", default=example, help="another joint")
arguments.add_argument("--steps", nargs="+", default=["2e-6", "1e-6"], help="the last half of the one before")
arguments.add_argument("--set", nargs="+", default=[], metavar="ENTRY=VALUE", help="other entries of the file")
arguments.add_argument("--picture", default="", help="needs matplotlib")
options = arguments.parse_args()


def run(folder, *settings):
    words = [word for one in ["Output/Figures=false", *options.set, *settings] for word in ("--set", one)]
    subprocess.run([options.program, options.file, "--quiet", "--output", folder, *words], check=True)
    return vc.Results(folder)


marches, rows = [], []
with tempfile.TemporaryDirectory() as scratch:
    cache = "Output/Cache directory=" + os.path.join(scratch, "cache")
    for step in options.steps:
        marches.append(run(os.path.join(scratch, step), "Transient/Time step=" + step, cache))
        rows += [{"step_s": step, **row} for row in compared(marches[-1].folder)]
    motions = [turns(march)[:2] for march in marches]
    n = len(motions[-1][0])
    by_rule = alone(marches[-1], n)
    by_step = [cycles(compared(march.folder)) for march in marches]
    # the march after it is cut short
    still = cycles(loops(run(os.path.join(scratch, "loops"), *to_and_fro(marches[-1], n), cache, "Transient/End time=1e-4").folder))

print("cycle, amplitude [um], energy taken [J] by Masing's rule from that amplitude, in % of it: of the quasi-static loop, of the march with steps of",
      ", ".join(options.steps), "s and extrapolated;\nperiod in %; amplitude in % of what the rule has by then, extrapolated")
for number, (coarse, fine) in enumerate(zip(*by_step[-2:])):
    every = [100 * error(one[number], "loss_J") for one in by_step]
    ahead = [100 * error(one, "amplitude_m") for one in (coarse, fine)]
    print(f"{number + 1}  {fine['amplitude_m'] * 1e6:.4f}  {fine['loss_masing_J']:.4e}  {100 * error(still[number], 'loss_J'):+.3f} ",
          *(f"{one:+.2f}" for one in every), f"{2 * every[-1] - every[-2]:+.3f}  {100 * error(fine, 'time_s'):+.4f}  {2 * ahead[1] - ahead[0]:+.3f}")
if options.picture:
    sys.path.insert(0, os.path.join(top, "contrib"))
    from plots.ring_down import draw, panels
    figure, axes = panels()
    draw(axes, vc.ring_down(*by_rule[:2]), "-", color="0.5", label="Masing's rule from the loading alone")
    for step, motion in zip(options.steps, motions):
        draw(axes, vc.ring_down(*motion), label=f"march, {float(step) * 1e6:g} us")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(options.picture, dpi=90)
if options.file == example and not options.set:
    with open(os.path.join(here, "lap_joint.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)

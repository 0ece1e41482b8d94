#!/usr/bin/python3
"""What a user would write by hand in Octave, against Vibrocontact: both answers, both times.

hexahedra_modes.m assembles the block of with_calculix.py and finds its modes by eigs; bouncing_bar.m marches the bar of
parameter_files/examples/bouncing_bar.prm by the theta method with one contact point.
"""
import os
import shutil
import tempfile

from block_mesh import MODES, mesh, our_modes
from common import EXAMPLES, HERE, options, processor_seconds, require, run_ours, skip, write_table


def octave(script, folder, *arguments):
    """Runs an m-file in a folder; processor seconds."""
    return processor_seconds(["octave-cli", "--quiet", "--no-init-file", os.path.join(HERE, script), *map(str, arguments)], folder)[0]


def compare_modes(chosen):
    rows = []
    for divisions in (6,) if chosen.quick else (10, 20, 30):
        with tempfile.TemporaryDirectory() as folder:
            nodes, cells, held = mesh(folder, divisions)
            numbers = {node: k for k, node in enumerate(sorted(nodes), 1)}
            for name, lines in (("nodes", [[1e-3 * c for c in nodes[node]] for node in sorted(nodes)]),
                                ("cells", [[numbers[node] for node in cell] for cell in cells]), ("held", [[numbers[node]] for node in held])):
                with open(os.path.join(folder, name + ".csv"), "w") as file:
                    file.writelines(",".join(repr(value) for value in line) + "\n" for line in lines)
            ours, our_seconds = our_modes(chosen, folder)
            seconds = octave("hexahedra_modes.m", folder, MODES)
            with open(os.path.join(folder, "frequencies.csv")) as file:
                theirs = [float(line) for line in file]
            off = max(abs(a / b - 1) for a, b in zip(ours, theirs))
            require(len(ours) == len(theirs) and off < 1e-9, f"frequencies of {len(cells)} cells differ by {off:.1e}")
            rows.append((len(cells), 3 * len(nodes), ours[0], theirs[0], off, our_seconds, seconds, seconds / our_seconds))
    write_table(chosen.output, "octave_modes", "Lowest 20 modes of a held block of linear hexahedra: largest difference, processor seconds of the whole run",
                ("cells", "unknowns", "first_ours_Hz", "first_octave_Hz", "largest_difference", "ours_s", "octave_s", "octave_over_ours"), rows)


def compare_march(chosen):
    rows = []
    file = os.path.join(EXAMPLES, "bouncing_bar.prm")
    for elements, theta, step in [(100, 0.5, 1e-3)] if chosen.quick else [(100, 0.5, 1e-3), (100, 1., 1e-3), (200, 0.5, 5e-4), (400, 0.5, 1e-4)]:
        with tempfile.TemporaryDirectory() as folder:
            runs = [run_ours(chosen, file, folder, bar__Bar__Divisions=elements, bar__Bar__Element_degree=1, Transient__Model="finite elements",
                             Transient__Reaction="end of step", Transient__Time_step=step, Transient__Theta=theta, Transient__Error_estimate="false")
                    for _ in range(1 if chosen.quick else 5)]
            run, our_seconds = runs[0][0]["transient"], min(seconds for _, seconds in runs)
            seconds = octave("bouncing_bar.m", folder, elements, step, theta)
            with open(os.path.join(folder, "bar.csv")) as results:
                impulse, energy, us = map(float, results.read().split(","))
            off = max(abs(run["impulse_Ns"] / impulse - 1), abs(run["energy"]["stored_J"] / energy - 1))
            require(off < 1e-8, f"{elements} elements: impulse {run['impulse_Ns']} and {impulse}, energy {run['energy']['stored_J']} and {energy}")
            ours_us = 1e6 * min(analyses["transient"]["seconds_per_step"] for analyses, _ in runs)
            rows.append((elements, theta, step, run["impulse_Ns"], impulse, off, ours_us, us, us / ours_us, our_seconds, seconds))
    write_table(chosen.output, "octave_march", "Bouncing bar of linear elements, the same scheme: impulse (closed form 200 N s), largest difference of impulse and energy",
                ("elements", "theta", "step_s", "ours_Ns", "octave_Ns", "difference", "ours_us_per_step", "octave_us_per_step", "octave_over_ours", "ours_s", "octave_s"), rows)


def main():
    chosen = options(__doc__)
    if shutil.which("octave-cli") is None:
        skip("Octave", "octave")
    compare_modes(chosen)
    compare_march(chosen)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""plot_results.py FOLDER: figures of a run, from results.json and the tables in its output folder.
plot_results.py FOLDER --contact-table TABLE: the same, with tractions of the program CONTACT on top of the centre line.
plot_results.py --scene FOLDER: the scene that --check --output FOLDER has left there, figures/scene.png.
plot_results.py --compare FOLDER FOLDER ... [--picture compare.png]: what several runs have in common, in one picture.

figures/contact_patch_<k>.png   pressure, traction and status over the patch
figures/centre_line_<k>.png     tractions along y = 0, as in Fig. 7 of Lai et al. (2018)
figures/creep_curves.png        tangential force (spin: moment too) against what is swept
figures/loading.png             force over displacement and what friction takes in quasi-static loading
figures/loading_patches.png     tractions and status at the ends of its parts
figures/frequency_response.png  mobilities of the driving points over frequency, as in Fig. 6
figures/green_functions_<body>.png frequency and impulse responses of a body known by its Green's functions, as in Fig. 5 of Meftah & Duhamel
figures/identification.png      receptances given, fitted by poles, and their differences
figures/stabilisation_chart.png identified poles over their number
figures/receptance_fit_<body>.png, receptance_in_time_<body>.png  a periodic rail and its poles, with their error over frequency
figures/response.png            periodic motions along a branch, stable and unstable, as in Fig. 12 of Jones & Legrand
figures/stability_sweep.png     divergence rates along a sweep of one entry
figures/stability_map.png       number of unstable roots and each one's divergence rate over a sweep of two entries
figures/root_locus.png          paths of the followed roots: growth against frequency
figures/mode_shapes_<body>.png  deformed shapes coloured by amplitude, as in Fig. 3 of the paper
figures/unstable_shapes.png     deformed shapes of the unstable roots at their largest, as in Figs 9 to 12
figures/divergence_rates.png    divergence rates of the roots, as in Fig. 8
figures/transient_force.png     tangential force with stick and slip counts, as in Fig. 13
figures/transient_status.png    status of the contact points through a period, as in Fig. 14 (needs Patch interval)
figures/ring_down.png           frequency and damping over amplitude of a hub that was let go (Transient/Release)
figures/mode_growth.png         amplitudes of the modes over time beside the growth of their roots
figures/transient_<signal>.png  velocity of a probe and its spectrogram, as in Fig. 15
figures/spectrum_<signal>.png    its amplitudes over frequency, peaks named by roots, modes and harmonics
figures/<analysis>_bands.png     1/3-octave bands of the contact force of a transient or a modal convolution
figures/modal_convolution_*.png displacements and forces, as in Figs 2, 3, 6, 7 of Meftah & Duhamel
figures/method_comparison.png   error against cost of the propagators
figures/periodic_motion.png     displacement, velocity and contact force over a period, as in Figs 6 to 9 of Jones & Legrand
figures/periodic_errors.png     their errors over the number of functions and over time, as in Figs 10 and 11
figures/time_bases.png          functions of the bases in time, as in Figs 2 to 5
Needs matplotlib, after a transient also h5py; exit code 4 without. Tractions act on body 1; the contact travels towards -x.
"""
import argparse
import glob
import json
import os
import sys

# nothing is written beside the sources
sys.dont_write_bytecode = True
arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("folder", nargs="?")
arguments.add_argument("--contact-table")
arguments.add_argument("--compare", nargs="+", default=[], metavar="FOLDER")
arguments.add_argument("--scene", action="store_true")
arguments.add_argument("--picture", default="compare.png")
options = arguments.parse_args()
FOLDERS = options.compare or [options.folder]
NEEDED = "scene.json" if options.scene else "results.json"
for one in FOLDERS:
    if one is None or not os.path.exists(os.path.join(one, NEEDED)):
        arguments.error(f"{one} is no output folder of a {'check' if options.scene else 'run'}: it has no {NEEDED}")
try:
    import numpy  # noqa: F401
    import matplotlib  # noqa: F401
    if any(glob.glob(os.path.join(glob.escape(one), "*histories.h5")) for one in FOLDERS):
        import h5py  # noqa: F401
except ImportError:
    sys.exit(4)

from plots.basins import plot_basins
from plots.compare import plot_comparison_of_runs
from plots.contact import plot_centre_line, plot_curves, plot_patch
from plots.limit_cycle import plot_amplitudes, plot_branches, plot_harmonic_balance, plot_limit_cycles, plot_map
from plots.loading import plot_loading
from plots.periodic import plot_periodic
from plots.rail import plot_rails
from plots.response import plot_frequency_response, plot_identification
from plots.response_curve import plot_response_curve
from plots.scene import plot_scene
from plots.shapes import plot_modes, plot_unstable
from plots.stability import plot_divergence, plot_sweep

MAX_PATCHES = 4


def compare():
    if len(options.compare) < 2:
        arguments.error("--compare needs at least two output folders")
    found = plot_comparison_of_runs(options.compare, options.picture)
    if not found:
        sys.exit("the runs have no quantity in common: nothing is drawn")
    print(f"{options.picture}: {', '.join(found)}")


def main():
    folder = options.folder
    os.makedirs(os.path.join(folder, "figures"), exist_ok=True)
    if options.scene:
        plot_scene(folder)
        return
    with open(os.path.join(folder, "results.json")) as file:
        results = json.load(file)
    analyses = results["analyses"]
    rolling = analyses.get("quasi_static_rolling", {})
    cases = rolling.get("cases", [])
    # of one contact, or of several by their names
    for before, own in [("", cases)] + [(name + "_", one["cases"]) for name, one in rolling.get("contacts", {}).items()]:
        patches = [k for k in range(len(own)) if os.path.exists(os.path.join(folder, f"contact_patch_{before}{k}.csv"))]
        for k in patches if len(patches) <= MAX_PATCHES else patches[:1] + patches[-1:]:
            plot_patch(folder, f"{before}{k}", own[k])
            plot_centre_line(folder, f"{before}{k}", own[k], options.contact_table)
    plot_curves(folder, cases)
    if analyses.get("quasi_static_loading", {}).get("steps") and os.path.exists(os.path.join(folder, "loading.csv")):
        plot_loading(folder, analyses["quasi_static_loading"])
    if analyses.get("limit_cycle"):
        plot_limit_cycles(folder, analyses["limit_cycle"])
        plot_harmonic_balance(folder, analyses["limit_cycle"])
        plot_branches(folder, analyses["limit_cycle"])
    if analyses.get("limit_cycle_basins"):
        plot_basins(folder, analyses["limit_cycle_basins"], analyses["limit_cycle"])
    if analyses.get("limit_cycle_sweep", {}).get("cases"):
        plot_amplitudes(folder, analyses["limit_cycle_sweep"])
        plot_map(folder, analyses["limit_cycle_sweep"])
    if "frequency_response" in analyses:
        plot_frequency_response(folder, analyses["frequency_response"])
    plot_rails(folder, results.get("reductions", {}))
    if analyses.get("identification"):
        plot_identification(folder, analyses["identification"])
    if "response" in analyses:
        plot_response_curve(folder, analyses["response"])
    if analyses.get("stability", {}).get("sweep"):
        plot_sweep(folder, analyses["stability"]["swept_columns"], analyses["stability"]["swept_entries"])
    for body, modes in analyses.get("modes", {}).items():
        if isinstance(modes, dict) and "frequencies_Hz" in modes:
            plot_modes(folder, body, modes)
    if "stability" in analyses and os.path.exists(os.path.join(folder, "stability.csv")):
        plot_divergence(folder)
        plot_unstable(folder, analyses["stability"])
    if analyses.get("periodic"):
        plot_periodic(folder, analyses["periodic"])
    if not glob.glob(os.path.join(glob.escape(folder), "*histories.h5")):
        return
    # they need h5py
    from plots.convolution import plot_comparison, plot_modal_convolution
    from plots.transient import known_frequencies, plot_transient
    from plots.common import plot_bands
    for analysis in ("transient", "modal_convolution"):
        if "third_octaves" in analyses.get(analysis, {}):
            plot_bands(folder, analyses[analysis]["third_octaves"], analysis + "_bands")
    convolution = analyses.get("modal_convolution", {})
    if "transient" in analyses or not convolution:
        plot_transient(folder, analyses.get("transient", {}), results.get("title", ""), known_frequencies(analyses))
    if not convolution:
        return
    plot_modal_convolution(folder, convolution.get("histories", "histories.h5"))
    if "method_comparison" in convolution:
        plot_comparison(folder, convolution["method_comparison"])


if __name__ == "__main__":
    compare() if options.compare else main()

#!/usr/bin/python3
"""How small a model may be: error of what each shipped scene asks over modes, functions, elements, grid, points and step; see doc/smallest_models.md.

  smallest_models.py [--scenes NAME ...] [--expensive] [--output DIR]

One entry of the shipped file is varied at a time; truth is its finest value, or the closed form of scenes.py. Writes smallest_models.csv (the smallest
value from which on the error stays below 1 %, and whether the file uses it) and smallest_models_runs.csv (every run)."""
import csv
import json
import os
import sys
import tempfile

sys.dont_write_bytecode = True
import program  # noqa: E402
from scenes import SCENES  # noqa: E402

WITHIN = 0.01
QUICK = {"Output/Figures": "false", "Output/Fields": "false"}


def run(bench, scene, entries):
    """Quantities asked and processor seconds; None where the program refuses or does not converge, with its last line."""
    file = os.path.join(program.ROOT, "parameter_files", "examples", scene.file + ".prm")
    with tempfile.TemporaryDirectory() as folder:
        command = [bench.path, file, "--quiet", "--output", folder]
        for entry, value in {**QUICK, "Output/Cache directory": bench.cache, **scene.base, **entries}.items():
            command += ["--set", f"{entry}={value}"]
        try:
            seconds, _ = program.processor_seconds(command)
        except RuntimeError as error:
            return None, str(error).strip().splitlines()[-1].rsplit("vibrocontact: ", 1)[-1]
        with open(os.path.join(folder, "results.json"), encoding="utf-8") as results:
            analyses = json.load(results)["analyses"]
        return scene.ask({**analyses, "folder": folder}), seconds


def error(found, truth, scale):
    """Largest difference of the numbers of the truth over themselves, or over the largest of them. A number that is missing counts as zero."""
    largest = max(abs(value) for value in truth.values())
    return max(abs(found.get(name, 0.) - value) / (largest if scale == "largest" or value == 0 else abs(value)) for name, value in truth.items())


def study(bench, scene, knob):
    """Rows (label, error, seconds, what was said) of a knob, from small to fine."""
    found = {label: run(bench, scene, entries) for label, entries in knob.values.items()}
    answers = [answer for answer, _ in found.values() if answer is not None]
    truth = scene.exact or (answers[-1] if answers else {})
    if not truth:
        return [(label, None, None, cost if answer is None else "there is nothing to compare") for label, (answer, cost) in found.items()]
    return [(label, error(answer, truth, scene.scale), cost, "") if answer is not None else (label, None, None, cost) for label, (answer, cost) in found.items()]


def verdict(scene, knob, rows):
    """The smallest value from which on all errors stay within 1 %, its error, its cost over the shipped one's, and what that means."""
    by_label = {label: (wrong, cost) for label, wrong, cost, _ in rows}
    if all(wrong is None for _, wrong, _, _ in rows):
        return "", None, None, "nothing compared"
    if not scene.exact and rows[-1][1] is None:
        return "", None, None, "the finest value failed"
    last = len(rows) if scene.exact else len(rows) - 1
    smallest = None
    for label, wrong, _, _ in reversed(rows[:last]):
        if wrong is None or wrong > WITHIN:
            break
        smallest = label
    shipped_wrong, shipped_cost = by_label.get(knob.shipped, (None, None))
    # the finest value shipped is its own truth
    if smallest is None:
        return "none below the finest", None, None, "within 1 % nothing smaller" if knob.shipped == rows[-1][0] else "coarser than 1 %"
    if shipped_wrong is None:
        return smallest, by_label[smallest][0], None, "the file holds several"
    if shipped_wrong > WITHIN:
        said = f"coarser than 1 % ({100 * shipped_wrong:.2g} %)"
    else:
        said = "used" if smallest == knob.shipped else "larger than needed"
    return smallest, by_label[smallest][0], by_label[smallest][1] / shipped_cost, said


def main():
    parser = program.Parser(__doc__)
    parser.add_argument("--scenes", nargs="+", default=[], metavar="NAME", help="these alone, expensive ones too")
    parser.add_argument("--expensive", action="store_true", help="also wheels, rails and maps: hours of processor time")
    parser.add_build_and_output()
    options = parser.parse_args()
    options.scenes = [os.path.basename(name).removesuffix(".prm") for name in options.scenes]
    unknown = set(options.scenes) - {scene.file for scene in SCENES}
    if unknown:
        parser.refuse(f"there is no scene {', '.join(sorted(unknown))}; there are {', '.join(scene.file for scene in SCENES)}")
    parser.check_build(options.build)
    parser.check_output(options.output)
    summary, runs = [], []
    with tempfile.TemporaryDirectory(prefix="smallest_") as cache:
        bench = program.Bench(os.path.abspath(options.build), False, 1, cache)
        for scene in SCENES:
            if scene.file not in options.scenes if options.scenes else scene.expensive and not options.expensive:
                continue
            for knob in scene.knobs:
                rows = study(bench, scene, knob)
                runs += [(scene.file, knob.name, *row) for row in rows]
                smallest, wrong, ratio, said = verdict(scene, knob, rows)
                summary.append((scene.file, scene.quantity, knob.name, knob.shipped, smallest, "" if wrong is None else f"{wrong:.2e}",
                                "" if ratio is None else f"{ratio:.2f}", said))
                print(" | ".join(summary[-1]), flush=True)
                for label, wrong, cost, sentence in rows:
                    print(f"    {label}: " + (sentence if wrong is None else f"error {wrong:.2e}, {cost:.2f} s"), flush=True)
            for name, head, table in (("smallest_models", ("scene", "quantity", "knob", "shipped", "smallest_within_1_percent", "error", "cost_over_shipped", "file"), summary),
                                      ("smallest_models_runs", ("scene", "knob", "value", "error", "seconds", "refusal"), runs)):
                with open(os.path.join(options.output, name + ".csv"), "w", newline="", encoding="utf-8") as file:
                    csv.writer(file, lineterminator="\n").writerows([head, *table])


if __name__ == "__main__":
    main()

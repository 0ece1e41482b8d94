#!/usr/bin/python3
"""Error against cost of every method that the program lets a file choose, in one report; see doc/benchmarks.md.

  run.py [--quick] [--only STUDY ...] [--output DIR]     measures and writes DIR/report.html
  run.py --list                                          studies and the members on their pictures; exit 1 if one is on none

Exit: 0 done; 1 wrong use; 2 a study failed, or --quick found something slower or less exact than the baseline."""
import os
import shutil
import sys
import tempfile
import time

import baseline
import members
import other_programs
import program
import report
from studies import ALL


def arguments():
    parser = program.Parser(__doc__)
    parser.add_argument("--quick", action="store_true", help="the cheap studies in five minutes, compared with the baseline")
    parser.add_build_and_output()
    parser.add_argument("--only", nargs="+", metavar="STUDY", default=[],
                        help="these studies alone; peers: the comparisons with other programs")
    parser.add_argument("--repetitions", type=int, metavar="N", help="of each run; default 3 with --quick, else 5")
    parser.add_argument("--baseline", default=baseline.FILE, metavar="FILE", help="stored ratios; default: baseline.csv")
    parser.add_argument("--write-baseline", action="store_true", help="rewrite the baseline's rows of the studies that run; with --quick")
    parser.add_argument("--pictures", metavar="DIR", help="copy the pictures there as benchmark_STUDY.png (doc/pictures)")
    parser.add_argument("--list", action="store_true", help="list studies and members, run nothing")
    options = parser.parse_args()
    if options.repetitions is not None and options.repetitions < 1:
        parser.error(f"--repetitions {options.repetitions}: at least one run is needed")
    for folder in (options.pictures, os.path.dirname(os.path.abspath(options.baseline)) if options.write_baseline else None):
        if folder and not os.path.isdir(folder):
            parser.error(f"there is no folder {folder}: make it first")
    # a full study has more and harder cases under the same labels: its errors are not those of the baseline
    if not options.quick and (options.write_baseline or options.baseline != baseline.FILE):
        parser.error("the baseline is one of the cheap studies: add --quick")
    unknown = set(options.only) - {study.name for study in ALL} - {"peers"}
    if unknown:
        parser.refuse(f"there is no study {', '.join(sorted(unknown))}; there are {', '.join(study.name for study in ALL)}, peers")
    parser.check_build(options.build)
    if not options.list:
        parser.check_output(options.output)
    return options


def list_studies(bench):
    """Every study with its members; what is on no picture ends with 1."""
    for study in ALL:
        print(f"{study.name}{'' if study.quick else ' (full only)'}: {study.title}")
        for entry, choices in study.choices.items():
            print(f"    {entry} = {', '.join(choices)}")
    missing = members.without_picture(bench.parameters(), ALL)
    for sentence in missing:
        print(f"MISSING: {sentence}")
    return 1 if missing else 0


def main():
    options = arguments()
    with tempfile.TemporaryDirectory(prefix="benchmarks_") as cache:
        bench = program.Bench(os.path.abspath(options.build), options.quick, options.repetitions or (3 if options.quick else 5), cache)
        if options.list:
            return list_studies(bench)
        compares = options.quick and not options.write_baseline
        # also one that is rewritten must be readable, as rows of other studies stay
        kept = baseline.read(options.baseline) if compares or (options.write_baseline and os.path.exists(options.baseline)) else []
        studies = [study for study in ALL if study.name in options.only or
                   (not options.only and (study.quick or not options.quick))]
        head, measured, failures, comparison, said = report.environment(bench), [], {}, [], []
        for study in studies:
            begin = time.perf_counter()
            try:
                study.run(bench)
            except Exception as error:  # the other studies go on; it ends with 2
                failures[study.name] = str(error).strip()
                print(f"{study.name}: FAILED: {failures[study.name]}", flush=True)
                continue
            measured.append(study)
            report.draw(study, os.path.join(options.output, study.name + ".png"))
            report.write_table(study, os.path.join(options.output, study.name + ".csv"))
            if options.pictures:
                shutil.copy(os.path.join(options.output, study.name + ".png"),
                            os.path.join(options.pictures, f"benchmark_{study.name}.png"))
            off = study.defaults_off_front()
            print(f"{study.name}: {len(study.points)} points in {time.perf_counter() - begin:.0f} s, default "
                  + (f"not on the front: {', '.join(point.label for point in off)}" if off else "on the front"), flush=True)
            report.write(measured, failures, [], [], head, options.output)
        sections = ""
        if not options.only or "peers" in options.only:
            sections, failed = other_programs.compare(bench, options.output)
            failures.update(failed)
        if options.write_baseline:
            baseline.write(measured, options.baseline)
        elif compares:
            comparison = baseline.worse(measured, kept)
            said = baseline.verdict(measured, kept, comparison)
            print("\n".join([f"WORSE: {sentence}" for sentence in comparison] + said))
        report.write(measured, failures, comparison, said, head, options.output, sections)
        print(f"{options.output}/report.html")
    return 2 if failures or comparison else 0


if __name__ == "__main__":
    sys.exit(main())

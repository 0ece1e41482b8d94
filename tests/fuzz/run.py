#!/usr/bin/env python3
"""Fuzz the readers of files: build the targets, run each for some minutes, say what came of it.

    tests/fuzz/run.py [--minutes 15] [--jobs 2] [--output FOLDER] [READER ...]

Needs clang with its runtime (Debian: clang, libclang-rt-dev) and the library as gcc built it (build/libvibrocontact_core.a).
Starts from tests/fuzz/corpus; inputs that a run adds and those that end a reader stay in the output folder, by reader.
One that ends a reader is a finding: mend the reader and put the input into the corpus, which ctest replays.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
READERS = ["parameter_file", "gmsh", "inp", "csv", "uff", "outline", "matrices", "road", "reduction_cache", "contact_problem",
           "checkpoint"]
# a reader that takes longer for one input, or more memory, is at fault; bytes of an input at most
LIMITS = ["-timeout=20", "-rss_limit_mb=2000", "-malloc_limit_mb=1000", "-max_len=16384"]
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OPENBLAS_NUM_THREADS="1",
                   OMP_NUM_THREADS="1", UBSAN_OPTIONS="print_stacktrace=1", ASAN_OPTIONS="detect_stack_use_after_return=0")


def build():
    """Configure and build the targets in build-fuzz; returns that folder."""
    folder = ROOT / "build-fuzz"
    subprocess.run(["cmake", "-G", "Ninja", "-S", HERE, "-B", folder], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder], check=True)
    return folder


def fuzz(reader, program, output, minutes):
    """Run one target, again from where it was whenever an input ends it; returns what stands in its row of the table."""
    found, crashes = output / reader, output / reader / "crashes"
    (found / "corpus").mkdir(parents=True, exist_ok=True)
    crashes.mkdir(exist_ok=True)
    end, executions, edges, features, ends = time.time() + 60 * minutes, 0, 0, 0, {}
    with open(found / "log.txt", "w") as log:
        while time.time() < end - 1 and sum(ends.values()) < 200:
            command = [program, *LIMITS, f"-max_total_time={int(end - time.time())}", f"-artifact_prefix={crashes}/",
                       "-print_final_stats=1", found / "corpus", HERE / "corpus" / reader]
            process = subprocess.Popen(["nice", "-n", "19", *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                       text=True, errors="replace", env=ENVIRONMENT)
            text = process.stderr.read()
            process.wait()
            shutil.rmtree(f"/dev/shm/vibrocontact_readers_{process.pid}", ignore_errors=True)
            log.write(text)
            log.flush()
            executions += max([int(n) for n in re.findall(r"^#(\d+)\s", text, re.M)] +
                              [int(n) for n in re.findall(r"number_of_executed_units: (\d+)", text)], default=0)
            edges = max([edges] + [int(n) for n in re.findall(r"cov: (\d+)", text)])
            features = max([features] + [int(n) for n in re.findall(r"ft: (\d+)", text)])
            if process.returncode != 0:
                said = re.search(r"(SUMMARY: .*|what\(\):.*)", text)
                key = said.group(1)[:150] if said else f"exit code {process.returncode}"
                ends[key] = ends.get(key, 0) + 1
    return {"reader": reader, "executions": executions, "edges": edges, "features": features, "ends": ends}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=15, help="per reader")
    parser.add_argument("--jobs", type=int, default=2, help="readers at a time")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("results/fuzz"))
    parser.add_argument("readers", nargs="*", metavar="READER", help="of " + ", ".join(READERS) + "; default: all")
    options = parser.parse_args()
    for reader in options.readers:
        if reader not in READERS:
            parser.error(f"there is no reader {reader}; there are {', '.join(READERS)}")
    folder = build()
    output = options.output.resolve()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda reader: fuzz(reader, folder / f"fuzz_{reader}", output, options.minutes),
                             options.readers or READERS))
    lines = [f"| reader | executions in {options.minutes:g} min | edges | edges and counts | inputs that ended it |",
             "|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['reader']} | {row['executions']:,} | {row['edges']:,} | {row['features']:,} | {sum(row['ends'].values())} |")
    for row in rows:
        for said, count in row["ends"].items():
            lines.append(f"\n{row['reader']}, {count} times: {said}")
    text = "\n".join(lines) + "\n"
    (output / "table.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()

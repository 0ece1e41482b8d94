"""What the comparisons with other programs share: options, timed runs, tables, skipping what is not installed.

Times are processor seconds of a whole process and all it starts, with one thread each: they hardly change with other work on the machine.
"""
import csv
import json
import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
sys.dont_write_bytecode = True
from program import ENVIRONMENT, ROOT, Bench, Parser, processor_seconds  # noqa: E402

EXAMPLES = os.path.join(ROOT, "parameter_files", "examples")
SKIPPED = 77


def options(text):
    """Options of a comparison: --build, --quick, --output; `bench` runs the program."""
    parser = Parser(text)
    parser.add_argument("--quick", action="store_true", help="small sizes only")
    parser.add_build_and_output()
    chosen = parser.parse_args()
    parser.check_build(chosen.build)
    parser.check_output(chosen.output)
    chosen.bench = Bench(os.path.abspath(chosen.build), chosen.quick, 1, "")
    if ENVIRONMENT.get("OPENBLAS_CORETYPE") and "OPENBLAS_CORETYPE" not in os.environ:
        # OpenBLAS of this process, which a peer may use as well, asks for it when it is loaded
        os.execve(sys.executable, [sys.executable, "-B", *sys.argv], ENVIRONMENT)
    return chosen


def skip(peer, packages):
    """Ends a comparison with a peer that is not installed."""
    print(f"{peer} is not installed (Debian: apt-get install {packages}): nothing compared")
    sys.exit(SKIPPED)


def run_ours(chosen, file, folder, **entries):
    """Runs a parameter file; results.json's analyses and processor seconds. Entries by path, __ for / and _ for a space; results in
    folder/ours."""
    output = os.path.join(folder, "ours")
    command = [chosen.bench.path, os.path.join(folder, file), "--quiet", "--output", output]
    for path, value in {"Output__Figures": "false", "Output__Fields": "false", "Output__Cache_directory": "", **entries}.items():
        command += ["--set", f"{path.replace('__', '/').replace('_', ' ')}={value}"]
    seconds, _ = processor_seconds(command, folder)
    with open(os.path.join(output, "results.json"), encoding="utf-8") as results:
        return json.load(results)["analyses"], seconds


def least_seconds(work, repetitions=3, enough=5.):
    """Least processor seconds of a call in this process and its last result; not repeated once `enough` seconds are gone."""
    least, total = float("inf"), 0.
    for _ in range(repetitions):
        begin = time.process_time()
        result = work()
        seconds = time.process_time() - begin
        least, total = min(least, seconds), total + seconds
        if total > enough:
            break
    return least, result


def write_table(output, name, title, columns, rows, show=True):
    """Writes peer_NAME.csv below a comment line and, if shown, prints the rows as a table."""
    with open(os.path.join(output, f"peer_{name}.csv"), "w", newline="", encoding="utf-8") as file:
        file.write(f"# {title}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([f"{value:.10g}" if isinstance(value, float) else value for value in row] for row in rows)
    if not show:
        return
    texts = [list(columns)] + [[f"{value:.4g}" if isinstance(value, float) else str(value) for value in row] for row in rows]
    widths = [max(len(row[k]) for row in texts) for k in range(len(columns))]
    print(title)
    for row in texts:
        print("  " + "  ".join(text.rjust(width) for text, width in zip(row, widths)))
    print(flush=True)


def require(holds, sentence):
    """Ends the comparison if an answer is not what it has to be."""
    if not holds:
        sys.exit("FAILED: " + sentence)

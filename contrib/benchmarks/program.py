"""Runs of the program and of the benchmark executables, and what they cost."""
import argparse
import csv
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# one BLAS thread per rank; mpirun also as root and with more ranks than cores
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def take_kernels_of(path):
    """Other programs get the kernels of OpenBLAS that ours has found: versions that do not know a processor take slow ones."""
    said = subprocess.run([path, "--version"], text=True, stdout=subprocess.PIPE, env=ENVIRONMENT).stdout
    found = re.search(r"kernels (\S+)$", said, re.MULTILINE)
    if found:
        ENVIRONMENT["OPENBLAS_CORETYPE"] = found[1]


class Parser(argparse.ArgumentParser):
    """Options of a script with its text as help. Wrong options end with 1, as all wrong use: 2 says that something failed."""

    def __init__(self, text):
        super().__init__(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        self.refuse(f"{message}; see {self.prog} --help")

    def refuse(self, sentence):
        self.exit(1, f"{self.prog}: {sentence}\n")

    def add_build_and_output(self):
        """Build tree and folder of results; check_build and check_output say what is wrong with them."""
        self.add_argument("--build", default=os.path.join(ROOT, "build"), metavar="DIR", help="build tree; default: build")
        self.add_argument("--output", default=os.path.join("results", "benchmarks"), metavar="DIR", help="folder of results; default: %(default)s")

    def check_build(self, build):
        """Refuses a build tree without a program that lists its entries."""
        path = os.path.join(build, "vibrocontact")
        if not (os.path.isfile(path) and os.access(path, os.X_OK)):
            self.refuse(f"there is no program {path} that can be executed: build it, or name its build tree with --build")
        try:
            done = subprocess.run([path, "--parameters"], text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ENVIRONMENT)
            said, works = done.stdout, done.returncode == 0 and "set Analyses" in done.stdout
        except OSError as error:
            said, works = error.strerror, False
        if not works:
            last = (said.strip().splitlines() or ["no word"])[-1]
            self.refuse(f"{path} --parameters does not list the entries ({last}): build it anew, or name its build tree with --build")

    def check_output(self, folder):
        """Makes the folder of results; refuses one that cannot be made or written to."""
        try:
            os.makedirs(folder, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                pass
        except OSError as error:
            self.refuse(f"cannot write to --output {folder}: {error.strerror}; name a folder")


@dataclass
class Runs:
    """Repeated runs of one file: processor seconds (user and system, all ranks) and seconds of the clock of each,
    results.json of each, and what `read` made of the folder of each."""
    processor: list
    clock: list
    results: list
    read: list

    def analysis(self, name, run=-1):
        """Object of an analysis in results.json of a run, by default of the last."""
        return self.results[run]["analyses"][name]


def read_json(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def read_table(name):
    """Rows of a table of the program as dictionaries."""
    with open(name, newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def processor_seconds(command, folder=None):
    """Runs a command; processor seconds of it and of all it started, seconds of the clock. A failure is an error with its
    last lines."""
    begin = time.perf_counter()
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen(command, stdout=said, stderr=said, stdin=subprocess.DEVNULL, env=ENVIRONMENT, cwd=folder)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        clock = time.perf_counter() - begin
        if child.returncode != 0:
            said.seek(0)
            raise RuntimeError(f"{' '.join(command)} ended with {child.returncode}: {said.read()[-2000:]}")
    return usage.ru_utime + usage.ru_stime, clock


class Bench:
    """What a study measures with.

    quick        take the small cases
    repetitions  of each run
    cache        folder of reductions, made once per report
    """

    def __init__(self, build, quick, repetitions, cache):
        self.build, self.quick, self.repetitions, self.cache = build, quick, repetitions, cache
        self.path = os.path.join(build, "vibrocontact")
        take_kernels_of(self.path)

    def run(self, file, settings=None, ranks=1, repetitions=None, cached=False, read=None):
        """Repeated runs of a parameter file (relative to the root of the sources) with entries set; cached: with the
        report's cache of reductions, else without any; read: function of the folder of results."""
        entries = {"Output/Figures": "false", "Output/Fields": "false", "Output/Cache directory": self.cache if cached else ""}
        entries.update(settings or {})
        runs = Runs([], [], [], [])
        for _ in range(repetitions or self.repetitions):
            with tempfile.TemporaryDirectory() as folder:
                command = [] if ranks == 1 else ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]
                command += [self.path, os.path.join(ROOT, file), "--quiet", "--output", folder]
                for entry, value in entries.items():
                    command += ["--set", f"{entry}={value if isinstance(value, str) else repr(value)}"]
                processor, clock = processor_seconds(command)
                runs.processor.append(processor)
                runs.clock.append(clock)
                runs.results.append(read_json(os.path.join(folder, "results.json")))
                if read:
                    runs.read.append(read(folder))
        return runs

    def parameters(self):
        """What --parameters prints."""
        return subprocess.run([self.path, "--parameters"], check=True, text=True, stdout=subprocess.PIPE, env=ENVIRONMENT).stdout

    def executable(self, name, *arguments):
        """Lines that a benchmark executable of tests/benchmarks prints, as lists of cells; it is built if the build tree can."""
        path = os.path.join(self.build, "tests", name)
        if os.path.exists(os.path.join(self.build, "build.ninja")) and shutil.which("ninja"):
            subprocess.run(["ninja", "-C", self.build, name], check=True, stdout=subprocess.DEVNULL)
        elif not os.path.exists(path):
            raise RuntimeError(f"there is no {path}: build it (ninja -C {self.build} {name})")
        said = subprocess.run([path, *map(str, arguments)], check=True, text=True, stdout=subprocess.PIPE, env=ENVIRONMENT)
        return [line.split(",") for line in said.stdout.splitlines() if line and not line.startswith("#")]

#!/usr/bin/env python3
"""sweeps.py PROGRAM MPIRUN PARAMETER_FILES: an interrupted sweep equals an uninterrupted one.

A sweep of transients and one of stability are stopped by SIGTERM, or killed, at random moments, resumed on one rank and on
two, and compared: tables digit for digit, sounds that grow bit for bit. Cases that were done are not computed again, one that was stopped goes on from
its checkpoint. A later end time goes on with all of them.
"""
import csv, os, random, signal, subprocess, sys, time

program, mpirun, files = sys.argv[1:4]
random.seed(2)
slider = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "program", "slider.prm")


def fail(text):
    sys.exit("FAILED: " + text)


def command_of(file, settings, case, ranks=1):
    words = ([mpirun, "-n", str(ranks)] if ranks > 1 else []) + [program, file, "--quiet", "--output", case]
    for setting in (*settings, "Output/Figures=false"):
        words += ["--set", setting]
    return words


def run(words):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def tables(folder):
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".csv"):
                path = os.path.join(place, name)
                found[os.path.relpath(path, folder)] = open(path).read()
            if name.endswith(".wav"):
                path = os.path.join(place, name)
                found[os.path.relpath(path, folder)] = open(path, "rb").read()
    return found


def kept_cases(folder):
    return sorted(name for _, _, names in os.walk(folder + "/sweep") for name in names if name.endswith(".case"))


def check(label, file, settings, end=0):
    """@param end exit code of a whole run"""
    done = run(command_of(file, settings, label))
    if done.returncode != end:
        fail(f"{label} does not run: {done.stderr}")
    whole = tables(label)
    n_stopped = n_kept = 0
    for attempt, (stop, ranks) in enumerate([(signal.SIGTERM, 1), (signal.SIGTERM, 2), (signal.SIGKILL, 1),
                                             (signal.SIGINT, 1)]):
        case = f"{label}_{attempt}"
        process = subprocess.Popen(command_of(file, settings, case), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        enough = random.randint(1, 3)
        while process.poll() is None and len(kept_cases(case)) < enough:
            time.sleep(0.002)
        time.sleep(random.uniform(0, 0.01))
        process.send_signal(stop)
        process.wait()
        kept = kept_cases(case)
        if stop != signal.SIGKILL and process.returncode not in (end, 128 + stop):
            fail(f"{label}: exit code {process.returncode} after {stop}")
        n_stopped += process.returncode != end
        n_kept += len(kept)
        done = run(command_of(file, settings, case, ranks) + ["--resume"])
        if done.returncode != end:
            fail(f"{label} does not resume after {stop}: {done.stderr}")
        if tables(case) != whole:
            fail(f"{label} differs after it was interrupted by {stop}, {len(kept)} cases were kept")
    if n_stopped == 0 or n_kept == 0:
        fail(f"{label} was interrupted {n_stopped} times, {n_kept} cases were kept")
    print(label, f"interrupted {n_stopped} times, {n_kept} cases were kept")


bar = f"{files}/examples/bouncing_bar.prm"
sweep = ["Transient/Sweep/Entry=Transient/Initial velocity", "Transient/Sweep/Range=-10, -4, 1",
         "Transient/Checkpoint interval=1e-9", "Transient/Signals/Table=true",
         "Transient/Signals/Probes=top: bar 0 0 10 along z", "Transient/Signals/Sound full scale=20"]
check("bar", bar, sweep + ["Transient/End time=0.8"])
# the last cases are not in full sliding
check("slider", slider, ["Analyses=stability", "Stability/Sweep/Entry=Rolling/Lateral creepage",
                         "Stability/Sweep/Range=-0.06, -0.02, 0.001", "Output/Cache directory=cache"], end=2)


def without_estimate(folder):
    """The estimate of an error sees where the march was cut."""
    found = tables(folder)
    rows = list(csv.DictReader(line for line in found.pop("transient_sweep.csv").splitlines() if not line.startswith("#")))
    return found, [{k: v for k, v in row.items() if k != "estimated_error"} for row in rows]


# a later end
done = run(command_of(bar, sweep + ["Transient/End time=0.9"], "bar", 2) + ["--resume"])
if done.returncode != 0:
    fail("the sweep does not go on to a later end: " + done.stderr)
run(command_of(bar, sweep + ["Transient/End time=0.9"], "bar_later"))
if without_estimate("bar") != without_estimate("bar_later"):
    fail("a sweep that goes on to a later end differs")

#!/usr/bin/env python3
"""sweeps.py PROGRAM MPIRUN PARAMETER_FILES: a sweep of each analysis that takes one.

Each case has the results and files of a run of its own with the entry at its value, and two ranks give the same as one:
everything but times, digit for digit. A case that fails is marked, the others go on, exit code 2; if all fail, or an entry
does not take a value, the input is wrong. --resume of a run that is done leaves all as it was.
"""
import csv, json, math, os, sys, time

from many_runs import ManyRuns

program, mpirun, files = sys.argv[1:4]
examples = files + "/examples"
tests = os.path.dirname(os.path.abspath(__file__))
runs = ManyRuns(program, mpirun)


def fail(text):
    sys.exit("FAILED: " + text)


def run(name, file, *settings, ranks=1, code=0, options=()):
    arguments = [file, "--quiet", "--output", name, *options]
    for one in settings:
        arguments += ["--set", one]
    done = runs.run(arguments, ranks)
    if done.returncode != code:
        fail(f"{name}: exit code {done.returncode} for {code}: {done.stderr}")
    return done.stderr


def without_times(node):
    if isinstance(node, dict):
        return {k: without_times(v) for k, v in node.items() if "second" not in k}
    return [without_times(one) for one in node] if isinstance(node, list) else node


def results(folder):
    return json.load(open(folder + "/results.json"))


def analyses(folder):
    return without_times(results(folder)["analyses"])


def rows(name):
    return list(csv.DictReader(line for line in open(name) if not line.startswith("#")))


# two of them have times
def tables(folder):
    return {name: open(f"{folder}/{name}").read() for name in sorted(os.listdir(folder))
            if name.endswith(".csv") and name not in ("rolling.csv", "periodic_errors.csv")}


def check(label, key, file, entry, values, *settings, second=()):
    """All cases of a sweep; `second`: entry and values."""
    begin = time.time()
    section = {"transient": "Transient", "modal_convolution": "Modal convolution", "periodic": "Periodic",
               "quasi_static_rolling": "Rolling"}[key]
    sweep = [f"{section}/Sweep/Entry={entry}", f"{section}/Sweep/Values={', '.join(values)}"]
    cases = [(one,) for one in values]
    if second:
        sweep += [f"{section}/Sweep/Second entry={second[0]}", f"{section}/Sweep/Second values={', '.join(second[1:])}"]
        cases = [(one, other) for one in values for other in second[1:]]
    settings = (*settings, "Output/Figures=false")
    run(label, file, *settings, *sweep)
    run(label + "_two", file, *settings, *sweep, ranks=2)
    whole = analyses(label)[key + "_sweep"]
    if analyses(label + "_two") != analyses(label):
        fail(f"{label}: two ranks give other results")
    if tables(label + "_two") != tables(label) or key + "_sweep.csv" not in tables(label):
        fail(f"{label}: two ranks give other tables")
    if len(whole["cases"]) != len(cases) or len(rows(f"{label}/{key}_sweep.csv")) != len(cases):
        fail(f"{label}: {len(cases)} cases are asked for")
    for k, (case, asked) in enumerate(zip(whole["cases"], cases)):
        own = f"{label}_own_{k}"
        entries = [f"{entry}={asked[0]}"] + ([f"{second[0]}={asked[1]}"] if second else [])
        run(own, file, *settings, *entries)
        for name, found in analyses(own).items():
            if case.get(name) != found:
                fail(f"{label}, {asked}: {name} differs from a run of its own")
        if case["folder"] != f"sweep/{key}/{k}" or not tables(own):
            fail(f"{label}, {asked}: no tables")
        for folder in (label, label + "_two"):
            if tables(f"{folder}/{case['folder']}") != tables(own):
                fail(f"{label}, {asked}: tables differ from those of a run of its own")
        if case["status"] != "converged" or [str(v) for v in case["swept"].values()] != [str(float(v)) for v in asked]:
            fail(f"{label}, {asked}: {case['status']} at {case['swept']}")
    if any(name.endswith(".case") for name in os.listdir(f"{label}/sweep/{key}")):
        fail(f"{label}: kept cases are left behind")
    before = analyses(label)
    run(label, file, *settings, *sweep, options=["--resume"])
    if analyses(label) != before:
        fail(f"{label}: resumed at its end it differs")
    print(label, f"{time.time() - begin:.1f} s")


check("bar", "transient", f"{examples}/bouncing_bar.prm", "Transient/Initial velocity", ["-10", "-9", "-8"],
      "Transient/Signals/Table=true", "Transient/End time=0.8")
check("probe", "transient", tests + "/slider.prm", "Rolling/Lateral creepage", ["-0.05", "-0.02"],
      "Analyses=transient", "Transient/Time step=1e-5", "Transient/End time=1e-3", "Transient/Signals/Table=true",
      "Transient/Signals/Probes=side: slider 0.03 0 0.02 along y", second=("slider/Modes/Damping factor", "1", "3"))
check("sine", "modal_convolution", f"{examples}/oscillator_on_sine.prm", "Road/Speed", ["0.1", "0.2", "0.3"],
      "Modal convolution/End time=0.5")
oscillator = os.path.join(os.path.dirname(tests), "periodic", "oscillator_stop.prm.in")
check("oscillator", "periodic", oscillator, "Periodic/Gap", ["1e-4", "2e-4"], second=("Periodic/Force", "300", "200"))
check("curve", "periodic", oscillator, "Periodic/Force", ["300", "200"], "Periodic/Number of functions=31",
      "Periodic/Reference=false", "Periodic/Continuation/Parameter=frequency", "Periodic/Continuation/First value=80",
      "Periodic/Continuation/Last value=130")
check("disc", "quasi_static_rolling", f"{examples}/half_space_rolling.prm", "Rolling/Normal force", ["3e4", "6e4", "9e4"])

# the mass follows the sine while spring and inertia need less than its weight
run("speeds", f"{examples}/speeds_over_a_sine.prm", "Output/Figures=false", "Modal convolution/End time=0.2", ranks=2)
for row in rows("speeds/modal_convolution_sweep.csv"):
    omega, height = 2 * math.pi * float(row["speed_m_s"]) / 0.025, float(row["expression_m"].split("*")[0])
    if (height * abs(4e5 - omega**2) < 9.81) != (float(row["closed_points_mean"]) == 1):
        fail(f"the mass at {row['speed_m_s']} m/s over {height} m: {row['closed_points_mean']} closed")

# one case reaches the end of its grid
half_space = (f"{examples}/half_space_rolling.prm", "Output/Figures=false", "Rolling/Sweep/Entry=Rolling/Normal force")
run("failed", *half_space, "Rolling/Sweep/Values=6e4, 9e9, 3e4", ranks=2, code=2)
status = [case["status"] for case in analyses("failed")["quasi_static_rolling_sweep"]["cases"]]
if status != ["converged", "failed", "converged"]:
    fail(f"a case that fails: {status}")
if [row["utilisation"] != "" for row in rows("failed/quasi_static_rolling_sweep.csv")] != [True, False, True]:
    fail("the table of a sweep with a case that fails")
if "normal_force_N 9e+09" not in results("failed")["not_converged"][0]["message"]:
    fail("the case that fails is not named: " + str(results("failed")["not_converged"]))
if "none of the cases has a result" not in run("none", *half_space, "Rolling/Sweep/Values=8e9, 9e9", ranks=2, code=1):
    fail("a sweep without any result")
if os.path.exists("none/results.json"):
    fail("a sweep without any result leaves results")
if "-5" not in run("wrong", *half_space, "Rolling/Sweep/Values=6e4, -5", code=1):
    fail("a value that the entry does not take")

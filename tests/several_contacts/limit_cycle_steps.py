#!/usr/bin/env python3
"""limit_cycle_steps.py PROGRAM MPIRUN PARAMETER_FILES: a limit cycle whose steps are too long is no answer.

The block on two rails (several_contacts.prm) has a cycle at 84 kHz whose forces sticking makes small. Sixty steps of a period have a third
less of them than harmonic balance, which has no steps. The error that the steps are said to have is near that of harmonic balance.
"""
import json, os, sys
from scene import Check, entries, run, section

check = Check()
shipped = open(os.path.join(sys.argv[3], "examples", "several_contacts.prm")).read()


def cycle_by(step):
    taken = section("Limit cycle", entries(Time_step=step, Multipliers=0, Roots=84000, Harmonics=20))
    found, folder = run(f"by_{step}", shipped + "\n" + taken, 1, "--set", "Analyses=limit cycle", may_doubt=True)
    with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
        failures = [one["message"] for one in json.load(file).get("not_converged", [])]
    one = found["limit_cycle"][0]
    off = 1 - 1 / (1 + one["harmonic_balance"][0]["amplitude_difference"])
    print(f"{one['steps_per_period']} steps: {one['main_signal']} off by {off:.3f} from harmonic balance, estimated {one['estimated_error_amplitude']:.3f}; {failures}")
    return one, off, failures


for step, refused in ((2e-7, True), (5e-8, False), (2e-8, False)):
    one, off, failures = cycle_by(step)
    check.near("estimated error", one["estimated_error_amplitude"], off, 0.2)
    check.near("signal", one["main_signal"] == one["error_estimate"]["signal"], True, 1e-12)
    said = [failure for failure in failures if "are too long: from 120 in a period, in place of 60" in failure]
    check.near("refused", (len(failures), len(said)) == ((1, 1) if refused else (0, 0)), True, 1e-12)
check.end()

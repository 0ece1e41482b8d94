#!/usr/bin/env python3
"""quasi_static_loading.py PROGRAM MPIRUN PARAMETER_FILES: quasi-static loading against sums by hand, on one and two ranks.

A block of elements with two contacts of unequal friction is dragged until all of it slides, and back: each contact bears its
friction coefficient times its normal force, and a further way takes that force times the way. Two balls: a table of loads is the
lists it was made of, and a history that friction cannot carry ends with code 2 and what was found before.
"""
import json, subprocess

from scene import Check, entries, program, run, section, table

check = Check()


def patch(name, y, friction):
    return section(name, entries(Bodies="block, base", Origin=f"0, {y}, 0", Grid_spacing=2e-3, Half_length=10e-3,
                                 Half_width=2e-3, Friction_coefficient=friction))


way, mu = 2e-3, {"left": 0.1, "right": 0.4}
block = "\n".join([
    "set Bodies = block, base", "set Contacts = left, right", "set Analyses = quasi-static loading",
    section("block", "set Type = block",
            section("Block", entries(Length=0.03, Width=0.014, Height=0.008, Divisions_x=15, Divisions_y=7, Divisions_z=2,
                                     Contact_face="bottom", Held="top")),
            section("Material", entries(Young_modulus=1e10, Poisson_ratio=0.3))),
    section("base", "set Type = rigid", section("Rigid", entries(Radius_x=0.3, Radius_y=-0.2))),
    patch("left", -4e-3, mu["left"]), patch("right", 4e-3, mu["right"]),
    section("Loading", entries(Normal_force=5000, Displacement_x=f"0, 4e-5, {way}, {2 * way}, {3 * way}, {-way}", Steps="1, 3, 1, 1, 1, 2"))])
found = {ranks: run(f"block_{ranks}", block, ranks)[0]["quasi_static_loading"] for ranks in (1, 2)}
steps = found[1]["steps"]
assert len(steps) == 9 and steps[5]["stick_points"] == 0 and steps[0]["stick_points"] > 0
for at, sign in ((5, 1), (6, 1), (8, -1)):
    driven = 0
    for name, one in found[1]["contacts"].items():
        state = one["steps"][at]
        sideways = (state["tangential_force_N"][0]**2 + state["tangential_force_N"][1]**2)**0.5
        check.near(f"friction of {name}, step {at + 1}", sideways, mu[name] * state["normal_force_N"], 1e-5)
        driven -= state["tangential_force_N"][0]
    check.near(f"driving force, step {at + 1}", steps[at]["driving_force_N"][0], driven, 1e-9)
    check.near(f"its direction, step {at + 1}", sign * driven / abs(driven), 1, 1e-9)
check.near("normal force", steps[-1]["normal_force_N"], 5000, 1e-9)
check.near("taken by a further way", steps[6]["dissipated_J"], steps[6]["driving_force_N"][0] * way, 1e-6)
for at, (one, two) in enumerate(zip(steps, found[2]["steps"])):
    for name in ("approach_m", "dissipated_sum_J", "stored_J", "work_sum_J"):
        check.near(f"{name} on two ranks, step {at + 1}", two[name], one[name], 1e-9, abs(steps[-1][name]))
    check.near(f"force on two ranks, step {at + 1}", two["driving_force_N"][0], one["driving_force_N"][0], 1e-9, 1500)

balls = "\n".join(
    ["set Bodies = upper, lower", "set Analyses = quasi-static loading"]
    + [section(name, "set Type = half-space", section("Half-space", entries(Radius_x=0.1, Radius_y=0.1))) for name in ("upper", "lower")]
    + [section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=1.5e-4, Half_length=1e-3, Half_width=1e-3))])
listed = run("lists", balls + "\n" + section("Loading", entries(Normal_force="1000, 1000, 800", Force_x="0, 200, -100",
                                                                Displacement_y="0, 0, 2e-7", Steps="1, 2, 2")))[0]
with open("loads.csv", "w") as file:
    file.write("normal_force_N,force_x_N,displacement_y_m\n1000,0,0\n1000,100,0\n1000,200,0\n900,50,1e-7\n800,-100,2e-7\n")
from_table = run("table", balls + "\n" + section("Loading", entries(Table="loads.csv")))[0]
for one, two in zip(listed["quasi_static_loading"]["steps"], from_table["quasi_static_loading"]["steps"]):
    for d in range(2):
        check.near("displacement by a table", two["displacement_m"][d], one["displacement_m"][d], 1e-12, 1e-6)
        check.near("force by a table", two["driving_force_N"][d], one["driving_force_N"][d], 1e-12, 200)

# what friction bears under a given approach is found on the way
text = balls + "\n" + section("Loading", entries(Hub_displacement=1e-5, Force_x="0, 200, 5000", Steps="1, 2, 3"))
ended, folder = run("too_much", text, may_doubt=True)
kept = ended["quasi_static_loading"]
results = json.load(open("too_much/results.json"))
assert results["status"] == "not converged" and results["complete"], results["status"]
assert kept["status"] == "not converged" and len(kept["steps"]) == len(table(folder, "loading.csv")) == 3, kept
assert kept["steps_asked"] == 6
done = subprocess.run([program, "too_much.prm", "--quiet", "--output", "again"], capture_output=True, text=True)
assert done.returncode == 2 and "all points slip" in done.stdout + done.stderr, (done.returncode, done.stdout, done.stderr)
check.end()

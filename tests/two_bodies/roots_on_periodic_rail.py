#!/usr/bin/env python3
"""roots_on_periodic_rail.py PROGRAM MPIRUN PARAMETER_FILES: roots beside a rail without ends, their derivatives and how they are followed.

Derivatives by left and right vectors are the differences of roots that complete solutions find by themselves, each from its own
poles; draws scatter as the first order says; a row of followed roots is the complete one. Two ranks give the same.
"""
import math

from scene import Check, entries, run, section, table

check = Check()
nominal = {"Contact/Friction coefficient": 0.3, "Rolling/Hub displacement": 0.2e-3, "wheel/Modes/Damping factor": 1.,
           "rail/Material/Loss factor": 0.02, "rail/Rail/Pad stiffness z": 180e6}


def scene(name, *stability, ranks=1):
    return run(name, "\n".join([
        "set Bodies = wheel, rail", "set Analyses = stability",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Harmonics=20)),
                section("Modes", entries(Upper_frequency=1200))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Element_degree=1, Fitted_up_to=1300, Pole_pairs=16))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2.5e-3, Lateral_position=-10e-3)),
        section("Rolling", entries(Hub_displacement=0.2e-3, Speed=10, Lateral_creepage=-0.01)),
        section("Stability", entries(Loss="hysteretic"), *stability)]), ranks, may_doubt=True)


def place(row):
    return complex(row["growth_1_s"], 2 * math.pi * row["frequency_Hz"])


asked = section("Derivatives", entries(Entries=", ".join(nominal), Standard_deviations="2e-3, 1e-6, 0.02, 2e-4, 1e6", Draws=2))
(one, folder), (two, folder_2) = scene("derivatives", asked), scene("derivatives_2", asked, ranks=2)
for a, b in zip(table(folder, "stability_derivatives.csv"), table(folder_2, "stability_derivatives.csv")):
    size = math.hypot(2 * math.pi * a["frequency_per_unit_Hz"], a["growth_per_unit_1_s"])
    text = f"growth of {a['root']} by {a['entry']}"
    check.near(text + " on two ranks", b["growth_per_unit_1_s"], a["growth_per_unit_1_s"], 1e-9, size)
    check.near(text, a["growth_per_unit_1_s"], a["growth_by_difference_1_s"], 1e-5, size)
for a, b in zip(table(folder, "stability_scatter.csv"), table(folder_2, "stability_scatter.csv")):
    check.near("scatter on two ranks", b["growth_deviation_1_s"], a["growth_deviation_1_s"], 1e-9)
    check.near("mean of draws on two ranks", b["mean_of_draws_1_s"], a["mean_of_draws_1_s"], 1e-9)

rows_of_derivatives = [row for row in table(folder, "stability_derivatives.csv") if row["growth_1_s"] > 0]
check.near("roots that grow", len(rows_of_derivatives) >= 2 * len(nominal), True, 1e-9)
for entry in "Contact/Friction coefficient", "rail/Rail/Pad stiffness z":
    h = 2e-3 * nominal[entry]
    _, folder_s = scene(entry.split("/")[-1].replace(" ", "_"), section("Sweep", entries(Entry=entry, Values=", ".join(
        repr(nominal[entry] + k * h) for k in (-2, -1, 1, 2)))))
    rows = table(folder_s, "stability.csv")
    cases = [[place(row) for row in rows if row["case"] == k] for k in sorted({row["case"] for row in rows})]
    check.near("cases", len(cases), 4, 1e-9)
    for row in rows_of_derivatives:
        if row["entry"] == entry:
            s = [min(all_of_case, key=lambda root: abs(root - place(row))) for all_of_case in cases]
            # of fourth order in the step
            difference = (s[0] - s[3] + 8 * (s[2] - s[1])) / (12 * h)
            derivative = complex(row["growth_per_unit_1_s"], 2 * math.pi * row["frequency_per_unit_Hz"])
            check.near(f"{row['root']} by {entry}", abs(derivative - difference), 0, 1e-5, abs(difference))

frictions = section("Sweep", entries(Entry="Contact/Friction coefficient", Range="0.1, 0.4, 0.03"))
(whole, folder_w), (row, folder_r), (row_2, folder_r2) = [
    scene(name, entries(Roots_of_a_sweep=roots), frictions, ranks=ranks)
    for name, roots, ranks in (("complete", "complete", 2), ("followed", "followed", 1), ("followed_2", "followed", 2))]
check.near("cases", row["stability"]["followed"]["cases"] + row["stability"]["followed"]["complete_cases"], 11, 1e-9)
check.near("most are followed", row["stability"]["followed"]["cases"] >= 7, True, 1e-9)
complete = {(one["case"], one["root"]): one for one in table(folder_w, "stability.csv")}
n = 0
for a, b in zip(table(folder_r, "stability.csv"), table(folder_r2, "stability.csv")):
    check.near("growth on two ranks", b["growth_1_s"], a["growth_1_s"], 1e-9, 2 * math.pi * a["frequency_Hz"])
    if a["growth_1_s"] > 0:
        same = complete[a["case"], a["root"]]
        check.near(f"growth of {a['root']} in case {a['case']}", a["growth_1_s"], same["growth_1_s"], 1e-6, 1)
        n += 1
check.near("as many roots grow", n, sum(one["growth_1_s"] > 0 for one in complete.values()), 1e-9)
check.near("roots grow", n > 15, True, 1e-9)
check.end()

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

# a bar of 70 by 150 mm in four cells
height = {-0.035: 0.1479513, 0: 0.15, 0.035: 0.1479513}
with open("bar.txt", "w", encoding="utf-8") as file:
    file.write("line 0 0 35 0 0 0 0 foot\nline 35 0 35 147.9513 0 0 0 surface\narc 35 147.9513 0 150 0 -150 300 crown\n")
with open("bar.msh", "w", encoding="utf-8") as file:
    file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "section"\n$EndPhysicalNames\n$Nodes\n9\n')
    file.writelines(f"{3 * j + i + 1} {y} {share * height[y]} 0\n" for j, share in enumerate((0, 0.5, 1)) for i, y in enumerate(height))
    file.write("$EndNodes\n$Elements\n4\n")
    file.writelines(f"{k + 1} 3 2 1 1 {n} {n + 1} {n + 4} {n + 3}\n" for k, n in enumerate((1, 2, 4, 5)))
    file.write("$EndElements\n")


def scene(name, *stability, ranks=1):
    return run(name, "\n".join([
        "set Bodies = wheel, rail", "set Analyses = stability",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Harmonics=20)),
                section("Modes", entries(Upper_frequency=1200))),
        section("rail", "set Type = rail", section("Material", entries(Loss_factor=0.02)),
                section("Rail", entries(Model="periodic", Section_mesh="bar.msh", Section_outline="bar.txt", Element_degree=1,
                                        Fitted_up_to=2000, Pole_pairs=16))),
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
for name in "stability_derivatives.csv", "stability_scatter.csv", "stability_draws.csv":
    check.near("rows of " + name, len(table(folder, name)) == len(table(folder_2, name)) > 0, True, 1e-9)
for a, b in zip(table(folder, "stability_scatter.csv"), table(folder_2, "stability_scatter.csv")):
    check.near("scatter on two ranks", b["growth_deviation_1_s"], a["growth_deviation_1_s"], 1e-9)
    check.near("mean of draws on two ranks", b["mean_of_draws_1_s"], a["mean_of_draws_1_s"], 1e-9)
    # what a draw adds beyond the first order is of second order in its entries
    derivatives = {row["entry"]: row["growth_per_unit_1_s"] for row in table(folder, "stability_derivatives.csv") if row["root"] == a["root"]}
    check.near("entries", len(derivatives), len(nominal), 1e-9)
    for draw in table(folder, "stability_draws.csv"):
        # commas would divide a column
        grown = next(value for key, value in draw.items() if key.startswith("growth_1_s") and key.split(" ", 1)[1] == a["root"].replace(",", ";"))
        moves = [derivatives[entry] * (draw[entry] - nominal[entry]) for entry in nominal]
        check.near(f"first order of a draw of {a['root']}", grown, a["growth_1_s"] + sum(moves), 0.05, sum(map(abs, moves)))

rows_of_derivatives = [row for row in table(folder, "stability_derivatives.csv") if row["growth_1_s"] > 0]
check.near("roots that grow", len(rows_of_derivatives) >= 2 * len(nominal), True, 1e-9)
for entry in "Contact/Friction coefficient", "rail/Rail/Pad stiffness z":
    # one rail takes as long as many frictions
    steps = (-2, -1, 1, 2) if entry.startswith("Contact") else (-1, 1)
    h = (2e-3 if len(steps) == 4 else 1e-3) * nominal[entry]
    _, folder_s = scene(entry.split("/")[-1].replace(" ", "_"), section("Sweep", entries(Entry=entry, Values=", ".join(
        repr(nominal[entry] + k * h) for k in steps))))
    rows = table(folder_s, "stability.csv")
    cases = [[place(row) for row in rows if row["case"] == k] for k in sorted({row["case"] for row in rows})]
    check.near("cases", len(cases), len(steps), 1e-9)
    for row in rows_of_derivatives:
        if row["entry"] == entry:
            s = [min(all_of_case, key=lambda root: abs(root - place(row))) for all_of_case in cases]
            # of fourth or second order in the step
            difference = (s[0] - s[3] + 8 * (s[2] - s[1])) / (12 * h) if len(s) == 4 else (s[1] - s[0]) / (2 * h)
            derivative = complex(row["growth_per_unit_1_s"], 2 * math.pi * row["frequency_per_unit_Hz"])
            check.near(f"{row['root']} by {entry}", abs(derivative - difference), 0, 1e-5, abs(difference))

def frictions(name, roots, ranks, **swept):
    return scene(name, entries(Roots_of_a_sweep=roots), section("Sweep", entries(Entry="Contact/Friction coefficient", **swept)), ranks=ranks)


(_, folder_w), (row, folder_r), (_, folder_r2) = [
    frictions("complete", "complete", 2, Values="0.16, 0.34"), frictions("followed", "followed", 1, Range="0.1, 0.4, 0.03"),
    frictions("followed_2", "followed", 2, Range="0.1, 0.4, 0.03")]
count = row["stability"]["followed"]
check.near("cases", count["cases"] + count["complete_cases"], 11, 1e-9)
check.near("most are followed", count["cases"] >= 7, True, 1e-9)
followed = table(folder_r, "stability.csv")
for a, b in zip(followed, table(folder_r2, "stability.csv")):
    check.near("growth on two ranks", b["growth_1_s"], a["growth_1_s"], 1e-9, 2 * math.pi * a["frequency_Hz"])
complete = [one for one in table(folder_w, "stability.csv") if one["growth_1_s"] > 0]
check.near("roots grow", len(complete) >= 4, True, 1e-9)
for one in complete:
    same = [other for other in followed if abs(other["friction_coefficient"] - one["friction_coefficient"]) < 1e-9]
    nearest = min(same, key=lambda other: abs(place(other) - place(one)))
    check.near(f"growth of {one['root']}", nearest["growth_1_s"], one["growth_1_s"], 1e-6, 1)
    check.near("as many grow", sum(other["growth_1_s"] > 0 for other in same),
               sum(other["friction_coefficient"] == one["friction_coefficient"] for other in complete), 1e-9)
check.end()

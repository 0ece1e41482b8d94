#!/usr/bin/env python3
"""glued_block.py PROGRAM MPIRUN PARAMETER_FILES: a ball on a block of two glued parts, the upper one of tetrahedra and the lower of coarser
hexahedra, against the same block in one piece: approach, largest pressure and the pressure of each point; one rank and two."""
from scene import Check, entries, run, section, table

side, height, cut = 0.03, 0.024, 0.016  # of the block, and where it is cut [m]
# corners of a cube in Abaqus' order; tetrahedra share its diagonal 0-6
cube = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
cells = {"C3D8": [range(8)], "C3D4": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}


def part(name, type_of_cells, n, n_high, low, high, first):
    """A deck's box of n x n x n_high cubes between two heights; sets NAME_bottom and NAME_top."""
    number = lambda i, j, k: first + i + (n + 1) * (j + (n + 1) * k)
    lines = ["*NODE"]
    for k in range(n_high + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                x, y, z = side * i / n - side / 2, side * j / n - side / 2, low + (high - low) * k / n_high
                lines.append(f"{number(i, j, k)}, {x}, {y}, {z}")
    lines.append(f"*ELEMENT, TYPE={type_of_cells}, ELSET=steel")
    count = first
    for k in range(n_high):
        for j in range(n):
            for i in range(n):
                for cell in cells[type_of_cells]:
                    nodes = [number(i + cube[c][0], j + cube[c][1], k + cube[c][2]) for c in cell]
                    lines.append(f"{count}, " + ", ".join(map(str, nodes)))
                    count += 1
    for label, k in (("bottom", 0), ("top", n_high)):
        lines.append(f"*NSET, NSET={name}_{label}")
        lines += [f"{number(i, j, k)}," for j in range(n + 1) for i in range(n + 1)]
    return "\n".join(lines) + "\n"


with open("whole.inp", "w") as deck:
    deck.write(part("whole", "C3D4", 12, 12, 0, height, 1))
with open("parts.inp", "w") as deck:
    deck.write(part("upper", "C3D4", 12, 4, cut, height, 1) + part("lower", "C3D8", 8, 5, 0, cut, 100001))


def text(file, contact, held, **more):
    mesh = section("Mesh", entries(File=file, Contact_point=f"0, 0, {height}", Contact_group=contact, Held_groups=held,
                                   Contact_cell_size=0, **more))
    return "\n".join([
        "set Bodies = ball, block", "set Analyses = quasi-static rolling",
        section("ball", "set Type = half-space", section("Half-space", entries(Radius_x=2, Radius_y=2))),
        section("block", "set Type = mesh", mesh),
        section("Contact", entries(Grid_spacing=1.25e-3, Half_length=7e-3, Half_width=7e-3)),
        section("Rolling", entries(Normal_force=8000, Longitudinal_creepage=0.01))])


check = Check()
whole, whole_folder = run("whole", text("whole.inp", "whole_top", "whole_bottom"))
one = whole["quasi_static_rolling"]["cases"][0]
answers = []
for ranks in (1, 2):
    parts, folder = run(f"parts_{ranks}", text("parts.inp", "upper_top", "lower_bottom", Split_into_tetrahedra="true",
                                               Glued="upper_bottom: lower_top"), ranks)
    two = parts["quasi_static_rolling"]["cases"][0]
    answers.append(two)
    for key in ("approach_m", "max_pressure_Pa"):
        print(f"{key}: glued {two[key]:.8g}, whole {one[key]:.8g}, ratio - 1: {two[key] / one[key] - 1:.2e}")
    check.near("approach", two["approach_m"], one["approach_m"], 1e-3)
    check.near("largest pressure", two["max_pressure_Pa"], one["max_pressure_Pa"], 1e-3)
    rows = list(zip(table(folder, "contact_patch_0.csv"), table(whole_folder, "contact_patch_0.csv")))
    worst = max(abs(p["pressure_Pa"] - q["pressure_Pa"]) for p, q in rows)
    print(f"pressures, over the largest: {worst / one['max_pressure_Pa']:.2e}")
    check.near("points in contact", sum(p["pressure_Pa"] > 0 for p, _ in rows), sum(q["pressure_Pa"] > 0 for _, q in rows), 1e-9)
    check.near("pressures", worst, 0, 1e-3, one["max_pressure_Pa"])
for key in ("approach_m", "max_pressure_Pa"):
    check.near(key + " on two ranks", answers[1][key], answers[0][key], 1e-9)
check.end()

#!/usr/bin/env python3
"""wheel_rotation.py PROGRAM MPIRUN PARAMETER_FILES: a wheel that turns past its contact with a rigid crown.

Its roots are those of the standing wheel at walking pace, and two waves for each pair of modes at 20 m/s, nV / (2 pi r) apart
to either side. One rank and two give the same. In time the equilibrium stays, and a pulse leaves a motion of just these roots.
"""
import cmath, json, math

from scene import Check, entries, run, section, table

check = Check()
SPEED, STEP, END = 20, 5e-6, 0.04


def wheel(name, rotation, speed, ranks=1, analyses="quasi-static rolling, stability"):
    transient = section("Transient", entries(Time_step=STEP, End_time=END, History_interval=2e-5,
                                             Normal_force="37000 + 20 * exp(-((t - 2e-3) / 4e-4)^2)"),
                        section("Signals", entries(Table="true"))) if "transient" in analyses else ""
    text = "\n".join([
        "set Bodies = wheel, crown", f"set Analyses = {analyses}",
        section("wheel", "set Type = wheel", section("Wheel", entries(Model="harmonics", Element_degree=2, Rotation=rotation)),
                section("Modes", entries(Upper_frequency=700))),
        section("crown", "set Type = rigid", section("Rigid", entries(Radius_y=0.3))),
        section("Contact", entries(Friction_coefficient=0.3, Grid_spacing=2e-3, Lateral_position=15e-3)),
        section("Rolling", entries(Normal_force=37000, Hub="massless", Speed=speed, Lateral_creepage=-0.01)), transient])
    return run(name, text, ranks, may_doubt=True)


def roots(folder):
    return [(complex(row["growth_1_s"], 2 * math.pi * row["frequency_Hz"]), row["label"]) for row in table(folder, "stability.csv")]


def solved(A, b):
    """Gauss with pivots."""
    n = len(b)
    rows = [list(A[i]) + [b[i]] for i in range(n)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[p] = rows[p], rows[k]
        for i in range(k + 1, n):
            f = rows[i][k] / rows[k][k]
            rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    x = [0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def left_over(samples, values):
    """Share of the samples (t, x) that no sum of constant and exponentials of these roots has."""
    t_0 = samples[0][0]
    columns = [[1.] * len(samples)]
    for s in values:
        shape = [cmath.exp(s * (t - t_0)) for t, _ in samples]
        columns += [[z.real for z in shape], [z.imag for z in shape]]
    x = [value for _, value in samples]
    mean = sum(x) / len(x)
    products = [[sum(p * q for p, q in zip(a, b)) for b in columns] for a in columns]
    amplitudes = solved(products, [sum(p * q for p, q in zip(a, x)) for a in columns])
    rest = [value - sum(a * c[i] for a, c in zip(amplitudes, columns)) for i, value in enumerate(x)]
    return math.sqrt(sum(r * r for r in rest) / sum((value - mean)**2 for value in x))


# at walking pace nothing flows
still, slow = wheel("still", "false", 0.01), wheel("slow", "true", 0.01)
check.near("number of roots", len(roots(slow[1])), len(roots(still[1])), 1e-9)
for (a, _), (b, _) in zip(roots(still[1]), roots(slow[1])):
    check.near("a root at walking pace", abs(b - a), 0, 1e-5, abs(a))

(one, folder), (two, folder_2) = [wheel(f"ranks_{n}", "true", SPEED, n, "quasi-static rolling, stability, transient") for n in (1, 2)]
for (a, label), (b, label_2) in zip(roots(folder), roots(folder_2)):
    check.near("a root on two ranks", abs(b - a), 0, 1e-9, abs(a))
    check.near("its label", label == label_2, True, 1e-9)
settings = [json.load(open(f"{name}/results.json"))["reductions"]["wheel"]["rotation"] for name in ("still", "ranks_1", "ranks_2")]
check.near("the results name the setting", settings == [False, True, True], True, 1e-9)

# axial(0,2): forward and backward, as far apart as the pattern is carried but for the little that an axial motion lags
named = {label.split(":")[1].replace(";", ","): s for s, label in roots(folder)}
apart = (named["axial(0,2) forward"].imag - named["axial(0,2) backward"].imag) / (2 * math.pi)
check.near("two waves", apart, 2 * 2 * SPEED / (2 * math.pi * 0.46), 0.15)

rows = table(folder, "histories.csv")
for row in rows[:10]:
    check.near("the equilibrium stays until the pulse", row["tangential_force_x_N"], rows[0]["tangential_force_x_N"], 1e-6)
rows_2 = table(folder_2, "histories.csv")
for a, b in list(zip(rows, rows_2))[::20]:
    check.near("approach on two ranks", b["approach_m"], a["approach_m"], 1e-9)
at_rest = wheel("at_rest", "false", SPEED)[1]
late = [row for row in rows if row["time_s"] > 8e-3]
for name in ("approach_m", "tangential_force_x_N"):
    samples = [(row["time_s"], row[name]) for row in late]
    turning, standing = (left_over(samples, [s for s, _ in roots(f)]) for f in (folder, at_rest))
    print(f"{name}: {turning:.2g} and {standing:.2g} of it are left over without the roots of the turning and of the standing wheel")
    check.near(f"{name} of the turning wheel's roots", turning, 0, 1e-3, 1)
    check.near(f"{name} of the standing wheel's", standing > 0.05, True, 1e-9)
check.end()

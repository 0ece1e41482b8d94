"""From elements to few numbers: wheel by harmonics, rail without ends, models of the ring, patches of elements."""
import cmath
import csv
import math
import os
import re
import sys

import program
from study import Point, Study

sys.path.insert(0, os.path.join(program.ROOT, "tests"))
import ring_order  # noqa: E402

WHEEL = "parameter_files/verification/wheel_frequencies/wheel.prm"
RAIL = "parameter_files/verification/long_rail/long_rail.prm"
RAIL_LEVELS = "parameter_files/verification/long_rail/baseline.csv"
RING = "parameter_files/examples/ring_green_functions.prm"
BLOCK = "contrib/benchmarks/block.prm"


def wheel_frequencies(bench, entries, ranks=1, repetitions=None):
    """Frequencies by number of nodal diameters, ascending, and the runs."""
    runs = bench.run(WHEEL, entries, ranks=ranks, repetitions=repetitions)
    found = runs.analysis("modes")["wheel"]
    by_diameters = {}
    for label, frequency in sorted(zip(found["labels"], found["frequencies_Hz"]), key=lambda mode: mode[1]):
        by_diameters.setdefault(re.search(r"(\d+)\)", label).group(1), []).append(frequency)
    return by_diameters, runs


def frequency_error(found, exact):
    """Largest relative error; infinite if another number of modes lies below the limit."""
    if {n: len(f) for n, f in found.items()} != {n: len(f) for n, f in exact.items()}:
        return math.inf
    return max(abs(a / b - 1) for n in exact for a, b in zip(found[n], exact[n]))


def finest_wheel(bench, limit):
    return wheel_frequencies(bench, {"wheel/Wheel/Model": "harmonics", "wheel/Wheel/Element degree": 4, "wheel/Wheel/Section refinements": 1,
                                     "wheel/Modes/Upper frequency": limit}, repetitions=1)[0]


def wheel(bench):
    """All modes of the built-in wheel below 8 kHz (5 kHz in the quick part)."""
    limit = 5000 if bench.quick else 8000
    exact = finest_wheel(bench, limit)
    points = []
    for degree, refinements in ((2, 0), (3, 0), (2, 1), (4, 0)) if bench.quick else ((2, 0), (2, 1), (3, 0), (3, 1), (4, 0)):
        found, runs = wheel_frequencies(bench, {"wheel/Wheel/Model": "harmonics", "wheel/Wheel/Element degree": degree,
                                                "wheel/Wheel/Section refinements": refinements, "wheel/Modes/Upper frequency": limit})
        points.append(Point(f"harmonics, degree {degree}, {refinements} halvings", "harmonics", runs.processor,
                            frequency_error(found, exact), degree == 3 and refinements == 0, {"Wheel/Model": "harmonics"}))
    if not bench.quick:
        found, runs = wheel_frequencies(bench, {"wheel/Wheel/Model": "solid", "wheel/Modes/Upper frequency": limit}, repetitions=1)
        points.append(Point("solid", "solid", runs.processor, frequency_error(found, exact), True, {"Wheel/Model": "solid"}))
    return points


def mobilities(folder):
    rows = program.read_table(f"{folder}/frequency_response_rail.csv")
    return [abs(complex(float(row[f"{point}_{point}_real_m_Ns"]), float(row[f"{point}_{point}_imag_m_Ns"])))
            for row in rows for point in ("midspan_z", "support_z", "midspan_y", "support_y")]


def rail(bench):
    """Point mobilities at four frequencies: rails of hexahedra with anechoic ends, and the rail without ends."""
    def run(entries):
        runs = bench.run(RAIL, entries, read=mobilities, repetitions=1)
        return runs.read[-1], runs.processor

    def error(found, exact):
        return max(abs(a / b - 1) for a, b in zip(found, exact))
    with open(f"{program.ROOT}/{RAIL_LEVELS}", encoding="utf-8") as file:
        long_rail = [float(row["solid_48_m_m_Ns"]) for row in csv.DictReader(file)]
    endless, seconds = run({"rail/Rail/Model": "periodic"})
    points = [Point("periodic", "periodic", seconds, error(endless, long_rail), False, {"Rail/Model": "periodic", "Frequency response/Method": "direct"})]
    for length in (12, 24):
        for method in ("direct", "modal"):
            entries = {"rail/Rail/Length": length, "rail/Rail/Contact division": 0.1, "rail/Rail/Coarse division": 0.1,
                       "Frequency response/Method": method}
            if method == "modal":
                entries["rail/Modes/Upper frequency"] = 5000
            found, seconds = run(entries)
            points.append(Point(f"solid, {length} m, {method}", f"solid, {method}", seconds, error(found, endless),
                                length == 12 and method == "modal", {"Rail/Model": "solid", "Frequency response/Method": method}))
    return points


def ring_frequencies(upper):
    """Natural frequencies [Hz] of the ring at rest, in closed form: eigenvalues of L / m for each number of waves."""
    found = []
    for n in range(200):
        C = ring_order.order(n, 0, 0)
        det = (C[0][0] * C[1][1] - C[0][1] * C[1][0]) * (2 * math.pi * ring_order.R)
        Z = [[C[1][1] / det, -C[0][1] / det], [-C[1][0] / det, C[0][0] / det]]
        half = (Z[0][0] + Z[1][1]) / 2
        root = cmath.sqrt(half ** 2 - (Z[0][0] * Z[1][1] - Z[0][1] * Z[1][0]))
        for value in (half - root, half + root):
            frequency = math.sqrt(value.real / ring_order.m) / (2 * math.pi)
            found += [frequency] * (1 if n == 0 else 2) if frequency < upper else []
    return sorted(found)


def ring(bench):
    """The analytic ring by its receptance, the rings of elements by their frequencies."""
    def receptance(folder):
        rows = program.read_table(f"{folder}/frequency_response_tyre.csv")
        return [(float(row["frequency_Hz"]), complex(float(row["A_z_A_z_real_m_N"]), float(row["A_z_A_z_imag_m_N"]))) for row in rows]

    def closed_form(frequency):
        s = 2j * math.pi * frequency
        return sum((1 if n == 0 else 2) * ring_order.order(n, s, 0)[1][1] for n in range(3000))
    runs = bench.run(RING, {"Frequency response/Truncated orders": "", "Frequency response/Impulse response time": 0,
                            "Frequency response/Last frequency": 500, "Frequency response/Number of frequencies": 26}, read=receptance)
    exact = [(value, closed_form(frequency)) for frequency, value in runs.read[-1]]
    largest = max(abs(one) for _, one in exact)
    points = [Point("analytic", "analytic", runs.processor, max(abs(a - b) for a, b in exact) / largest, True, {"Ring/Model": "analytic"})]
    upper = 300 if bench.quick else 600
    frequencies = ring_frequencies(upper)
    for model in ("beam elements", "solid elements"):
        runs = bench.run("contrib/benchmarks/ring.prm", {"tyre/Ring/Model": model, "tyre/Modes/Upper frequency": upper})
        found = sorted(runs.analysis("modes")["tyre"]["frequencies_Hz"])
        points.append(Point(model, model, runs.processor, max(abs(a / b - 1) for a, b in zip(found, frequencies))
                            if len(found) == len(frequencies) else math.inf, False, {"Ring/Model": model}))
    return points


def block(bench):
    """Pressure of a sphere on a box against Hertz, root mean square over the grid."""
    E, R, N = 200e9 / (1 - 0.3 ** 2), 0.5, 300e3
    a = (0.75 * N * R / E) ** (1 / 3)

    def error(folder):
        rows = program.read_table(f"{folder}/contact_patch_0.csv")
        exact = [1.5 * N / (math.pi * a * a) * math.sqrt(max(0., 1 - (float(row["x_m"]) ** 2 + float(row["y_m"]) ** 2) / a ** 2)) for row in rows]
        return math.sqrt(sum((float(row["pressure_Pa"]) - one) ** 2 for row, one in zip(rows, exact)) / sum(one ** 2 for one in exact))
    points = []
    lumped = {"Contact/Quadrature": "lumped"}
    for name, entries, choices in (
            ("lumped", lumped, {"Contact/Local flexibility": "finite elements", "Solver/Method": "automatic"}),
            ("lumped, direct solves", {**lumped, "block/Solver/Method": "direct"}, {"Solver/Method": "direct"}),
            ("lumped, iterative solves", {**lumped, "block/Solver/Method": "iterative"}, {"Solver/Method": "iterative"}),
            ("consistent", {"Contact/Quadrature": "consistent"}, {"Contact/Local flexibility": "finite elements"}),
            ("half-space", {"Contact/Local flexibility": "half-space", "block/Modes/Count": 20}, {"Contact/Quadrature": "lumped"})):
        for spacing in (2.5e-3,):
            runs = bench.run(BLOCK, {"Contact/Grid spacing": spacing, "Output/Contact patches": "always", **entries}, read=error, repetitions=1)
            points.append(Point(f"{name}, {1e3 * spacing:g} mm", name, runs.processor, runs.read[-1], name == "lumped", {**choices, **entries}))
    return points


SOLID = "scripts rely on solid bodies where a file says nothing; Model = harmonics or periodic is one line of it."
WHOLE = "processor time of the whole program [s]"
STUDIES = [
    Study("wheel", "Modes of a wheel by harmonics and by solid elements", "the section by harmonics of degree 4 with halved cells.", WHOLE,
          "largest relative error of all frequencies [-]", {"Wheel/Model": ["solid", "harmonics"]}, wheel, floor=1e-6,
          reason=SOLID),
    Study("rail", "Mobilities of a rail, solid and without ends", "for solid rails the rail without ends, which shares only the section's elements; "
          "for that one 48 m of hexahedra, stored by parameter_files/verification/long_rail.", WHOLE, "largest error of the levels [-]",
          {"Rail/Model": ["solid", "periodic"], "Frequency response/Method": ["modal", "direct"]}, rail, quick=False, floor=1e-4,
          reason=SOLID),
    Study("ring", "Models of the ring", "the closed form order by order, written down once more in tests/ring_order.py.", WHOLE,
          "error of the receptance over its largest (analytic), of the frequencies (elements) [-]",
          {"Ring/Model": ["analytic", "beam elements", "solid elements"]}, ring, floor=1e-6),
    Study("block", "Pressure of a sphere on a box of elements", "Hertz.", WHOLE, "rms error of the pressure over its rms [-]",
          {"Contact/Quadrature": ["lumped", "consistent"], "Contact/Local flexibility": ["finite elements", "half-space"],
           "Solver/Method": ["automatic", "direct", "iterative"]}, block,
          quick=False, floor=1e-3)]

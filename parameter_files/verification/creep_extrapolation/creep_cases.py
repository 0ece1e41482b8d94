"""Random cases of two half-spaces in steady rolling: drawn, stored in cases.csv, as entries of rolling.prm, and what a run says."""
import csv
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
FILE = os.path.join(HERE, "rolling.prm")
load, curvature_x = 66000., 1 / 0.92
inverse_modulus = 2 * (1 - 0.3 ** 2) / 205e9


def elliptic(m):
    """Complete integrals K and E of the parameter m by the arithmetic-geometric mean."""
    a, b, total, power = 1., math.sqrt(1 - m), m / 2, 0.5
    while abs(a - b) > 1e-15 * a:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        power *= 2
        total += power * c * c
    K = math.pi / (2 * a)
    return K, K * (1 - total)


def hertz(ratio):
    """Curvature along y and half axes of the contact whose axes have a ratio a / b."""
    kappa = min(ratio, 1 / ratio)
    K, E = elliptic(1 - kappa ** 2)
    larger_over_smaller = (E / kappa ** 2 - K) / (K - E)
    curvature_y = curvature_x * (larger_over_smaller if ratio > 1 else 1 / larger_over_smaller)
    minor = (1.5 * load * inverse_modulus * kappa * E / (math.pi * (curvature_x + curvature_y))) ** (1 / 3)
    return curvature_y, *((minor / kappa, minor) if ratio > 1 else (minor, minor / kappa))


def draw(generator):
    ratio = math.exp(generator.uniform(math.log(0.3), math.log(3)))
    curvature_y, a, b = hertz(ratio)
    return {"curvature_y": curvature_y, "a_m": a, "b_m": b,
            "spacing_m": math.sqrt(math.pi * a * b / generator.uniform(80, 110)), "friction": generator.uniform(0.1, 0.6),
            "longitudinal": generator.uniform(-0.004, 0.004), "lateral": generator.uniform(-0.004, 0.004),
            "spin_1_m": generator.uniform(-1, 1), "offset_x": generator.uniform(-0.5, 0.5),
            "offset_y": generator.uniform(-0.5, 0.5)}


def stored():
    """The cases of cases.csv with their limits."""
    with open(os.path.join(HERE, "cases.csv"), encoding="utf-8") as table:
        return [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(line for line in table if not line.startswith("#"))]


def settings(case, refined=1, offset=None):
    """Values by entry, with the case's spacing divided by refined and its alignment unless another offset is given."""
    h = case["spacing_m"] / refined
    x, y = offset or (case["offset_x"], case["offset_y"])
    return {"rail/Half-space/Radius y": 0.5 / case["curvature_y"], "Contact/Friction coefficient": case["friction"],
            "Contact/Grid spacing": h, "Contact/Half length": case["a_m"] + 3.2 * h,
            "Contact/Half width": case["b_m"] + 2.2 * h, "Contact/Offset x": x, "Contact/Offset y": y,
            "Rolling/Longitudinal creepage": case["longitudinal"], "Rolling/Lateral creepage": case["lateral"],
            "Rolling/Spin": case["spin_1_m"]}


def over_friction(case, found):
    """Fx, Fy over mu N and moment over mu N sqrt(a b) of a case of results.json."""
    bound = case["friction"] * found["normal_force_N"]
    return ([force / bound for force in found["tangential_force_N"]] +
            [found["spin_moment_Nm"] / bound / math.sqrt(case["a_m"] * case["b_m"])])

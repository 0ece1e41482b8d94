#!/usr/bin/env python3
"""What half-spaces under the contact leave out; see README.md.

usage: split.py FOLDER CACHE     output folder of curve_squeal_solid.prm (its contact_patch_0.csv) and cache directory that it used
"""
import csv
import glob
import os
import sys

import h5py
import numpy as np

folder, cache = sys.argv[1:3]
MATERIAL = {"wheel": (206.9e9, 0.288, 1), "rail": (205e9, 0.3, -1)}
MARKS = {"wheel": ("lateral position=-0.01\n", "traction 0"), "rail": ("Contact at=support", "traction 0")}
CUT = {"wheel": "modes 8000 ", "rail": "modes 5000 "}
np.set_printoptions(precision=1, suppress=True)


def part(body, kind, *marks):
    for name in sorted(glob.glob(os.path.join(cache, "%s-%s-*.h5" % (body, kind)))):
        file = h5py.File(name)
        if all(mark in file["key"][()].decode() for mark in MARKS[body] + marks):
            return file
    sys.exit("no %s of %s in the cache" % (kind, body))


def half_space(x, y, h, young, nu, side):
    """Boussinesq and Cerruti's influence of cells of size h (include/vibrocontact/contact/half_space.h), [n, x, y] blocks."""
    g = young / (2 * (1 + nu))
    a, b, c = (1 - nu) / (2 * np.pi * g), nu / (2 * np.pi * g), side * (1 - 2 * nu) / (4 * np.pi * g)
    dx, dy = x[:, None] - x, y[:, None] - y
    xx = yy = xy = xr = yr = 0
    for sx in (-1, 1):
        for sy in (-1, 1):
            X, Y, s = dx + sx * h / 2, dy + sy * h / 2, sx * sy
            r = np.hypot(X, Y)
            xx, yy, xy = xx + s * Y * np.arcsinh(X / abs(Y)), yy + s * X * np.arcsinh(Y / abs(X)), xy - s * r
            xr, yr = xr + s * (Y * np.log(r) + X * np.arctan(Y / X)), yr + s * (X * np.log(r) + Y * np.arctan(X / Y))
    n = a * (xx + yy)
    return np.block([[n, c * xr, c * yr], [-c * xr, n + b * xx, b * xy], [-c * yr, b * xy, n + b * yy]]) / h**2


patch = list(csv.DictReader(line for line in open(os.path.join(folder, "contact_patch_0.csv")) if not line.startswith("#")))
column = lambda name: np.array([float(row[name]) for row in patch])
x, y, slip_x, slip_y = (column(name) for name in ("x_m", "y_m", "slip_x_m_s", "slip_y_m_s"))
n, h, inside = len(x), x[1] - x[0], np.where(column("status") > 0)[0]
force = column("pressure_Pa") * h * h
share = force / force.sum()
friction = 0.3

elements, half, trace, omega, zeta = {}, {}, [], [], []
for body in ("wheel", "rail"):
    side = MATERIAL[body][2]
    modes, compliance = part(body, "modes", CUT[body]), part(body, "static")["compliance_m_N"][:]
    own = modes["trace"][:]
    own = own if own.shape[0] == 3 * n else own.T
    elements[body] = compliance - (own / modes["omega_rad_s"][:]) @ (own / modes["omega_rad_s"][:]).T
    half[body] = half_space(x, y, h, *MATERIAL[body])
    trace.append(side * own)
    omega.append(modes["omega_rad_s"][:])
    zeta.append(modes["damping_ratio"][:])
trace, omega, zeta = np.hstack(trace), np.concatenate(omega), np.concatenate(zeta)


def under_pressure(W):
    """Displacement by direction (rows) and direction of a force spread as the pressure (columns): mean, and range over the patch, nm/kN."""
    moved = np.array([[(W[i * n:(i + 1) * n, j * n:(j + 1) * n] @ share) for j in range(3)] for i in range(3)]) * 1e12
    return moved @ share, np.ptp(moved[:, :, inside], axis=2)


W, H = sum(elements.values()), sum(half.values())
for name, matrix in (("finite elements", W), ("half-spaces", H), ("difference", W - H), ("of the wheel", elements["wheel"] - half["wheel"]),
                     ("of the rail", elements["rail"] - half["rail"]), ("modes", (trace / omega) @ (trace / omega).T)):
    mean, extent = under_pressure(matrix)
    print("%s: mean over the patch, then range, n x y, nm/kN\n%s\n%s" % (name, mean, extent), flush=True)


def roots(W):
    """The paper's linearisation (doc/theory.md, Eqs 19-22): growth near the four frequencies."""
    slip = np.hypot(slip_x, slip_y)[inside]
    t_x, t_y = slip_x[inside] / slip, slip_y[inside] / slip
    normal, along_x, along_y = (trace[c * n + inside] for c in range(3))
    compliance = W[np.ix_(inside, inside)] - friction * (W[np.ix_(inside, n + inside)] * t_x + W[np.ix_(inside, 2 * n + inside)] * t_y)
    stiffness = np.diag(omega**2) + (normal - friction * (t_x[:, None] * along_x + t_y[:, None] * along_y)).T @ np.linalg.solve(compliance, normal)
    across = -t_y[:, None] * along_x + t_x[:, None] * along_y
    damping = np.diag(2 * zeta * omega) + across.T @ ((friction * force[inside] / slip)[:, None] * across)
    m = len(omega)
    values = np.linalg.eigvals(np.block([[np.zeros((m, m)), np.eye(m)], [-stiffness, -damping]]))
    near = [values[abs(values.imag / (2 * np.pi) / f - 1) < 4e-3] for f in (333.5, 917, 1669.3, 3414.3)]
    return ", ".join("%.2f Hz %+.3f 1/s" % (v.imag / (2 * np.pi), v.real) for v in (max(some, key=lambda v: v.real) for some in near))


offset = np.kron(under_pressure(W - H)[0] * 1e-12, np.ones((n, n)))
for name, matrix in (("finite elements", W), ("half-spaces", H), ("half-spaces and the mean difference", H + offset)):
    print("%s: %s" % (name, roots(matrix)), flush=True)

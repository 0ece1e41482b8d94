#!/usr/bin/env python3
"""formats.py PROGRAM MPIRUN PARAMETER_FILES: matrices of other programs in every format, against LAPACK on the same files.

CalculiX's stored matrices of C3D8 and C3D10 (in mm, t, s); the same as Matrix Market in SI, with tables, as Nastran's DMIG in long,
short and free fields, and reduced after Craig and Bampton; free bodies; held groups; damping.
"""
import csv, os, sys
from h5py_of_system import h5py  # a Python that has numpy too
import numpy as np
from scene import Check, entries, run, section

check = Check()
examples = sys.argv[3] + "/examples/data/calculix/block_c3d8"
quadratic = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "calculix", "block_c3d10")


def roots(K, M):
    """Generalised roots by LAPACK, ascending; M positive definite."""
    L = np.linalg.cholesky(M)
    A = np.linalg.solve(L, np.linalg.solve(L, K).T)
    return np.linalg.eigvalsh((A + A.T) / 2)


def stored(name, n):
    A = np.zeros((n, n))
    for line in open(name):
        i, j, value = line.split()
        A[int(i) - 1, int(j) - 1] = A[int(j) - 1, int(i) - 1] = float(value)
    return A


def write(name, text):
    with open(name, "w") as file:
        file.write(text)
    return os.path.abspath(name)


def market(name, A, general=False):
    """Coordinate: all entries, or the lower triangle."""
    n = len(A)
    lines = [f"{i + 1} {j + 1} {A[i, j]:.17g}" for j in range(n) for i in range(0 if general else j, n) if A[i, j]]
    kind = "general" if general else "symmetric"
    return write(name, f"%%MatrixMarket matrix coordinate real {kind}\n% by the test\n{n} {n} {len(lines)}\n" + "\n".join(lines) + "\n")


def array(name, A):
    return write(name, f"%%MatrixMarket matrix array real symmetric\n{len(A)} {len(A)}\n"
                 + "\n".join(f"{A[i, j]:.17g}" for j in range(len(A)) for i in range(j, len(A))) + "\n")


def dof_table(name, dofs, places):
    """Of (node, direction) with places in metres; modal coordinates have none."""
    rows = [f"{node},,,,modal" if direction == "modal" else
            f"{node},{','.join(f'{x:.17g}' for x in places[node])},{direction}" for node, direction in dofs]
    return write(name, "node,x_m,y_m,z_m,direction\n" + "\n".join(rows) + "\n")


def body(count, **own):
    return section("body", "set Type = matrices", section("Matrices", entries(**own)),
                   section("Modes", entries(Count=count)) if count else "")


def modes(name, count, ranks=1, **own):
    found, folder = run(name, "\n".join(["set Bodies = body", "set Analyses = modes", body(count, **own)]), ranks)
    return found["modes"]["body"], folder


def compare(what, found, K, M, tolerance=1e-10):
    """All frequencies found against the lowest roots, to a share of the largest root."""
    expected = roots(K, M)
    for k, f in enumerate(found["frequencies_Hz"]):
        check.near(f"{what}, root {k}", (2 * np.pi * f)**2, expected[k], tolerance, expected[-1])


def press(name, ranks=1, **own):
    """Normal force of the body pressed on a plane."""
    text = "\n".join(["set Bodies = body, plane", "set Analyses = quasi-static rolling", body(0, **own),
                      section("plane", "set Type = rigid"), section("Contact", entries(Friction_coefficient=0.3)),
                      section("Rolling", entries(Speed=0, Sliding_velocity_x=0.1, Hub_displacement=1e-6))])
    return run(name, text, ranks, may_doubt=True)[0]["quasi_static_rolling"]["cases"][0]["normal_force_N"]


def table_of_methods(folder):
    with open(os.path.join(folder, "frequency_response_body_check.csv")) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [{key: value if key == "method" else float(value) for key, value in row.items()} for row in rows]


mm = dict(Length_unit=0.001, Mass_unit=1000)
# ------------------------------------------------------------------ CalculiX
files = {}
# what CalculiX 2.20 prints of the same decks where their step is *FREQUENCY with 5 roots, in its seven digits
PRINTED_HZ = {"c3d8": (92710.02, 95864.48, 102337.8, 154994.8, 158640.6),
              "c3d10": (91220.19, 94281.88, 104169.0, 157714.7, 160119.6)}
for name, stem in (("c3d8", examples), ("c3d10", quadratic)):
    dofs = [tuple(map(int, line.split("."))) for line in open(stem + ".dof")]
    K, M = (stored(stem + end, len(dofs)) for end in (".sti", ".mas"))
    deck = dict(Stiffness=stem + ".sti", Mass=stem + ".mas", Dofs=stem + ".dof", Nodes=stem + ".inp", **mm)
    files[name] = (dofs, K, M, deck)
    found, _ = modes(name, len(dofs), **deck)
    compare(name, found, K, M)
    for k, printed in enumerate(PRINTED_HZ[name]):
        check.near(f"{name}, frequency {k} that CalculiX prints", found["frequencies_Hz"][k], printed, 1e-6)
    compare(name + ", Krylov", modes(name + "_few", 3, **deck)[0], K, M)
compare("c3d10, two ranks", modes("ranks", 12, ranks=2, **files["c3d10"][3])[0], *files["c3d10"][1:3])

# ------------------------------------------------------------------ Matrix Market in SI
dofs, K, M, deck = files["c3d10"]
lines = open(quadratic + ".inp").read().split("*ELEMENT")[0].splitlines()[2:]
places = {int(line.split(",")[0]): [1e-3 * float(x) for x in line.split(",")[1:]] for line in lines}
named = [(node, "xyz"[direction - 1]) for node, direction in dofs]
K_SI, M_SI = 1e3 * K, 1e3 * M
dof_file = dof_table("dofs.csv", named, places)
lowest = sorted({node for node, _ in named if places[node][2] == 0})
groups = write("groups.csv", "group,node\n" + "".join(f"below,{node}\n" for node in lowest)
               + "".join(f"far,{node}\n" for node in places if places[node][0] == 0.02 and places[node][2] > 0))
SI = dict(Stiffness=market("K.mtx", K_SI), Mass=market("M.mtx", M_SI, general=True), Dofs=dof_file)
compare("Matrix Market", modes("market", 12, **SI)[0], K_SI, M_SI)
point = dict(Contact_point="0.01, 0, 0", Contact_group="below", Groups=groups)
force = press("pressed_mm", Contact_point="10, 0, 0", Contact_group="CONTACT", **deck)
check.near("normal force, SI", press("pressed_si", **SI, **point), force, 1e-10)
check.near("normal force, two ranks", press("pressed_two", ranks=2, **SI, **point), force, 1e-10)
far = [i for i, (node, _) in enumerate(named) if places[node][0] < 0.02 or places[node][2] == 0]
compare("held here", modes("held", 10, Groups=groups, Held_groups="far", **SI)[0], K_SI[np.ix_(far, far)], M_SI[np.ix_(far, far)])

# ------------------------------------------------------------------ reduced by Craig and Bampton: boundary and modal coordinates
boundary = [i for i, (node, _) in enumerate(named) if node in lowest]
inner = [i for i in range(len(named)) if i not in boundary]
static = -np.linalg.solve(K_SI[np.ix_(inner, inner)], K_SI[np.ix_(inner, boundary)])
L = np.linalg.cholesky(M_SI[np.ix_(inner, inner)])
shapes = np.linalg.solve(L.T, np.linalg.eigh(np.linalg.solve(L, np.linalg.solve(L, K_SI[np.ix_(inner, inner)]).T))[1])[:, :8]
T = np.zeros((len(named), len(boundary) + 8))
T[boundary, range(len(boundary))] = 1
T[np.ix_(inner, range(len(boundary)))] = static
T[np.ix_(inner, range(len(boundary), T.shape[1]))] = shapes
K_CB, M_CB = T.T @ K_SI @ T, T.T @ M_SI @ T
CB = dict(Stiffness=array("K_cb.mtx", K_CB), Mass=array("M_cb.mtx", M_CB),
          Dofs=dof_table("dofs_cb.csv", [named[i] for i in boundary] + [(1000 + k, "modal") for k in range(8)], places))
compare("Craig-Bampton", modes("cb", 35, **CB)[0], K_CB, M_CB)
# what the boundary answers statically is exact
check.near("normal force, Craig-Bampton", press("pressed_cb", **CB, **point), force, 1e-9)


# ------------------------------------------------------------------ DMIG
def number(value, width):
    """As many digits as go into a field, in Nastran's short form of an exponent."""
    for digits in range(17, 0, -1):
        mantissa, exponent = f"{value:.{digits}E}".split("E")
        text = mantissa + f"{int(exponent):+d}"
        if len(text) <= width:
            return text, float(mantissa + "E" + exponent)


def dmig(name, form, A, dofs):
    rounded, text = np.zeros_like(A), [f"DMIG,{name},0,6,2,0,,,{len(A)}"]
    for j in range(len(A)):
        rows = []
        for i in range(j, len(A)):
            if A[i, j]:
                shown, value = number(A[i, j], {"short": 8, "long": 16, "free": 24}[form])
                rounded[i, j] = rounded[j, i] = value
                rows.append((*dofs[i], shown))
        node, component = dofs[j]
        if form == "short":
            # two entries in a line of fields 2 to 9
            fields = [[name, node, component, "", *rows[0], ""]]
            fields += [[*rows[k], "", *(rows[k + 1] if k + 1 < len(rows) else [])] for k in range(1, len(rows), 2)]
            text += [("DMIG" if k == 0 else "").ljust(8) + "".join(str(x).rjust(8) for x in f) for k, f in enumerate(fields)]
        elif form == "long":
            text += [f"DMIG*   {name:<16}{node:>16}{component:>16}"] + [f"*       {a:>16}{b:>16}{c:>16}" for a, b, c in rows]
        else:
            text += [f"DMIG*,{name},{node},{component}"] + [f"*,{a},{b},{c}" for a, b, c in rows]
    return text, rounded


cards = ["$ places", *(f"GRID,{node},,{','.join(repr(x) for x in places[node])}" for node in places)]
bulk = write("places.bdf", "\n".join(cards) + "\n")
for form in ("short", "long", "free"):
    (K_text, K_read), (M_text, M_read) = dmig("KAAX", form, K_SI, dofs), dmig("MAAX", form, M_SI, dofs)
    both = write(form + ".pch", "\n".join(K_text + M_text) + "\n")
    compare("DMIG, " + form, modes("dmig_" + form, 12, Stiffness=both, Mass=both, Nodes=bulk)[0], K_read, M_read)
check.near("normal force, DMIG", press("pressed_dmig", Stiffness=both, Mass=both, Nodes=bulk, **point), force, 1e-9)

# ------------------------------------------------------------------ free bodies
random = np.random.default_rng(1)
corners = {k + 1: [0.1 * (k & 1), 0.1 * (k >> 1 & 1), 0.1 * (k >> 2)] for k in range(8)}
truss = np.zeros((24, 24))
for a in range(8):
    for b in range(a):
        along = np.subtract(corners[a + 1], corners[b + 1])
        along /= np.linalg.norm(along)
        pair = np.kron([[1, -1], [-1, 1]], random.uniform(1e6, 2e6) * np.outer(along, along))
        at = [*range(3 * a, 3 * a + 3), *range(3 * b, 3 * b + 3)]
        truss[np.ix_(at, at)] += pair
mass = np.diag(np.repeat(random.uniform(0.1, 0.2, 8), 3))
found, _ = modes("truss", 18, Stiffness=market("K_truss.mtx", truss), Mass=market("M_truss.mtx", mass),
                 Dofs=dof_table("dofs_truss.csv", [(n, d) for n in corners for d in "xyz"], corners))
check.near("rigid motions of a truss", found["n_rigid_modes"], 6, 0.1)
compare("truss", found, truss, mass)
# a beam of Euler and Bernoulli along x that bends in z: w and the rotation about y, which is -w'
n, h, EI, rho = 6, 0.1, 70., 0.8
flip = np.diag([1, -1, 1, -1])
k_e = flip @ (EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                    [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])) @ flip
m_e = flip @ (rho * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                        [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])) @ flip
K_b, M_b = np.zeros((2 * n + 2,) * 2), np.zeros((2 * n + 2,) * 2)
for e in range(n):
    K_b[2 * e:2 * e + 4, 2 * e:2 * e + 4] += k_e
    M_b[2 * e:2 * e + 4, 2 * e:2 * e + 4] += m_e
nodes = {k + 1: [h * k, 0, 0] for k in range(n + 1)}
# in mm, kg, ms: rotations keep their unit
scale = np.diag([1e-3, 1] * (n + 1))
found, _ = modes("beam", 2 * n, Length_unit=0.001, Time_unit=0.001,
                 Stiffness=market("K_beam.mtx", scale @ K_b @ scale), Mass=market("M_beam.mtx", scale @ M_b @ scale * 1e6),
                 Dofs=dof_table("dofs_beam.csv", [(k, d) for k in nodes for d in ("z", "ry")], nodes))
check.near("rigid motions of a beam", found["n_rigid_modes"], 2, 0.1)
compare("beam", found, K_b, M_b)

# ------------------------------------------------------------------ damping
a, b = 100., 1e-9
found, _ = modes("rayleigh", 10, Damping=market("C.mtx", a * M_SI + b * K_SI), **SI)
for f, ratio in zip(found["frequencies_Hz"], found["damping_ratio"]):
    omega = 2 * np.pi * f
    check.near("damping ratio of Rayleigh", ratio, a / 2 / omega + b * omega / 2, 1e-9)
check.near("coupling by Rayleigh's damping", found["damping_coupling"], 0, 1e-6, 1)
dashpot = np.zeros_like(K_SI)
dashpot[7, 7] = 500.
lossy = np.zeros_like(K_SI)
lossy[20, 20] = 1e7
C_file, H_file = market("C_one.mtx", dashpot), market("H_one.mtx", lossy)
found, _ = modes("dashpot", len(dofs), Damping=C_file, **SI)
check.near("a dashpot couples modes fully", found["damping_coupling"], 1, 1e-6)
for name, own in (("all", len(dofs)), ("some", 45)):
    text = "\n".join(["set Bodies = body", "set Analyses = frequency response",
                      body(own, Damping=C_file, Structural_damping=H_file, **SI),
                      section("Frequency response", entries(Points="a: 0.01, 0, 0, z; b: 0.02, 0, 0, x", Quantity="receptance",
                                                            Frequencies="10e3, 90e3, 130e3", Check_frequencies="10e3, 90e3, 130e3"))])
    found, folder = run("response_" + name, text, 2 if name == "some" else 1)
    at = [named.index((node, d)) for node, d in ((next(n for n in lowest if places[n][:2] == p), d)
                                                 for p, d in (([0.01, 0.0], "z"), ([0.02, 0.0], "x")))]
    for line in table_of_methods(folder):
        omega = 2 * np.pi * line["frequency_Hz"]
        u = np.linalg.inv(K_SI + 1j * lossy + 1j * omega * dashpot - omega**2 * M_SI)[np.ix_(at, at)]
        for i, j, key in ((0, 0, "a_z_a_z"), (0, 1, "a_z_b_x"), (1, 1, "b_x_b_x")):
            got = line[key + "_real_m_N"] + 1j * line[key + "_imag_m_N"]
            if line["method"] == "direct" or (line["method"] == "hysteretic" and name == "all"):
                check.near(f"{line['method']}, {key}, {line['frequency_Hz']:g} Hz", abs(got - u[i, j]), 0, 1e-9, abs(u).max())
check.end()

"""Frequencies of quadratic tetrahedra with straight edges by 50 lines of numpy: the masses integrated exactly, or by the four points that are
exact for the stiffness."""
import numpy

EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
NEAR = (5 + 3 * 5**0.5) / 20
FOUR_POINTS = [[NEAR if k == d else (1 - NEAR) / 3 for k in range(4)] for d in range(4)]
SLOPES = numpy.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def shape_functions(barycentric):
    """Values and derivatives along the three directions of the reference cell, nodes in the order of Abaqus."""
    L = numpy.array(barycentric)
    values = numpy.concatenate([L * (2 * L - 1), [4 * L[a] * L[b] for a, b in EDGES]])
    slopes = numpy.concatenate([SLOPES * (4 * L - 1)[:, None], [4 * (L[a] * SLOPES[b] + L[b] * SLOPES[a]) for a, b in EDGES]])
    return values, slopes


def mass_of_cell(exact):
    """int N_a N_b dV over the volume of the cell."""
    if not exact:
        return sum(numpy.outer(values, values) for values, _ in map(shape_functions, FOUR_POINTS)) / 4

    # Gauss points of the cube, shrunk into the tetrahedron: exact to degree 5
    g, w = numpy.polynomial.legendre.leggauss(4)
    result = numpy.zeros((10, 10))
    for x, wx in zip((g + 1) / 2, w / 2):
        for y, wy in zip((g + 1) / 2, w / 2):
            for z, wz in zip((g + 1) / 2, w / 2):
                p = x, y * (1 - x), z * (1 - x) * (1 - y)
                values, _ = shape_functions([1 - sum(p), *p])
                result += 6 * wx * wy * wz * (1 - x)**2 * (1 - y) * numpy.outer(values, values)
    return result


def frequencies(nodes, cells, held, count, exact_mass, young=2.1e11, nu=0.3, density=7850., unit=1e-3):
    """The lowest ones [Hz] of a mesh in the order of Abaqus, {number: place}, [10 numbers]."""
    index = {node: k for k, node in enumerate(nodes)}
    places = unit * numpy.array(list(nodes.values()))
    lam, mu = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    stiffness, mass = (numpy.zeros((len(nodes), 3, len(nodes), 3)) for _ in range(2))
    share, slopes = mass_of_cell(exact_mass), [shape_functions(p)[1] for p in FOUR_POINTS]
    for cell in cells:
        own = [index[node] for node in cell]
        at = numpy.ix_(own, range(3), own, range(3))
        jacobian = places[own].T @ slopes[0]
        volume = numpy.linalg.det(jacobian) / 6
        mass[at] += density * volume * numpy.einsum("ab,ij->aibj", share, numpy.eye(3))
        for slope in slopes:
            gradient = slope @ numpy.linalg.inv(jacobian)
            G = numpy.einsum("ai,bj->aibj", gradient, gradient) * volume / 4
            stiffness[at] += lam * G + mu * G.transpose(0, 3, 2, 1) + mu * numpy.einsum("akbk,ij->aibj", G, numpy.eye(3))
    free = [3 * index[node] + d for node in nodes if node not in set(held) for d in range(3)]
    K, M = (matrix.reshape(3 * len(nodes), -1)[numpy.ix_(free, free)] for matrix in (stiffness, mass))
    inverse = numpy.linalg.inv(numpy.linalg.cholesky(M))
    return (numpy.linalg.eigvalsh(inverse @ K @ inverse.T)[:count]**0.5 / (2 * numpy.pi)).tolist()

"""The default ring order by order, written down once more (doc/theory.md, "Ring on an elastic foundation")."""
import cmath, math

R, h, b, E, rho, k_z, k_theta, p, xi = 0.285, 0.01, 0.16, 1e8, 2280., 1.64e6, 2.19e5, 2e5, 0.05
m, B, k, t = rho * h * b, E * b * h**3 / 12 / R**4, E * b * h / R**2, p * b / R


def order(n, s, Omega):
    """(v, w) per force on (v, w) of n waves, in the frame of the ring."""
    c = m * Omega**2

    def stiffness(t, c):
        L = [[(B + k + t + c) * n * n + k_theta, 0], [0, B * n**4 + (t + c) * n * n + k + k_z]]
        coupling = B * n**3 + (k + t + 2 * c) * n
        L[0][1], L[1][0] = -1j * coupling, 1j * coupling
        return L

    rest, L = stiffness(t, 0), stiffness(t, c)
    root = cmath.sqrt(rest[0][0] * rest[1][1] - rest[0][1] * rest[1][0])
    factor = 2 * xi * cmath.sqrt(m / (rest[0][0] + rest[1][1] + 2 * root))
    D = [[factor * (rest[i][j] + (root if i == j else 0)) for j in range(2)] for i in range(2)]
    D[0][1] += 2 * m * Omega
    D[1][0] -= 2 * m * Omega
    Z = [[L[i][j] + s * D[i][j] + (m * s * s if i == j else 0) for j in range(2)] for i in range(2)]
    det = (Z[0][0] * Z[1][1] - Z[0][1] * Z[1][0]) * (2 * math.pi * R)
    return [[Z[1][1] / det, -Z[0][1] / det], [-Z[1][0] / det, Z[0][0] / det]]

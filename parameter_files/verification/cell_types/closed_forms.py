"""Frequencies in closed form: a free solid sphere, an annular plate held at its bore, a cantilever by Timoshenko's theory."""
import math


def root(function, low, high):
    """By bisection; the function changes its sign once between."""
    negative = function(low) < 0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) < 0) == negative else (low, middle)
    return low


def spherical_bessel(n, x):
    last, value = math.sin(x) / x, math.sin(x) / x**2 - math.cos(x) / x
    for k in range(1, n):
        last, value = value, (2 * k + 1) / x * value - last
    return value


def sphere_torsion():
    """omega a / c_s of the torsional modes of degree 2, five of them, the lowest of a free sphere: 2.50113 (Lamb 1882)."""
    return root(lambda x: spherical_bessel(2, x) - x * spherical_bessel(3, x), 2, 3)


def sphere_spheroidal(nu):
    """omega a / c_s of the spheroidal modes of degree 2, five of them: 0.84030 pi at nu = 1/4 (Lamb 1882)."""
    n, ratio = 2, math.sqrt((1 - 2 * nu) / (2 - 2 * nu))

    def determinant(k):
        h = ratio * k
        p, p1, s, s1 = (spherical_bessel(m, x) for x in (h, k) for m in (n, n + 1))
        normal = (n * n - n - k * k / 2) * p + 2 * h * p1, n * (n + 1) * ((n - 1) * s - k * s1)
        along = (n - 1) * p - h * p1, (n * n - 1 - k * k / 2) * s + k * s1
        return normal[0] * along[1] - normal[1] * along[0]
    return root(determinant, 2.3, 3.2)


def bessel(n, x):
    """J_n(x) and Y_n(x) by their series (Abramowitz and Stegun 9.1.10, 9.1.11), for x of a few at most."""
    def psi(m):
        return sum(1 / k for k in range(1, m)) - 0.5772156649015329

    terms = [(-1)**k * (x / 2)**(2 * k + n) / (math.factorial(k) * math.factorial(n + k)) for k in range(30)]
    j = sum(terms)
    y = 2 * j * math.log(x / 2) - sum(term * (psi(k + 1) + psi(n + k + 1)) for k, term in enumerate(terms))
    y -= sum(math.factorial(n - k - 1) / math.factorial(k) * (x / 2)**(2 * k - n) for k in range(n))
    return j, y / math.pi


def plate_torsion(bore, rim):
    """k = omega / c_s of the lowest motion about the axis, u_theta(r), of a plate of any thickness that is held at its bore and free elsewhere:
    u_theta(bore) = 0, d/dr (u_theta / r) = 0 at the rim, so J_1(k a) Y_2(k b) = Y_1(k a) J_2(k b)."""
    def condition(k):
        (j1, y1), (j2, y2) = bessel(1, k * bore), bessel(2, k * rim)
        return j1 * y2 - y1 * j2
    return root(condition, 0.3 / (rim - bore), 2.2 / (rim - bore))


def cantilever(young, nu, density, length, height):
    """First bending frequency [Hz] by Timoshenko's theory, with 10 (1 + nu) / (12 + 11 nu) as its shear coefficient (Cowper 1966)."""
    shear = 10 * (1 + nu) / (12 + 11 * nu) * young / (2 * (1 + nu))
    # bending stiffness over that of shear, rotary inertia, both over the length squared
    soft, turning = young * height**2 / (12 * shear * length**2), height**2 / (12 * length**2)

    def condition(load):
        """Determinant of moment and shear force at the free end for one of each at the root; load: density A omega^2 L^4 / (E I)."""
        ends = []
        for start in ((0, 0, 1, 0), (0, 0, 0, 1)):
            # deflection, rotation, moment, shear force over E I and the length, by Taylor's series along the beam
            term, end = start, start
            for k in range(1, 80):
                w, turn, moment, force = term
                term = tuple(slope / k for slope in (turn + soft * force, moment, -force - turning * load * turn, -load * w))
                end = tuple(a + b for a, b in zip(end, term))
            ends.append(end[2:])
        return ends[0][0] * ends[1][1] - ends[0][1] * ends[1][0]
    slender = 1.8751040687**4
    load = root(condition, 0.6 * slender, 1.1 * slender)
    return math.sqrt(load * young * height**2 / (12 * density)) / length**2 / (2 * math.pi)

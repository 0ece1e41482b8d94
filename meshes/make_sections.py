#!/usr/bin/env python3
"""Write the gmsh scripts of the wheel's and the rail's section from their outlines and mesh them.

usage: make_sections.py [wheel|rail] [factor]      needs gmsh in the path; see README.md

Every node of a smooth outline keeps an edge into the body: a cell with two outline edges that meet tangentially
would have an angle of 180 degrees once the arcs are attached. The wheel therefore has a layer of cells along its
outline, filled by gmsh; the rail's few cells are laid by hand.
"""
import math
import subprocess
import sys

HEAD = """// Made by make_sections.py from {outline}: change those, not this.  Units: m.
// Straight edges here; the program attaches the arcs of the outline again after revolving or extruding.
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 1;
Mesh.Smoothing = 20;
Geometry.Tolerance = 1e-9;
"""


def read_outline(name):
    rows = []
    for line in open(name):
        field = line.split()
        if not line.startswith("#") and field:
            rows.append((field[0], [float(x) for x in field[1:8]], field[8]))
    return rows


class Geo:
    """Collects points, lines and surfaces; a point or line given twice is one."""

    def __init__(self, outline):
        self.text = [HEAD.format(outline=outline)]
        self.points, self.lines, self.n_surfaces = {}, {}, 0

    def point(self, p):
        key = (round(p[0], 4), round(p[1], 4))
        if key not in self.points:
            self.points[key] = len(self.points) + 1
            self.text.append("Point(%d) = {%.9g, %.9g, 0};" % (self.points[key], p[0] / 1e3, p[1] / 1e3))
        return self.points[key]

    def line(self, p, q):
        a, b = self.point(p), self.point(q)
        if (b, a) in self.lines:
            return -self.lines[b, a]
        if (a, b) not in self.lines:
            self.lines[a, b] = len(self.lines) + 1
            self.text.append("Line(%d) = {%d, %d};" % (self.lines[a, b], a, b))
        return self.lines[a, b]

    def polygon(self, points, transfinite=True):
        """A surface between points, one edge per side; four points make one cell."""
        curves = [self.line(p, q) for p, q in zip(points, points[1:] + points[:1])]
        self.n_surfaces += 1
        n = self.n_surfaces
        self.text.append("Curve Loop(%d) = {%s}; Plane Surface(%d) = {%d};" % (n, ", ".join(map(str, curves)), n, n))
        if transfinite:
            self.text.append("Transfinite Surface {%d};" % n)

    def mesh(self, name):
        n_lines = len(self.lines)
        self.text.append("Transfinite Curve {1:%d} = 2;" % n_lines)
        self.text.append("Recombine Surface {1:%d};" % self.n_surfaces)
        self.text.append('Physical Surface("section") = {1:%d};' % self.n_surfaces)
        open(name + ".geo", "w").write("\n".join(self.text) + "\n")
        subprocess.check_call(["gmsh", "-2", "-format", "msh41", "-v", "2", "-o", name + ".msh", name + ".geo"])


def subdivide(row, n):
    """n + 1 equally spaced points of a line or arc, with unit normals to the left of its direction."""
    kind, (a1, b1, a2, b2, ac, bc, radius), _ = row
    if kind == "line":
        length = math.hypot(a2 - a1, b2 - b1)
        normal = (-(b2 - b1) / length, (a2 - a1) / length)
        return [((a1 + (a2 - a1) * k / n, b1 + (b2 - b1) * k / n), normal) for k in range(n + 1)]
    t1, t2 = math.atan2(b1 - bc, a1 - ac), math.atan2(b2 - bc, a2 - ac)
    turn = (t2 - t1 + math.pi) % (2 * math.pi) - math.pi
    points = []
    for k in range(n + 1):
        t = t1 + turn * k / n
        sign = -1 if turn > 0 else 1
        points.append(((ac + radius * math.cos(t), bc + radius * math.sin(t)), (sign * math.cos(t), sign * math.sin(t))))
    return points


def chain(rows, cells, special={}):
    """Nodes and inward normals along consecutive outline rows; the outline runs clockwise, the body on the right."""
    nodes, normals = [], []
    for k, row in rows:
        part = special[k](row) if k in special else subdivide(row, cells[k])
        for point, normal in part:
            inward = (-normal[0], -normal[1])
            if nodes and math.hypot(point[0] - nodes[-1][0], point[1] - nodes[-1][1]) < 1e-3:
                s = (normals[-1][0] + inward[0], normals[-1][1] + inward[1])
                size = math.hypot(*s)
                normals[-1] = (s[0] / size, s[1] / size)
            else:
                nodes.append(point)
                normals.append(inward)
    return nodes, normals


def smooth_directions(normals, passes):
    for _ in range(passes):
        new = list(normals)
        for k in range(1, len(normals) - 1):
            s = [normals[k - 1][i] + 2 * normals[k][i] + normals[k + 1][i] for i in range(2)]
            size = math.hypot(*s)
            new[k] = (s[0] / size, s[1] / size)
        normals = new
    return normals


def ring(geo, nodes, normals, thickness, first, last):
    """A layer of cells along the nodes; its inner side starts at `first` and ends at `last`. Returns the inner side."""
    inner = [first] + [(p[0] + thickness(p) * n[0], p[1] + thickness(p) * n[1]) for p, n in
                       list(zip(nodes, normals))[1:-1]] + [last]
    for k in range(len(nodes) - 1):
        geo.polygon([nodes[k], nodes[k + 1], inner[k + 1], inner[k]])
    return inner


def middle(p, q):
    return ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)


def wheel():
    outline = read_outline("wheel_outline.txt")
    rows = list(enumerate(outline, 1))
    cells = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 1, 7: 5, 8: 3, 9: 1, 10: 1, 11: 3, 12: 1, 13: 1, 14: 1, 15: 1, 16: 1,
             18: 1, 19: 3, 20: 1, 21: 1, 22: 3, 23: 5, 24: 1, 25: 4, 26: 4, 27: 1, 28: 1, 29: 1, 30: 9}
    geo = Geo("wheel_outline.txt")

    def tread(row):
        # Nodes at multiples of 8 mm from the taping line: refined twice they carry the 1 mm contact grid.
        stops = [row[1][0]] + [8. * i for i in range(-2, 7)] + [row[1][2]]
        return [((a, row[1][1]), (0., 1.)) for a in stops]

    left, left_normals = chain(rows[4:7], cells)
    right, right_normals = chain(rows[22:25], cells)
    web = [middle(p, q) for p, q in zip(left, reversed(right))]
    for k in range(len(web) - 1):
        geo.polygon([left[k], left[k + 1], web[k + 1], web[k]])
        geo.polygon([web[k], web[k + 1], right[-2 - k], right[-1 - k]])

    # Rim: a layer of cells along the outline, thinner at the small roundings, the rest by gmsh.
    nodes, normals = chain(rows[7:22], cells, {17: tread})
    corners = [(-66, 408), (61, 409), (64, 459)]
    thin = lambda p: min(1., 0.6 + 0.4 * min(math.hypot(p[0] - c[0], p[1] - c[1]) for c in corners) / 25)
    inner = ring(geo, nodes, smooth_directions(normals, 2), lambda p: thin(p) * (8. if p[1] > 459 else 9.5), web[-1],
                 web[-1])
    geo.polygon(inner[:-1], False)

    # Hub by hand; its two outer edges (R5) are squared off at equal area.
    a, b = chain(rows[3:4], cells)[0], list(reversed(chain(rows[25:26], cells)[0]))
    bore = [(y, 92.5) for y in (-95, -74, -52, -36, -17, 4.5, 26, 45, 61, 85)]
    mid = [(-95, 107.6), (-74, 108), (-52, 109), (-36, 110.5), (-17, 112), (4.5, 113), (26, 112), (45, 110.5),
           (61, 109), (85, 107.6)]
    top = [(-94.85, 125.25), (-74, 126.24), a[0], a[1], a[2], (4.5, 138), b[2], b[1], b[0], (84.85, 125.1)]
    for k in range(9):
        geo.polygon([bore[k], bore[k + 1], mid[k + 1], mid[k]])
        geo.polygon([mid[k], mid[k + 1], top[k + 1], top[k]])
    stem = [(4.5, 138), (4.5, 154), web[0]]
    for k in range(2):
        geo.polygon([a[k + 2], stem[k], stem[k + 1], a[k + 3]])
        geo.polygon([stem[k], b[k + 2], b[k + 3], stem[k + 1]])
    geo.mesh("wheel_section")


def crown(y):
    return -128 + math.sqrt(300**2 - y**2) if y <= 10.228 else 91.8721 + math.sqrt(80**2 - (y - 7.50053)**2)


def rail():
    o = read_outline("rail_60e1_outline.txt")
    on = lambda k, s, n=1: subdivide(o[k - 1], n)[s][0]
    end = lambda k: (o[k - 1][1][2], o[k - 1][1][3])
    # The foot's tip (R2, R4) and the head's lower corner (R3) are squared off at equal area.
    slope = (end(5)[1] - end(4)[1]) / (end(5)[0] - end(4)[0])
    top = lambda y: end(4)[1] + slope * (y - end(4)[0])
    tip = 74.675
    corner = (37.097, 134.568)
    F = [(0, 0), (11, 0), (20, 0), (32, 0), (45, 0), (57.5, 0), (tip, 0)]
    T = [None, end(8), end(7), on(7, 1, 2), end(6), end(5), (tip, top(tip))]
    T[1], T[2], T[3] = end(8), on(8, 0), on(7, 1, 2)
    cells = [[F[k], F[k + 1], T[k + 1], T[k]] for k in range(1, 6)]
    W = [end(8), on(9, 1, 2), end(9), on(10, 1, 2), end(10), on(11, 1, 2), end(11)]
    cells.append([F[0], F[1], W[0], (0, W[0][1])])
    cells += [[(0, p[1]), p, q, (0, q[1])] for p, q in zip(W, W[1:])]
    C6, W6, H1, Hm = (0, W[6][1]), W[6], end(12), on(13, 1, 2)
    K = [(0, 172), (8, crown(8)), (16, crown(16)), end(16), on(16, 0)]
    K5 = on(15, 1, 2)
    k = [(0, 163.5), (8, 163.4), (15.8, 162.5), (22.8, 160.8), (26.8, 154.2)]
    k5 = (26.6, 144.6)
    X = [(0, 149.), (8.2, 149.), (17, 149.)]
    Y = [(0, 135.), (9.3, 136.), (17.2, 138.)]
    cells += [[K[i], K[i + 1], k[i + 1], k[i]] for i in range(4)]
    cells += [[K[4], K5, k5, k[4]], [K5, corner, Hm, k5],
              [k[0], k[1], X[1], X[0]], [k[1], k[2], X[2], X[1]], [k[2], k[3], k[4], X[2]], [X[2], k[4], k5, Y[2]],
              [Y[2], k5, Hm, H1], [X[0], X[1], Y[1], Y[0]], [X[1], X[2], Y[2], Y[1]], [Y[1], Y[2], H1, W6],
              [Y[0], Y[1], W6, C6]]
    geo = Geo("rail_60e1_outline.txt")
    for cell in cells:
        geo.polygon(cell)
    for cell in cells:
        geo.polygon([(-p[0], p[1]) for p in reversed(cell)])
    geo.mesh("rail_60e1_section")


if __name__ == "__main__":
    wanted = sys.argv[1:] or ["wheel", "rail"]
    if "wheel" in wanted:
        wheel()
    if "rail" in wanted:
        rail()

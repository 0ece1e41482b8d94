#!/usr/bin/env python3
"""Writes rail_section.geo and calls gmsh for rail_section.msh: 14 quadrilaterals of the section in rail_outline.txt, one cell each."""
import subprocess

# rows of corners, right half outwards [mm]: foot, web, head
FOOT = [[(-75, 0), (-42, 0), (-12, 0), (12, 0), (42, 0), (75, 0)],
        [(-75, 11.5), (-42, 16.5), (-12, 28), (12, 28), (42, 16.5), (75, 11.5)]]
WEB = [[(-12, 28), (12, 28)], [(-8.25, 60), (8.25, 60)], [(-8.25, 93), (8.25, 93)], [(-12.5, 124), (12.5, 124)]]
HEAD = [[(-36.8, 134.5), (-12.5, 124), (12.5, 124), (36.8, 134.5)], [(-36.4, 153), (-13, 149), (13, 149), (36.4, 153)],
        [(-26.04485, 169.6931), (-13, 171.68286), (13, 171.68286), (26.04485, 169.6931)]]

points, lines, text, surfaces = {}, {}, [], []


def point(p):
    if p not in points:
        points[p] = len(points) + 1
        text.append(f"Point({points[p]}) = {{{p[0] * 1e-3:.9g}, {p[1] * 1e-3:.9g}, 0}};")
    return points[p]


def line(p, q):
    """Its number, negative if it runs the other way."""
    a, b = point(p), point(q)
    if (b, a) in lines:
        return -lines[b, a]
    if (a, b) not in lines:
        lines[a, b] = len(lines) + 1
        text.append(f"Line({lines[a, b]}) = {{{a}, {b}}}; Transfinite Curve {{{lines[a, b]}}} = 2;")
    return lines[a, b]


for block in (FOOT, WEB, HEAD):
    for low, high in zip(block, block[1:]):
        for k in range(len(low) - 1):
            corners = [low[k], low[k + 1], high[k + 1], high[k]]
            loop = [line(corners[i], corners[(i + 1) % 4]) for i in range(4)]
            n = len(surfaces) + 1
            surfaces.append(n)
            text.append(f"Curve Loop({n}) = {{{', '.join(map(str, loop))}}}; Plane Surface({n}) = {{{n}}}; "
                        f"Transfinite Surface {{{n}}}; Recombine Surface {{{n}}};")
text.append(f"Physical Surface(\"section\") = {{{', '.join(map(str, surfaces))}}};")
with open("rail_section.geo", "w") as file:
    file.write("\n".join(text) + "\n")
subprocess.run(["gmsh", "-2", "-format", "msh41", "rail_section.geo", "-o", "rail_section.msh"], check=True, stdout=subprocess.DEVNULL)

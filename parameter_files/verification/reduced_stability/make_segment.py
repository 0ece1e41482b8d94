#!/usr/bin/env python3
"""Writes segment.msh: a small piece of a wheel, 64 x 48 x 32 mm, tread of radius 460 mm below, held on top (gmsh 2.2, mm)."""
import itertools
import os

X = [-32, -20, -12, -8, -4, 0, 4, 8, 12, 20, 32]
Y = [-24, -16, -12, -8, -4, 0, 4, 8, 12, 16, 24]
Z = [0, 4, 12, 32]
RADIUS = 460.0
number = {}
nodes = []
for k, j, i in itertools.product(range(len(Z)), range(len(Y)), range(len(X))):
    number[i, j, k] = len(nodes) + 1
    lift = RADIUS - (RADIUS**2 - X[i] ** 2) ** 0.5
    nodes.append((X[i], Y[j], Z[k] + lift * (1 - Z[k] / Z[-1])))
elements = []
for k, j, i in itertools.product(range(len(Z) - 1), range(len(Y) - 1), range(len(X) - 1)):
    bottom = [number[i, j, k], number[i + 1, j, k], number[i + 1, j + 1, k], number[i, j + 1, k]]
    top = [number[i, j, k + 1], number[i + 1, j, k + 1], number[i + 1, j + 1, k + 1], number[i, j + 1, k + 1]]
    elements.append("5 2 3 3 " + " ".join(map(str, bottom + top)))
    if k == 0:
        elements.append("3 2 1 1 " + " ".join(map(str, bottom)))
    if k == len(Z) - 2:
        elements.append("3 2 2 2 " + " ".join(map(str, top)))
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "segment.msh"), "w") as file:
    file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 "tread"\n2 2 "cut"\n3 3 "steel"\n$EndPhysicalNames\n')
    file.write("$Nodes\n%d\n" % len(nodes))
    for n, point in enumerate(nodes):
        file.write("%d %.12g %.12g %.12g\n" % ((n + 1,) + point))
    file.write("$EndNodes\n$Elements\n%d\n" % len(elements))
    for n, element in enumerate(elements):
        file.write("%d %s\n" % (n + 1, element))
    file.write("$EndElements\n")

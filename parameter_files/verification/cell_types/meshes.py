"""Decks of hexahedra, tetrahedra and prisms of first and second order: blocks of a regular lattice that are put into place.

Of a block's cube tetrahedra are six, all with one diagonal of it, and prisms two, whose triangles lie across its third direction."""
import subprocess

CUBE = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
PARTS = {"hexahedra": [range(8)], "prisms": [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
         "tetrahedra": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
# corners of the edges in Abaqus' order of the middle nodes
EDGES = {"hexahedra": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
         "prisms": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
         "tetrahedra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}
NAMES = {"hexahedra": ("C3D8", "C3D20"), "prisms": ("C3D6", "C3D15"), "tetrahedra": ("C3D4", "C3D10")}


def write_deck(name, cells, order, divisions, blocks, groups):
    """Writes a deck of cells of an order.

    blocks    functions that put a point (s, t, u) of the unit cube into place, each of `divisions` cells; nodes at one place are one
    groups    sets of nodes: name and a function (x, y, z) that says which nodes belong to it"""
    number, lines, members, elements = {}, [], {group: [] for group in groups}, []

    def node(place):
        key = tuple(round(1e9 * x) for x in place)
        if key not in number:
            number[key] = len(number) + 1
            lines.append(f"{number[key]}, " + ", ".join(f"{x:.17g}" for x in place))
            for group, belongs in groups.items():
                if belongs(*place):
                    members[group].append(f"{number[key]},")
        return number[key]

    for block in blocks:
        def at(index):
            return node(block(*(i / (2 * n) for i, n in zip(index, divisions))))
        for i in range(divisions[0]):
            for j in range(divisions[1]):
                for k in range(divisions[2]):
                    for part in PARTS[cells]:
                        corners = [tuple(2 * a + b for a, b in zip((i, j, k), CUBE[c])) for c in part]
                        if order == 2:
                            corners += [tuple((p + q) // 2 for p, q in zip(corners[a], corners[b])) for a, b in EDGES[cells]]
                        elements.append(f"{len(elements) + 1}, " + ", ".join(str(at(index)) for index in corners))
    with open(name, "w", encoding="utf-8") as file:
        file.write("*NODE\n" + "\n".join(lines) + f"\n*ELEMENT, TYPE={NAMES[cells][order - 1]}\n" + "\n".join(elements)
                   + "".join(f"\n*NSET, NSET={group}\n" + "\n".join(of_group) for group, of_group in members.items()) + "\n")


def sphere_of_hexahedra(name, radius, n, order):
    """Seven blocks: a cube inside, one to each side of the surface. Group skin."""
    def inner(s, t, u):
        return tuple(0.45 * radius * (2 * x - 1) for x in (s, t, u))

    def outer(axis, sign):
        def place(s, t, u):
            # s and t across, turned for a right-handed block
            s, t = (s, t) if sign > 0 else (t, s)
            p = [0., 0., 0.]
            p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign, 2 * s - 1, 2 * t - 1
            length = sum(x * x for x in p)**0.5
            return tuple(radius * ((1 - u) * 0.45 * x + u * x / length) for x in p)
        return place

    write_deck(name, "hexahedra", order, (n, n, n), [inner] + [outer(axis, sign) for axis in range(3) for sign in (1, -1)],
               {"skin": lambda x, y, z: abs((x * x + y * y + z * z)**0.5 / radius - 1) < 1e-9})


def sphere_of_tetrahedra(name, radius, size, order):
    """By gmsh. Group skin."""
    with open(name + ".geo", "w", encoding="utf-8") as file:
        file.write(f'SetFactory("OpenCASCADE");\nSphere(1) = {{0, 0, 0, {radius}}};\nPhysical Surface("skin") = {{1}};\n'
                   f'Physical Volume("steel") = {{1}};\nMesh.MeshSizeMax = {size};\nMesh.MeshSizeMin = {size};\n'
                   f"Mesh.ElementOrder = {order};\nMesh.MshFileVersion = 4.1;\nGeneral.NumThreads = 1;\n")
    subprocess.run(["gmsh", "-3", "-v", "1", name + ".geo", "-o", name], check=True)

"""The block whose modes other programs find too: its parameter file, its mesh for them, our answer."""
import os
import re

from common import ROOT, processor_seconds, run_ours

MODES = 20
OURS = """set Bodies   = block, plane
set Analyses = modes
subsection block
  set Type = mesh
  subsection Material
    set Young modulus = 2.1e11
    set Poisson ratio = 0.3
    set Density       = 7850
  end
  subsection Mesh
    set File           = block.msh
    set Unit           = 0.001
    set Held groups    = Einspannung
    set Element degree = 1
  end
  subsection Modes
    set Count = 20
  end
end
subsection plane
  set Type = rigid
end
"""


def mesh(folder, divisions):
    """Meshes the block with so many cells along each edge; nodes {number: (x, y, z) in mm}, cells [8 nodes], held nodes."""
    with open(os.path.join(ROOT, "meshes", "foreign_block.geo")) as file:
        text = re.sub(r"Transfinite Curve \{:\} = \d+", f"Transfinite Curve {{:}} = {divisions + 1}", file.read())
    with open(os.path.join(folder, "block.geo"), "w") as file:
        file.write(text)
    processor_seconds(["gmsh", "-3", "-format", "msh41", "-v", "2", "block.geo", "-o", "block.msh"], folder)
    return read_mesh(folder)


def mesh_of_tetrahedra(folder, size):
    """The same with tetrahedra of this edge in mm, of second order with straight edges; their nodes in the order of Abaqus."""
    with open(os.path.join(ROOT, "meshes", "foreign_block.geo")) as file:
        text = re.sub(r"(Transfinite|Recombine).*;", "", file.read())
    with open(os.path.join(folder, "block.geo"), "w") as file:
        file.write(text + f"Mesh.MeshSizeMax = {size};\nMesh.MeshSizeMin = {size};\n")
    processor_seconds(["gmsh", "-3", "-order", "2", "-format", "msh41", "-v", "2", "block.geo", "-o", "block.msh"], folder)
    nodes, cells, held = read_mesh(folder)
    return nodes, [cell[:8] + [cell[9], cell[8]] for cell in cells], held


def read_mesh(folder):
    with open(os.path.join(folder, "block.msh")) as file:
        lines = file.read().split("\n")

    def numbers(line):
        return [int(word) for word in lines[line].split()]

    nodes, cells = {}, []
    at = lines.index("$Nodes") + 1
    blocks, at = numbers(at)[0], at + 1
    for _ in range(blocks):
        count = numbers(at)[3]
        for k in range(count):
            nodes[int(lines[at + 1 + k])] = [float(word) for word in lines[at + 1 + count + k].split()]
        at += 1 + 2 * count
    at = lines.index("$Elements") + 1
    blocks, at = numbers(at)[0], at + 1
    for _ in range(blocks):
        dimension, _, _, count = numbers(at)
        if dimension == 3:
            cells += [numbers(at + 1 + k)[1:] for k in range(count)]
        at += 1 + count
    # the group Einspannung is the face z = 0
    held = [node for node, point in nodes.items() if abs(point[2]) < 1e-6]
    return nodes, cells, held


def our_modes(chosen, folder, deck=False):
    """Frequencies of the mesh in the folder by Vibrocontact, Hz, and processor seconds of the run. With `deck` of CalculiX's own deck in
    metres, elements of degree 2."""
    text = OURS
    if deck:
        for ours, theirs in (("block.msh", "block.inp"), ("= 0.001", "= 1"), ("Einspannung", "held"), ("degree = 1", "degree = 2")):
            text = text.replace(ours, theirs)
    with open(os.path.join(folder, "block.prm"), "w") as file:
        file.write(text)
    analyses, seconds = run_ours(chosen, "block.prm", folder)
    return analyses["modes"]["block"]["frequencies_Hz"][:MODES], seconds

#!/usr/bin/python3
"""Natural frequencies of one mesh by CalculiX (ccx) and by Vibrocontact: both answers, both times.

meshes/foreign_block.geo, a steel block of 60 x 40 x 20 mm held at one end, is meshed by gmsh with more and more cells. Linear hexahedra
with 2 x 2 x 2 points (C3D8) and quadratic tetrahedra with straight edges (C3D10), the lowest 20 modes. Tetrahedra are read here from the
deck that CalculiX reads. It integrates their masses by four points, which is not exact; ours are exact. Each agrees with an assembly in numpy
that does the same.
"""
import os
import shutil
import tempfile

import quadratic_tetrahedra
from block_mesh import MODES, mesh, mesh_of_tetrahedra, our_modes
from common import options, processor_seconds, require, skip, write_table

def calculix(folder, element, nodes, cells, held):
    """Frequencies by ccx, Hz, and its processor seconds."""
    with open(os.path.join(folder, "block.inp"), "w") as file:
        file.write("*NODE, NSET=all\n")
        file.writelines(f"{node}, " + ", ".join(f"{1e-3 * c:.12e}" for c in point) + "\n" for node, point in nodes.items())
        file.write(f"*ELEMENT, TYPE={element}, ELSET=block\n")
        file.writelines(f"{k}, " + ", ".join(map(str, cell)) + "\n" for k, cell in enumerate(cells, 1))
        file.write("*NSET, NSET=held\n" + "".join(f"{node},\n" for node in held))
        file.write("*BOUNDARY\nheld, 1, 3\n*MATERIAL, NAME=steel\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n"
                   f"*SOLID SECTION, ELSET=block, MATERIAL=steel\n*STEP\n*FREQUENCY\n{MODES}\n*END STEP\n")
    seconds, _ = processor_seconds(["ccx", "-i", "block"], folder)
    with open(os.path.join(folder, "block.dat")) as file:
        rows = [line.split() for line in file]
    table = [row for row in rows if len(row) == 5 and row[0].isdigit()]
    return [float(row[3]) for row in table[:MODES]], seconds


def main():
    chosen = options(__doc__)
    if shutil.which("ccx") is None:
        skip("CalculiX", "calculix-ccx")
    summary, modes = [], []

    def largest(ones, others):
        return max(abs(a / b - 1) for a, b in zip(ones, others))

    def compare(element, size, equal=False, assembled=False):
        """size: divisions of hexahedra, edge of tetrahedra in mm."""
        with tempfile.TemporaryDirectory() as folder:
            tetrahedra = element == "C3D10"
            nodes, cells, held = (mesh_of_tetrahedra if tetrahedra else mesh)(folder, size)
            theirs, seconds = calculix(folder, element, nodes, cells, held)
            ours, our_seconds = our_modes(chosen, folder, deck=tetrahedra)
            require(len(theirs) == MODES and len(ours) == MODES, f"{MODES} modes wanted, {len(ours)} ours, {len(theirs)} CalculiX's")
            off = largest(ours, theirs)
            summary.append((element, len(cells), 3 * len(nodes), ours[0], theirs[0], off, our_seconds, seconds, seconds / our_seconds))
            modes.extend((element, len(cells), k + 1, a, b, a / b - 1) for k, (a, b) in enumerate(zip(ours, theirs)))
            # seven digits are printed
            require(not equal or off < 1e-6, f"frequencies of {len(cells)} cells {element} differ by {off:.1e}")
            if assembled:
                exact, four = (quadratic_tetrahedra.frequencies(nodes, cells, held, MODES, by) for by in (True, False))
                print(f"{len(cells)} cells {element}: ours off an assembly with exact masses by {largest(ours, exact):.1e}, "
                      f"CalculiX off one with masses by four points by {largest(theirs, four):.1e}\n")
                require(largest(ours, exact) < 1e-9, f"ours of {len(cells)} cells {element} are off by {largest(ours, exact):.1e}")
                require(largest(theirs, four) < 1e-6, f"CalculiX's of {len(cells)} cells {element} are off by {largest(theirs, four):.1e}")

    for divisions in (5, 8) if chosen.quick else (10, 20, 30):
        compare("C3D8", divisions, equal=True)
    for element in () if chosen.quick else ("C3D8I", "C3D8R"):
        compare(element, 10)
    for size in (12,) if chosen.quick else (12, 6, 3.5):
        compare("C3D10", size, assembled=size == 12)
    write_table(chosen.output, "calculix_each", "Modes of the block one by one", ("element", "cells", "mode", "ours_Hz", "calculix_Hz", "difference"),
                modes, show=False)
    write_table(chosen.output, "calculix", "Lowest 20 modes of a held block: largest difference, processor seconds of the whole run",
                ("element", "cells", "unknowns", "first_ours_Hz", "first_calculix_Hz", "largest_difference", "ours_s", "calculix_s", "calculix_over_ours"),
                summary)


if __name__ == "__main__":
    main()

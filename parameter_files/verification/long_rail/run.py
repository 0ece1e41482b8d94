#!/usr/bin/env python3
"""run.py [PROGRAM] [--cells 0.05] [--folder FOLDER]: mobilities of 48 m of rail by hexahedra with anechoic ends, of the rail without ends on the
same section, and of the latter on the 60E1 that comes with the program; writes long_rail.csv. Fails if a level is off by more than 2 %."""
import argparse
import csv
import os
import subprocess
import sys

POINTS = ("midspan_z", "support_z", "midspan_y", "support_y")
FREQUENCIES = (334, 918, 1670, 3417)

parser = argparse.ArgumentParser()
parser.add_argument("program", nargs="?", default="build/vibrocontact")
parser.add_argument("--cells", default="0.05", help="length of the hexahedra [m]; 0.05: 8.2 GB, 0.1: 4.3 GB")
parser.add_argument("--folder", default="results/long_rail")
arguments = parser.parse_args()
here = os.path.dirname(os.path.relpath(__file__))


def mobilities(name, *settings):
    folder = f"{arguments.folder}/{name}"
    command = [arguments.program, f"{here}/long_rail.prm", "--quiet", "--output", folder]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, check=True)
    with open(f"{folder}/frequency_response_rail.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {(frequency, point): complex(float(row[f"{point}_{point}_real_m_Ns"]), float(row[f"{point}_{point}_imag_m_Ns"]))
            for frequency, row in zip(FREQUENCIES, rows) for point in POINTS}


own = mobilities("periodic", "rail/Rail/Model=periodic")
shipped = mobilities("shipped", "rail/Rail/Model=periodic", "rail/Rail/Section mesh=", "rail/Rail/Section outline=")
solid = mobilities("solid", f"rail/Rail/Contact division={arguments.cells}", f"rail/Rail/Coarse division={arguments.cells}")
worst = 0
with open(f"{here}/long_rail.csv", "w", encoding="utf-8") as file:
    file.write("frequency_Hz,point,solid_48_m_m_Ns,without_ends_m_Ns,level_difference,complex_difference,without_ends_60E1_m_Ns\n")
    for key in own:
        level, difference = abs(own[key]) / abs(solid[key]) - 1, abs(own[key] / solid[key] - 1)
        worst = max(worst, abs(level))
        file.write(f"{key[0]},{key[1]},{abs(solid[key]):.4e},{abs(own[key]):.4e},{level:.2e},{difference:.2e},{abs(shipped[key]):.4e}\n")
print(f"largest difference in level: {100 * worst:.2f} %")
sys.exit(0 if worst < 0.02 else 1)

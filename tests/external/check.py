#!/usr/bin/env python3
"""Installs Vibrocontact, builds the project of this folder against it and compares its own members with shipped ones.

usage: check.py BUILD_FOLDER    works in the current folder
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
prefix = pathlib.Path("prefix").resolve()


def must(*command):
    print(*command, flush=True)
    subprocess.run([str(word) for word in command], check=True)


def said(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


shutil.rmtree(prefix, ignore_errors=True)
must("cmake", "--install", sys.argv[1], "--prefix", prefix)
must("cmake", "-S", here, "-B", "build", f"-DCMAKE_PREFIX_PATH={prefix}")
must("cmake", "--build", "build")
own, shipped = pathlib.Path("build/own_contact"), prefix / "bin/vibrocontact"


def results(program, file, output, **entries):
    options = [word for name, value in entries.items() for word in ("--set", f"{name.replace('__', '/').replace('_', ' ')}={value}")]
    must(program, file, "--quiet", "--output", output, *options)
    return json.load(open(output + "/results.json"))["analyses"]


def rows(file):
    return list(csv.DictReader(line for line in open(file) if not line.startswith("#")))


def close(a, b, what):
    if isinstance(a, list):
        assert len(a) == len(b), what
        for x, y in zip(a, b):
            close(x, y, what)
        return
    assert abs(a - b) <= 1e-9 * max(abs(a), abs(b), 1e-6), f"{what}: {a} and {b}"


# body, normal law, recorder and analysis: the impact of the bar, its wave speed sqrt(E / rho)
rod, bar = results(own, here / "rod.prm", "rod"), results(shipped, here / "bar.prm", "bar")
for key in ("impulse_Ns", "steps", "time_s"):
    close(rod["transient"][key], bar["transient"][key], key)
forces = [[float(row["normal_force_N"]) for row in rows(folder + "/histories.csv")] for folder in ("rod", "bar")]
largest = max(forces[1])
assert largest > 100, largest
for a, b in zip(*forces):
    assert abs(a - b) < 1e-9 * largest, (a, b)
close(float(rows("rod/largest_force.csv")[0]["largest_force_N"]), max(forces[0]), "largest force")
close(rod["wave_speed"]["speed_m_s"], 30., "wave speed")
assert json.load(open("rod/results.json"))["answers"]["wave speed"] == ["waves run at 30.000000 m/s"]

# friction law and contact solver: rolling half-spaces
examples = prefix / "share/vibrocontact/parameter_files/examples"
quiet = {"Output__Figures": "false"}
own_case, shipped_case = (
    results(program, examples / "half_space_rolling.prm", program.name, **quiet, **entries)["quasi_static_rolling"]["cases"][0]
    for program, entries in ((own, {"Contact__Friction_law": "own friction", "Contact__Own_ratio": "1.4",
                                    "Contact__Solver__Method": "own newton"}),
                             (shipped, {"Contact__Friction_law": "falling friction", "Contact__Static_friction_ratio": "1.4"})))
assert own_case["slip_points"] > 10 and own_case["stick_points"] > 10, own_case
for key in ("tangential_force_N", "spin_moment_Nm", "max_pressure_Pa", "slip_points"):
    close(own_case[key], shipped_case[key], key)

# propagator: an oscillator on a road
own_march, shipped_march = (
    results(program, examples / "oscillator_on_sine.prm", program.name + "_road", **quiet, **{"Modal_convolution__Method": method})
    ["modal_convolution"] for program, method in ((own, "own propagator"), (shipped, "modal recursion")))
assert own_march["method"] == "own propagator" and len(own_march["impacts"]) > 2, own_march["method"]
close(own_march["impulse_Ns"], shipped_march["impulse_Ns"], "impulse of the road")
close([impact["time_s"] for impact in own_march["impacts"]], [impact["time_s"] for impact in shipped_march["impacts"]], "impacts")

# basis in time: the bar against its stop
own_motion, shipped_motion = (
    results(program, examples / "axial_bar_150.prm", program.name + "_periodic", **quiet, **alone,
            Periodic__Trial_basis=basis, Periodic__Weighting_basis=basis)["periodic"][0]
    for alone in ({"Periodic__Comparison__Pairs": "", "Periodic__Comparison__Numbers": "", "Periodic__Reference": "false"},)
    for program, basis in ((own, "own splines"), (shipped, "bspline")))
assert own_motion["basis"] == own_motion["weighting"] == "own splines", own_motion
for key in ("tip_max_m", "tip_min_m", "energy_norm_J", "penetration_m", "impulse_Ns"):
    close(own_motion[key], shipped_motion[key], key)

# all of them are listed, their entries too, and are meant where they are misspelled
code, text = said(own, "--parameters")
assert code == 0
text = " ".join(text.replace("#", " ").split())
for name in ("own spring", "own friction", "Own stiffness", "Own ratio", "A body of type rod", "subsection Wave speed",
             "own propagator", "own splines", "own newton", "wave speed: of a rod"):
    assert name in text, name
for entry, wrong, meant in (("Contact/Normal law", "own sprong", "own spring"), ("Analyses", "wave sped", "wave speed"),
                            ("rod/Type", "rood", "rod"), ("rod/Rod/Divsions", "3", "Divisions"),
                            ("Wave speed/Mode", "0", "Mode"), ("rod/Rod/Divisions", "1", "two elements or more"),
                            ("Contact/Own ratio", "2", "own friction"), ("Periodic/Trial basis", "own spines", "own splines")):
    code, text = said(own, here / "rod.prm", "--check", "--set", f"{entry}={wrong}")
    assert code == 1 and meant in text, (entry, code, text)
code, text = said(shipped, here / "rod.prm", "--check")
assert code == 1, text

# meshes come with the installation
wheel = "set Bodies = wheel\nset Analyses = modes\nsubsection wheel\nset Type = wheel\nsubsection Modes\nset Count = 1\nend\nend\n"
pathlib.Path("wheel.prm").write_text(wheel)
for program in (own, shipped):
    code, text = said(program, "wheel.prm", "--check")
    assert code == 0, text
    for mesh in ("wheel_section.msh", "wheel_outline.txt"):
        hidden = prefix / "share/vibrocontact/meshes" / mesh
        content = hidden.read_bytes()
        hidden.write_text("not a mesh")
        code, text = said(program, "wheel.prm", "--check")
        hidden.write_bytes(content)
        assert code == 1 and str(hidden) in text, text

# the package for Python comes with the installation and finds its program; Debian's own Python has numpy
python = shutil.which("python3", path="/usr/bin") or sys.executable
done = subprocess.run([python, "-B", "-c", "import vibrocontact as vc; print(vc.find_program()); vc.Case.from_file(vc.EXAMPLES / 'carter.prm').check()"],
                      env={**os.environ, "VIBROCONTACT": "", "PYTHONPATH": str(prefix / "share/vibrocontact/contrib/python")}, capture_output=True, text=True)
assert done.stdout.strip() == str(shipped) and done.returncode == 0, done.stdout + done.stderr

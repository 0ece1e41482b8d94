#!/usr/bin/env python3
"""scenes.py PROGRAM PAGE [--write]: which body goes into which analysis.

Every body is given to every analysis in the smallest scene that says all that both need; what runs, and the sentence that
refuses what does not, are the table of PAGE (doc/scenes.md) between its two markers. Fails if the page says something else;
--write brings it up to date.
"""
import os, re, sys, tempfile

program, page = os.path.abspath(sys.argv[1]), sys.argv[2]
tests = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(tests), "parameter_files", "verification", "cell_types"))
sys.path.insert(0, tests)
sys.dont_write_bytecode = True
import meshes
from many_runs import ManyRuns

runs = ManyRuns(program)

HELD = ["Modes/Count = 4"]
BAR = ["Material/Young modulus = 70e9", "Material/Density = 2700", "Material/Loss factor = 0.01", "Bar/Length = 1",
       "Bar/Section = 25e-4", "Bar/Divisions = 6", "Bar/Element degree = 2"] + HELD
RING = ["Ring/Contact points = 1", "Ring/Tread stiffness = 3e5", "Ring/Tread tangential stiffness = 1e5"]
BLOCK = ["Material/Loss factor = 0.01", "Block/Length = 0.08", "Block/Width = 0.08", "Block/Height = 0.04",
         "Block/Divisions x = 4", "Block/Divisions y = 4", "Block/Divisions z = 1", "Block/Contact face = bottom"] + HELD
FILES = tempfile.TemporaryDirectory()
TETRAHEDRA = os.path.join(FILES.name, "block.inp")
# the block of above, its upper side held
meshes.write_deck(TETRAHEDRA, "tetrahedra", 2, (4, 4, 1), [lambda s, t, u: (0.08 * s - 0.04, 0.08 * t - 0.04, 0.04 * u)],
                  {"held": lambda x, y, z: z > 0.039, "below": lambda x, y, z: z < 1e-9})
# name: type, entries, body 2, rubs, place to look at
BODIES = {
    "bar, held": ("bar", BAR + ["Bar/Far end = held"], "rigid", False, "0, 0, 0"),
    "bar, free": ("bar", BAR + ["Bar/Far end = free"], "rigid", False, "0, 0, 0"),
    "block, held": ("block", BLOCK + ["Block/Held = top"], "rigid", True, "0, 0, 0"),
    "block, held, on a half-space": ("block", BLOCK + ["Block/Held = top"], "half-space", True, "0, 0, 0"),
    "mesh of tetrahedra, held": ("mesh", ["Material/Loss factor = 0.01", f"Mesh/File = {TETRAHEDRA}", "Mesh/Held groups = held",
                                          "Mesh/Contact group = below", "Mesh/Contact cell size = 0"] + HELD, "rigid", True, "0, 0, 0"),
    "blade": ("blade", ["Material/Loss factor = 0.01", "Blade/Length divisions = 4", "Blade/Chord divisions = 8",
                        "Blade/Thickness divisions = 1", "Blade/Tip angle = 0", "Blade/Element degree = 2"] + HELD, "rigid", True, "0, 0, 0.2"),
    "layer": ("layer", ["Material/Young modulus = 2e9", "Material/Density = 2000", "Material/Loss factor = 0.01",
                        "Layer/Length = 0.1", "Layer/Height = 0.05", "Layer/Divisions x = 3", "Layer/Divisions z = 2",
                        "Layer/Element degree = 1", "Modes/Count = 6"], "rigid", True, "0.0166667, 0, 0"),
    "matrices": ("matrices", [f"Matrices/{entry} = {tests}/data/calculix/block_c3d10.{end}" for entry, end in
                              (("Stiffness", "sti"), ("Mass", "mas"), ("Dofs", "dof"), ("Nodes", "inp"))]
                 + ["Matrices/Length unit = 0.001", "Matrices/Mass unit = 1000", "Matrices/Contact point = 10, 0, 0",
                    "Matrices/Contact group = CONTACT"] + HELD, "rigid", True, "0, 0, 0"),
    "rail, periodic": ("rail", ["Material/Loss factor = 0.01", "Rail/Model = periodic", "Rail/Element degree = 1"], "rigid", True,
                       "0, 0"),
    "wheel by harmonics": ("wheel", ["Wheel/Model = harmonics", "Wheel/Element degree = 1", "Wheel/Harmonics = 10",
                                     "Modes/Upper frequency = 1000"], "rigid", True, None),
    "ring of elements": ("ring", RING + ["Ring/Model = beam elements", "Modes/Upper frequency = 300"], "rigid", True,
                         "0, 0, 0"),
    "ring of elements, rolling": ("ring", RING + ["Ring/Model = beam elements", "Ring/Rolling = true",
                                          "Modes/Upper frequency = 300"], "rigid", True, "0, 0, 0"),
    "ring, analytic": ("ring", RING + ["Ring/Model = analytic", "Ring/Highest order = 10"], "rigid", True, None),
    "ring, analytic, rolling": ("ring", RING + ["Ring/Model = analytic", "Ring/Highest order = 10", "Ring/Rolling = true"],
                                "rigid", True, None),
    "ring, analytic, on a half-space": ("ring", RING + ["Ring/Model = analytic", "Ring/Highest order = 10"], "half-space",
                                        True, None),
    "oscillator": ("oscillator", [], "rigid", True, None),
    "oscillator, on a half-space": ("oscillator", [], "half-space", True, None),
    "identified": ("identified", [f"Identified/Poles file = {tests}/periodic/identified_stop.csv",
                                  "Identified/Tread stiffness = 3e5"], "rigid", False, None),
    "half-space": ("half-space", ["Half-space/Radius x = 0.3", "Half-space/Radius y = 0.3"], "half-space", True, None),
    "rigid": ("rigid", ["Rigid/Radius x = 0.3", "Rigid/Radius y = 0.3"], "half-space", True, None),
}
ANALYSES = ["modes", "frequency response", "quasi-static rolling", "quasi-static loading", "stability", "transient", "limit cycle",
            "modal convolution", "periodic"]
PRESSED = ["Rolling/Hub displacement = 1e-6"]


def entries(analysis, kind, rubs, place, speed):
    """What an analysis has to be told of such a body."""
    own_points = kind in ("bar", "ring", "layer", "oscillator", "identified", "matrices")
    inside = analysis in ("modal convolution", "periodic")
    # the small block of matrices has its first mode at 90 kHz
    step = "1e-6" if kind == "matrices" else "1e-5"
    size = ((0.005, 0.005) if kind == "blade" else (0.01, 0.02 if inside else 0.04) if kind in ("block", "mesh")
            else (0.001, 0.004))
    grid = [] if own_points else [f"Contact/Grid spacing = {size[0]}", f"Contact/Half length = {size[1]}",
                                  f"Contact/Half width = {size[1]}"]
    # its tip is wide along x alone
    grid += ["Contact/Strip length = 0.004", "other/Rigid/Radius x = 0.1"] if kind == "blade" else []
    # its tread is straight along y
    grid += ["other/Rigid/Radius x = 0.1", "other/Rigid/Radius y = 0.1"] if kind == "wheel" and analysis != "modes" else []
    pair = grid + PRESSED + [f"Rolling/Speed = {speed}", f"Contact/Friction coefficient = {0.3 if rubs else 0}"]
    # a frictionless bar does not slide
    pair += ["Rolling/Sliding velocity x = 0.1"] if rubs or kind == "identified" else []
    return {
        "modes": [],
        "frequency response": ["Frequency response/First frequency = 50", "Frequency response/Last frequency = 200",
                               "Frequency response/Number of frequencies = 3"]
                              + ([f"Frequency response/Points = p: {place}, z"] if place else [])
                              + (["Frequency response/Method = direct"] if kind == "rail" else []),
        "quasi-static rolling": pair,
        "quasi-static loading": grid + ["Loading/Hub displacement = 1e-6", "Loading/Steps = 3",
                                        f"Contact/Friction coefficient = {0.3 if rubs else 0}"]
                                + ["Loading/Displacement x = 1e-7"] * rubs,
        "stability": pair,
        "transient": pair + ["Transient/Time step = 1e-6", "Transient/End time = 2e-5"]
                     + (["Transient/Reaction = end of step"] if kind in ("oscillator", "identified") else []),
        "limit cycle": pair,
        "modal convolution": grid +
                             ["Road/Indentation = 1e-6", f"Modal convolution/Time step = {step}",
                              "Modal convolution/End time = 2e-3"],
        "periodic": ["Contact/Friction coefficient = 0", "Periodic/Number of functions = 15", "Periodic/Frequency = 30",
                     "Periodic/Force = 1", "Periodic/Gap = 1e-7", "Periodic/Law = linear"]
                    + (["Periodic/Contact points = tip: 0, 0, 0.2", "Periodic/Stop direction = +z"] if kind == "blade" else [])
                    + (grid if kind in ("block", "mesh") else []),
    }[analysis]


def settings_of(analysis, name):
    kind, own, partner, rubs, place = BODIES[name]
    settings = [f"body/Type = {kind}"] + [f"body/{entry}" for entry in own]
    if not is_alone(analysis, kind):
        settings += [f"other/Type = {partner}"]
        settings += ["other/Half-space/Radius x = 0.5", "other/Half-space/Radius y = 0.5"] * (partner == "half-space")
    speed = 10 if "rolling" in name else 0
    settings += entries(analysis, kind, rubs, place, speed) + [f"Road/Speed = {speed}"] * (speed > 0)
    if is_alone(analysis, kind):
        settings = [setting for setting in settings if not setting.startswith("other/")]
    if is_below(analysis, kind):
        settings = [setting.replace("Contact/", "tip/") for setting in settings]
        settings += ["tip/Bodies = other, body", f"tip/Origin on body 2 = {place}"]
    return settings + ["Output/Figures = false", "Output/Fields = false"]


def is_alone(analysis, kind):
    return analysis in ("modes", "frequency response", "modal convolution") and kind != "layer"


def is_below(analysis, kind):
    """Whether it looks up at the other body."""
    return kind == "blade" and analysis in ("quasi-static rolling", "quasi-static loading", "stability", "transient", "limit cycle")


def text(analysis, name, settings):
    kind = BODIES[name][0]
    bodies = "body" if is_alone(analysis, kind) else "other, body" if is_below(analysis, kind) else "body, other"
    lines = [f"set Bodies = {bodies}", f"set Analyses = {analysis}"] + ["set Contacts = tip"] * is_below(analysis, kind)
    for setting in settings:
        path, value = setting.split(" = ")
        sections = path.split("/")
        lines += [f"subsection {section}" for section in sections[:-1]]
        lines += [f"set {sections[-1]} = {value}"] + ["end"] * (len(sections) - 1)
    return "\n".join(lines) + "\n"


def outcome(analysis, name):
    settings = settings_of(analysis, name)
    while True:
        with tempfile.TemporaryDirectory() as folder:
            with open(folder + "/scene.prm", "w") as file:
                file.write(text(analysis, name, settings))
            done = runs.run(["scene.prm", "--quiet", "--output", "run"], folder=folder)
        if done.returncode in (0, 2):
            return "runs"
        if done.returncode != 1:
            sys.exit(f"{name}, {analysis}: exit code {done.returncode}\n{done.stderr}")
        sentence = [line for line in done.stderr.splitlines() if line.startswith("vibrocontact: ")][-1]
        sentence = re.sub(r"^vibrocontact: (\S*scene\.prm(:\d+)?: )?", "", sentence)
        # what this analysis does not read is no part of its scene
        unread = re.match(r"(.*) is set, but changes nothing", sentence)
        if not unread:
            return re.sub(r'of type [\w-]+, which the analysis "[^"]*"', "of its type, which the analysis", sentence)
        also = re.search(r"The same holds for (.*)\.$", sentence)
        names = [unread[1]] + (also[1].split(", ") if also else [])
        kept = [setting for setting in settings if setting.split(" = ")[0] not in names]
        if len(kept) == len(settings):
            sys.exit(f"{name}, {analysis}: {sentence}")
        settings = kept


outcomes = {(analysis, name): outcome(analysis, name) for name in BODIES for analysis in ANALYSES}
rows, notes = [], []
for name in BODIES:
    cells = []
    for analysis in ANALYSES:
        found = outcomes[analysis, name]
        if found != "runs":
            if found not in notes:
                notes.append(found)
            found = f"[{notes.index(found) + 1}]"
        cells.append(found)
    rows.append(f"| {name} | " + " | ".join(cells) + " |")
table = "| body 1 | " + " | ".join(ANALYSES) + " |\n|" + "---|" * (len(ANALYSES) + 1) + "\n" + "\n".join(rows) + "\n\n"
table += "\n".join(f"{k + 1}. {note}" for k, note in enumerate(notes)) + "\n"
before, begin, rest = open(page).read().partition("<!-- table -->\n")
old, end, after = rest.partition("<!-- end -->")
if "--write" in sys.argv:
    open(page, "w").write(before + begin + table + end + after)
elif old != table:
    sys.exit("FAILED: " + page + " is not what runs; bring it up to date with --write:\n" + table)
print(table)

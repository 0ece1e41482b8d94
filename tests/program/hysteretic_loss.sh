# Stability with hysteretic loss of a wheel on a rail with lossy pads: results.json says which loss each analysis took, all roots
# that grow are counted by the argument principle, two ranks and a sweep give the same, and loss in full is another thing than
# damping ratios. A body with one loss factor without friction has the roots of the elastic one times sqrt(1 + i eta).
program=$1
mpirun=$2
cat >case.prm <<'END_OF_FILE'
set Bodies = wheel, rail
set Analyses = stability
subsection wheel
  set Type = wheel
  subsection Wheel
    set Model = harmonics
    set Element degree = 2
  end
  subsection Modes
    set Upper frequency = 2000
  end
end
subsection rail
  set Type = beam rail
  subsection Material
    set Loss factor = 0.02
  end
  subsection Modes
    set Upper frequency = 2500
  end
  subsection Beam rail
    set Contact at = support
  end
end
subsection Contact
  set Friction coefficient = 0.3
  set Grid spacing = 2e-3
  set Lateral position = -10e-3
end
subsection Rolling
  set Hub displacement = 0.35e-3
  set Speed = 10
  set Lateral creepage = -0.01
end
subsection Stability
  set Loss = hysteretic
  set Second count = true
end
subsection Output
  set Figures = false
end
END_OF_FILE
cat case.prm - >both.prm <<'END_OF_FILE'
subsection Transient
  set Time step = 1e-5
  set End time = 1e-4
end
END_OF_FILE
"$program" both.prm --quiet --set "Analyses=stability, transient" --output one
"$mpirun" -n 2 "$program" case.prm --quiet --output two
"$program" case.prm --quiet --set Stability/Loss=viscous --output viscous
cat case.prm - >sweep.prm <<'END_OF_FILE'
subsection Stability
  subsection Sweep
    set Entry = Contact/Friction coefficient
    set Values = 0.2, 0.3
  end
end
END_OF_FILE
"$program" sweep.prm --quiet --output sweep
cat >block.prm <<'END_OF_FILE'
set Bodies = block, crown
set Analyses = stability
subsection block
  set Type = block
  subsection Material
    set Loss factor = 0.1
  end
  subsection Block
    set Length = 0.08
    set Width = 0.08
    set Height = 0.04
    set Divisions x = 8
    set Divisions y = 8
    set Divisions z = 2
    set Contact face = bottom
    set Held = top
  end
  subsection Modes
    set Count = 8
  end
end
subsection crown
  set Type = rigid
  subsection Rigid
    set Radius x = 0.3
    set Radius y = 0.3
  end
end
subsection Contact
  set Friction coefficient = 0
  set Grid spacing = 5e-3
  set Half length = 30e-3
  set Half width = 30e-3
end
subsection Rolling
  set Normal force = 1000
  set Speed = 10
end
subsection Output
  set Figures = false
end
END_OF_FILE
"$program" block.prm --quiet --set Stability/Loss=hysteretic --output lossy
"$program" block.prm --quiet --set "block/Material/Loss factor=0" --output elastic
cat >compare.py <<'END_OF_FILE'
import cmath, csv, json, math
def results(folder):
    return json.load(open(folder + "/results.json"))["analyses"]
one, two, viscous, sweep = (results(name) for name in ("one", "two", "viscous", "sweep"))
assert one["stability"]["loss"] == two["stability"]["loss"] == sweep["stability"]["loss"] == "hysteretic"
assert viscous["stability"]["loss"] == one["transient"]["loss"] == "viscous"
assert one["stability"]["residual_damping"] == {"taken": True}
assert viscous["stability"]["residual_damping"]["taken"] is False
def unstable(of, case=0):
    return of["stability"]["cases"][case]["unstable"]
def same(a, b, tolerance):
    assert len(a) == len(b) > 0, (len(a), len(b))
    for x, y in zip(a, b):
        error = math.hypot(x["growth_1_s"] - y["growth_1_s"],
                           2 * math.pi * (x["frequency_Hz"] - y["frequency_Hz"])) / (2 * math.pi * y["frequency_Hz"])
        assert error < tolerance, (x, y)
same(unstable(one), unstable(two), 1e-8)
same(unstable(one), unstable(sweep, 1), 1e-8)
for run, each in ((one, 1), (two, 1), (viscous, 2)):
    count = run["stability"]["cases"][0]["second_count"]
    assert count["unstable_roots"] == each * len(unstable(run)) > 0, count
    assert abs(count["remainder"]) < 1e-3, count
for x, y in zip(unstable(one), unstable(viscous)):
    print(x["label"], x["growth_1_s"], y["growth_1_s"])
assert max(abs(x["growth_1_s"] / y["growth_1_s"] - 1) for x, y in zip(unstable(one), unstable(viscous))) > 0.1
def roots(folder):
    rows = csv.DictReader(line for line in open(folder + "/stability.csv") if not line.startswith("#"))
    return [complex(float(row["growth_1_s"]), 2 * math.pi * float(row["frequency_Hz"])) for row in rows]
lossy, elastic = roots("lossy"), roots("elastic")
assert len(lossy) == len(elastic) > 7, (len(lossy), len(elastic))
worst = max(abs(a - b * cmath.sqrt(1 + 0.1j)) / abs(b) for a, b in zip(lossy, elastic))
print("one loss factor:", worst)
assert worst < 1e-8, worst
END_OF_FILE
python3 compare.py

# Half-spaces under a meshed body and contact without coupling in all analyses of one file: the same normal force, other
# than that of the elements;
# a checkpoint belongs to its values. And the figure of the unstable shapes..
program=$1
cat >case.prm <<'END_OF_FILE'
set Bodies = slider, base
set Analyses = quasi-static rolling, stability, transient
subsection slider
  set Type = block
  subsection Material
    set Young modulus = 2e9
    set Poisson ratio = 0.3
    set Density = 2000
    set Loss factor = 2e-4
  end
  subsection Block
    set Length = 0.06
    set Width = 0.06
    set Height = 0.04
    set Divisions x = 12
    set Divisions y = 12
    set Divisions z = 4
    set Contact face = bottom
    set Held = top
  end
  subsection Modes
    set Count = 20
  end
end
subsection base
  set Type = half-space
  subsection Material
    set Young modulus = 20e9
    set Poisson ratio = 0.3
  end
  subsection Half-space
    set Radius x = 0.2
    set Radius y = 0.15
  end
end
subsection Contact
  set Friction coefficient = 0.8
  set Grid spacing = 2.5e-3
  set Half length = 10e-3
  set Half width = 7.5e-3
end
subsection Rolling
  set Hub displacement = 0.2e-3
  set Speed = 10
  set Lateral creepage = -0.05
end
subsection Transient
  set Time step = 1e-6
  set End time = 2e-4
end
subsection Output
  set Figures = false
end
END_OF_FILE
"$program" case.prm --quiet --output elements
"$program" case.prm --quiet --output half_space --set "Contact/Local flexibility=half-space" --set Output/Figures=true
"$program" case.prm --quiet --output uncoupled --set "Contact/Normal-tangential coupling=false" --set Output/Figures=true
"$program" case.prm --quiet --output both --set "Contact/Normal-tangential coupling=false" --set "Contact/Local flexibility=half-space"
cat >compare.py <<'END_OF_FILE'
import json
force = {}
for folder in ("elements", "half_space", "uncoupled", "both"):
    a = json.load(open(folder + "/results.json"))["analyses"]
    forces = [a["quasi_static_rolling"]["cases"][0]["normal_force_N"], a["stability"]["cases"][0]["normal_force_N"],
              a["transient"]["impulse_Ns"] / a["transient"]["time_s"]]
    print(folder, forces, [(u["frequency_Hz"], u["growth_1_s"]) for u in a["stability"]["unstable"]])
    assert max(forces) < min(forces) * (1 + 1e-6), folder
    force[folder] = forces[0]
values = sorted(force.values())
assert all(b > a * (1 + 1e-4) for a, b in zip(values, values[1:])), force
END_OF_FILE
python3 compare.py
# unstable shapes are drawn where there are any
if ! grep -q "no figures" uncoupled/log.txt; then
  [ -s uncoupled/figures/unstable_shapes.png ]
  [ ! -e half_space/figures/unstable_shapes.png ]
fi
if "$program" case.prm --quiet --output both --resume --set "Contact/Local flexibility=half-space" 2>refused; then
  echo "FAILED: resumed with another coupling"
  exit 1
fi
grep -q "Contact/Normal-tangential coupling" refused

# Half-spaces under a meshed body and contact without coupling in all analyses of one file: the same normal force, other
# than that of the elements; a checkpoint belongs to its values. And the figure of the unstable shapes.
program=$1
{ echo "set Analyses = quasi-static rolling, stability, transient"; cat "$(dirname "$0")/slider.prm" - <<'END_OF_FILE'
subsection Transient
  set Time step = 1e-6
  set End time = 2e-4
end
subsection Output
  set Figures = false
end
END_OF_FILE
} >case.prm
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

# A modal convolution tells its own errors: runs that are of no use leave with code 2 and say why, kinks of a road are impacts, a load is found.
program=$1 examples=$3/examples

# run NAME EXIT_CODE FILE SETTING...
run() {
  name=$1 expected=$2 file=$3; shift 3
  words=(); for setting in "$@"; do words+=(--set "$setting"); done
  code=0; "$program" "$file" --output "$name" --set Output/Figures=false "${words[@]}" > "$name.log" 2>&1 || code=$?
  [ $code -eq $expected ] || { echo "$name: exit code $code, not $expected"; tail -5 "$name.log"; exit 1; }
}
# holds NAME EXPRESSION of r, the object of the analysis
holds() {
  python3 -c "import json; r = json.load(open('$1/results.json'))['analyses']['modal_convolution']; assert $2" ||
    { echo "$1: not so: $2"; exit 1; }
}

# stick-slip on a belt: 2.354 N s; steps of 5 ms let the mass hop
run belt 0 "$examples/oscillator_on_belt.prm"
holds belt "r['estimated_error'] < 1e-3 and abs(r['energy']['imbalance_J']) < 1e-2 * r['energy']['input_J']"
holds belt "abs(r['energy']['friction_J'] - r['friction_J']) < 1e-12"
run hopping 2 "$examples/oscillator_on_belt.prm" "Modal convolution/Time step=5e-3"
grep -q "steps are too long for its result" hopping.log

# a tread in steps that are too long
tyre=("$examples/tyre_three_points.prm" "Modal convolution/Force shape=impulse" "Modal convolution/End time=0.2")
run long_steps 2 "${tyre[@]}" "Modal convolution/Time step=2e-3"

# waves exactly as long as a step look flat
wave=("Road/Profile=expression" "Road/Speed=100" "Road/Indentation=1e-3" "Road/Loading time=0.02" "Modal convolution/Force shape=linear"
      "Modal convolution/End time=0.2" "Road/Expression=6e-4*sin(2*pi*s/0.02)")
run aliased 2 "$examples/tyre_three_points.prm" "${wave[@]}" "Modal convolution/Time step=2e-4"
grep -q "waves between the steps" aliased.log
run resolved 0 "$examples/tyre_three_points.prm" "${wave[@]}" "Modal convolution/Time step=1e-5"

# a row of points that the contact fills touches beside it too; three points are single treads
run short_row 2 "$examples/tyre_rolling.prm" "tyre/Ring/Contact points=25" "Modal convolution/End time=0.1"
grep -q "reaches the outermost contact points" short_row.log
run whole_row 0 "$examples/tyre_rolling.prm" "Modal convolution/End time=0.1"
python3 - <<'PYTHON'
import json
short, whole = (sum(json.load(open(f"{name}/results.json"))["analyses"]["modal_convolution"]["impulse_Ns"]) for name in ("short_row", "whole_row"))
assert 0.8 < short / whole < 0.95, (short, whole)
PYTHON

# valleys of abs(sin) under a rigid mass: eight impacts; the account of the exact motion closes
run valleys 0 "$examples/oscillator_on_sine.prm" "Road/Expression=1e-6*abs(sin(2*pi*s/0.025))"
holds valleys "r['n_impacts'] == 8 and abs(r['impacts'][3]['impulse_Ns'] / (2 * 1e-6 * 2 * 3.141592653589793 / 0.025 * 0.1) - 1) < 1e-10"
holds valleys "abs(r['energy']['imbalance_J']) < 1e-9 * r['energy']['initial_J'] and r['estimated_error'] < 1e-9"

# a load in place of an indentation
run load 0 "$examples/tyre_three_points.prm" "Road/Indentation=0" "Rolling/Normal force=400" "Road/Profile=flat" "Modal convolution/End time=0.8"
grep -q "indentation for it" load.log
python3 - <<'PYTHON'
import csv, json
r = json.load(open("load/results.json"))["analyses"]["modal_convolution"]
last = [list(csv.reader(line for line in open(f"load/contact_point_{i}.csv") if line[0] != "#"))[-1] for i in range(3)]
assert abs(sum(float(row[2]) for row in last) / 400 - 1) < 1e-6, last
assert abs(float(last[1][3]) - r["indentation_m"]) < 1e-12, (last, r["indentation_m"])
PYTHON

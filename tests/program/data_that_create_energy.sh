# The tyre's data as a measuring chain that lags or mislabels would give them: refused with the cure, and with the delay that is
# proposed the forces on the road are those of the good data.
program=$1 examples=$3/examples
python3 - $examples/data/ring_at_rest.csv <<'PY'
import cmath, math, sys

lines = [line for line in open(sys.argv[1]) if not line.startswith("#")]
rows = [list(map(float, line.split(","))) for line in lines[1:]]
for delay in (2e-5, 8e-5, 5e-4):
    with open(f"delayed_{1e6 * delay:.0f}.csv", "w") as file:
        file.write(lines[0])
        for row in rows:
            turn = cmath.exp(-2j * math.pi * row[0] * delay)
            cells = [repr(row[0])]
            for k in range(1, len(row), 2):
                value = complex(row[k], row[k + 1]) * turn
                cells += [repr(value.real), repr(value.imag)]
            file.write(",".join(cells) + "\n")
with open("mislabelled.csv", "w") as file:
    file.write(lines[0].replace("_m_N", "_m_Ns"))
    file.writelines(lines[2:])  # not at 0 Hz
PY

run() {
  folder=$1
  shift
  $program $examples/tyre_from_data.prm --quiet --output $folder --set Output/Figures=false "$@"
}

run good
for delay in 20 80 500; do
  run refused --set "Identification/Data file=$PWD/delayed_$delay.csv" 2> message && exit 1
  found=$(sed -n 's/.*Identification\/Delay = \([0-9.e-]*\) .*/\1/p' message)
  echo "delay of $delay us: $found s proposed"
  [ -n "$found" ]
  run delayed_$delay --set "Identification/Data file=$PWD/delayed_$delay.csv" --set "Identification/Delay=$found"
done
run refused --set "Identification/Data file=$PWD/mislabelled.csv" 2> message && exit 1
grep -q "probably they are receptances" message
# --check says the same
$program $examples/tyre_from_data.prm --check --set "Identification/Data file=$PWD/mislabelled.csv" 2> message && exit 1
grep -q "probably they are receptances" message
python3 - <<'PY'
import json, math


def forces(folder):
    lines = [line for line in open(folder + "/contact_point_1.csv") if not line.startswith("#")]
    column = lines[0].strip().split(",").index("force_N")
    return [float(line.split(",")[column]) for line in lines[1:]]


good = forces("good")
for delay in (20, 80, 500):
    other = forces(f"delayed_{delay}")
    error = math.sqrt(sum((a - b)**2 for a, b in zip(other, good)) / sum(b**2 for b in good))
    fit = json.load(open(f"delayed_{delay}/results.json"))["analyses"]["identification"][0]
    print(f"delay of {delay} us removed: rms force error {error:.2e}, estimate of what is left {fit['data_delay']['estimate_s']:.1e} s")
    assert error < 0.02, error
    assert fit["passivity"]["passive"] and fit["passivity"]["change"] < 0.05
PY

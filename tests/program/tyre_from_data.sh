# The paper's chain, frequency responses -> 25 pairs of poles -> contact, against the exact modes of the ring that the data are of.
program=$1 examples=$3/examples
# as fitted, and made passive (the default), which takes off a little of what the fit says
$program $examples/tyre_from_data.prm --quiet --output fitted --set Output/Figures=false --set "Identification/Enforce passivity=false"
$program $examples/tyre_from_data.prm --quiet --output passive --set Output/Figures=false
$program $examples/tyre_three_points.prm --quiet --output exact --set Output/Figures=false --set "tyre/Ring/Highest order=400"
python3 - <<'PY'
import json, math, sys


def forces(folder, point):
    lines = [line for line in open(f"{folder}/contact_point_{point}.csv") if not line.startswith("#")]
    column = lines[0].strip().split(",").index("force_N")
    return [float(line.split(",")[column]) for line in lines[1:]]


def impulse(folder):
    return json.load(open(folder + "/results.json"))["analyses"]["modal_convolution"]["impulse_Ns"][1]


largest = max(max(forces("exact", point)) for point in range(3))
for folder, limit in (("fitted", 2e-4), ("passive", 4e-4)):
    for point in range(3):
        found, exact = forces(folder, point), forces("exact", point)
        assert len(found) == len(exact) == 10001
        error = math.sqrt(sum((a - b)**2 for a, b in zip(found, exact)) / len(exact)) / largest
        print(f"{folder}, point {point}: rms force error over the largest force {error:.2e}")
        if not error <= 1e-3:
            sys.exit("the forces are more than 1e-3 off")
    error = impulse(folder) / impulse("exact") - 1
    print(f"{folder}: impulse of the middle point off by {error:.2e}")
    if not abs(error) <= limit:
        sys.exit(f"the impulse is more than {limit} off")
PY

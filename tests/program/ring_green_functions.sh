# The shipped Green's functions of a ring against the printed values of the tyre paper's errata; at rest reciprocal, rolling not.
program=$1 file=$3/examples/ring_green_functions.prm
$program $file --quiet --output rest --set Output/Figures=false
$program $file --quiet --output rolling --set Output/Figures=false --set tyre/Ring/Rolling=true \
  --set "Frequency response/Frequencies=100" --set "Frequency response/Truncated orders="
# its own tables as a body: the same poles, the same receptance
cat >again.prm <<'END'
set Bodies = tyre
set Analyses = frequency response
subsection tyre
  set Type = identified
  subsection Identified
    set Poles file = rest/poles_tyre.csv
  end
end
subsection Frequency response
  set Frequencies = 10, 100, 700
  set Quantity    = receptance
end
END
$program again.prm --quiet --output again --set Output/Figures=false
$program $file --quiet --output modal --set Output/Figures=false --set "Frequency response/Method=modal" \
  --set "Frequency response/Frequencies=10, 100, 700"
python3 - <<'PY'
import csv, json


def table(name):
    return [{key: float(value) for key, value in row.items()}
            for row in csv.DictReader(line for line in open(name) if not line.startswith("#"))]


def close(value, expected, digits, what):
    print(what, value, "expected", expected)
    assert abs(value - expected) <= 0.51 * 10**-digits, what


def near(value, expected, what):
    """printed with one or two digits; here 0.91, 0.125, 1.24 and 0.057 %"""
    print(what, value, "expected", expected)
    assert abs(value - expected) <= 0.1 * expected, what


rows = table("rest/frequency_response_tyre.csv")
assert len(rows) == 1001 and rows[0]["frequency_Hz"] == 0 and rows[100]["frequency_Hz"] == 100
close(rows[0]["B_z_B_z_real_m_N"] * 1e6, 3.39624, 5, "G(0, 0)")
close(rows[100]["B_z_B_z_real_m_N"] * 1e6, 5.91608, 5, "Re G(100 Hz)")
close(rows[100]["B_z_B_z_imag_m_N"] * 1e6, -3.58979, 5, "Im G(100 Hz)")
found = sorted({round(row["frequency_Hz"], 6) for row in table("rest/poles_tyre.csv")})
for expected in (39.00, 75.0706, 104.5396, 126.1488, 148.2907, 158.3203, 172.2780, 190.2373, 844.6858):
    close(min(found, key=lambda f: abs(f - expected)), expected, 2 if expected == 39 else 4, "natural frequency")
cuts = {(cut["highest_order"], cut["residual"], cut["poles"]): cut["error_E_driving_point"] for cut in
        json.load(open("rest/results.json"))["analyses"]["frequency_response"]["bodies"]["tyre"]["truncation"]}
near(cuts[50, False, False], 0.9e-2, "E of |n| <= 50")
near(cuts[100, False, False], 0.13e-2, "E of |n| <= 100")
near(cuts[25, True, False], 1.3e-2, "E of |n| <= 25 and residual")
near(cuts[40, True, False], 0.06e-2, "E of |n| <= 40 and residual")
assert cuts[60, True, True] < 2e-4
row = table("rolling/frequency_response_tyre.csv")[0]
ab, ba = (complex(row[f"{pair}_real_m_N"], row[f"{pair}_imag_m_N"]) for pair in ("A_z_B_z", "B_z_A_z"))
assert abs(ab - ba) > 1e-3 * abs(ab)
for one, other in zip(table("again/frequency_response_tyre.csv"), table("modal/frequency_response_tyre.csv")):
    assert set(one) == set(other)
    largest = max(abs(value) for key, value in other.items() if key != "frequency_Hz")
    assert max(abs(one[key] - other[key]) for key in one) < 1e-10 * largest
PY

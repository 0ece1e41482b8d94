# The shipped Green's functions of a ring against the values that another program printed and against sums over the
# 2 x 2 systems made here; at rest reciprocal, rolling not.
program=$1 file=$3/examples/ring_green_functions.prm
$program $file --quiet --output rest --set Output/Figures=false
$program $file --quiet --output rolling --set Output/Figures=false --set tyre/Ring/Rolling=true --set Road/Speed=22.222222222222222 \
  --set "Frequency response/Frequencies=100" --set "Frequency response/Truncated orders=" \
  --set "tyre/Ring/Tread stiffness=3e5" --set "tyre/Ring/Tread tangential stiffness=1e5"
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
import csv, json, math


def table(name):
    return [{key: float(value) for key, value in row.items()}
            for row in csv.DictReader(line for line in open(name) if not line.startswith("#"))]


def close(value, expected, digits, what):
    print(what, value, "expected", expected)
    assert abs(value - expected) <= 0.51 * 10**-digits, what


def motions(n):
    """of order +-n: radial receptance at the driving point per 1 / (natural^2 - w^2 + 2 j xi natural w), natural [1/s]"""
    radius, h, b, young, rho, k_z, k_theta, p = 0.285, 0.01, 0.16, 1e8, 2280, 1.64e6, 2.19e5, 2e5
    m, B, k, t = rho * b * h, young * b * h**3 / 12 / radius**4, young * b * h / radius**2, p * b / radius
    along, out, both = (B + k + t) * n**2 + k_theta, B * n**4 + t * n**2 + k + k_z, B * n**3 + (k + t) * n
    large = (along + out) / 2 + math.hypot((along - out) / 2, both)
    for square in (along * out - both**2) / large, large:
        share = (square - along) / (2 * square - along - out)
        yield (1 if n == 0 else 2) * share / (2 * math.pi * radius * m), math.sqrt(square / m)


omegas = [2 * math.pi * f for f in range(1001)]
in_full = [[sum(share / (w0**2 - w**2 + 0.1j * w0 * w) for share, w0 in order) for w in omegas]
           for order in (list(motions(n)) for n in range(401))]
static = [sum(share / w0**2 for share, w0 in motions(n)) for n in range(20001)]


def cut_error(highest, residual):
    """E of the sum up to an order, without or with the static answer of those above it up to 20,000"""
    lost = whole = 0
    above, rest = sum(static[401:]), sum(static[highest + 1:]) if residual else 0
    for l in range(len(omegas)):
        tail = sum(order[l] for order in in_full[highest + 1:]) + above
        weight = 0.5 if l in (0, len(omegas) - 1) else 1
        lost += weight * abs(tail - rest)
        whole += weight * abs(tail + sum(order[l] for order in in_full[:highest + 1]))
    return lost / whole


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
for highest in 25, 40, 50, 100:
    for residual in False, True:
        error, expected = cuts[highest, residual, False], cut_error(highest, residual)
        print(f"E of |n| <= {highest}{' and residual' if residual else ''}", error, "expected", expected)
        assert abs(error - expected) <= 1e-6 * expected
assert cuts[60, True, True] < 2e-4
# poles and inversion agree in every entry, along the circle and with the tread as well
rolling = json.load(open("rolling/results.json"))["analyses"]["frequency_response"]["bodies"]["tyre"]["truncation"]
assert len(rolling) == 1 and rolling[0]["poles"] and rolling[0]["error_E"] < 1e-3, rolling
row = table("rolling/frequency_response_tyre.csv")[0]
ab, ba = (complex(row[f"{pair}_real_m_N"], row[f"{pair}_imag_m_N"]) for pair in ("A_z_B_z", "B_z_A_z"))
assert abs(ab - ba) > 1e-3 * abs(ab)
for one, other in zip(table("again/frequency_response_tyre.csv"), table("modal/frequency_response_tyre.csv")):
    assert set(one) == set(other)
    largest = max(abs(value) for key, value in other.items() if key != "frequency_Hz")
    assert max(abs(one[key] - other[key]) for key in one) < 1e-10 * largest
PY

# contrib/benchmarks/smallest_models.py: Carter's problem would take 1 mm, 2 mm does not fit its grid, and what it misses is what a run
# misses against the closed form. A scene that is not there is refused.
script=$(dirname "$3")/contrib/benchmarks/smallest_models.py
build=$(dirname "$1")
fail() { echo "$*"; exit 1; }

python3 -B "$script" --build "$build" --scenes nowhere >said.txt 2>&1 && fail "a scene that is not there runs"
grep -q "there is no scene nowhere" said.txt || fail "not said: $(cat said.txt)"
python3 -B "$script" --build nowhere --scenes carter >said.txt 2>&1 && fail "runs without a program"
grep -q "there is no program nowhere/vibrocontact" said.txt || fail "not said: $(cat said.txt)"

python3 -B "$script" --build "$build" --scenes carter.prm --output tables || fail "the study failed"
"$1" "$3/examples/carter.prm" --quiet --output run --set Output/Figures=false
python3 -B - <<'END' || fail "the tables are wrong: $(cat tables/*.csv)"
import csv, json
summary, = csv.DictReader(open("tables/smallest_models.csv"))
rows = {row["value"]: row for row in csv.DictReader(open("tables/smallest_models_runs.csv"))}
assert "two columns must stay free" in rows.pop("0.002")["refusal"]
runs = {value: float(row["error"]) for value, row in rows.items()}
assert (summary["shipped"], summary["smallest_within_1_percent"], summary["file"]) == ("0.0005", "0.001", "larger than needed")
case, = json.load(open("run/results.json"))["analyses"]["quasi_static_rolling"]["cases"]
error = abs(case["tangential_force_N"][0] / case["normal_force_N"] + 0.64 * 0.3) / (0.64 * 0.3)
assert abs(runs["0.0005"] - error) < 1e-9, (runs, error)
assert runs["0.000125"] < runs["0.0005"] < 1e-3 < runs["0.001"] < 1e-2
END

# A Target error that no number of pole pairs reaches: exit code 2, the best fit is kept and marked; one that is reached: 0.
program=$1 file=$3/examples/identify_tyre.prm
options=(--quiet --set Output/Figures=false --set "Identification/Stabilisation chart=false" --set "Identification/Method=vector fitting"
  --set "Identification/Largest number of pole pairs=8" --set Identification/Iterations=10)
$program $file "${options[@]}" --output missed --set "Identification/Target error=1e-6" && exit 1
[ $? = 2 ]
$program $file "${options[@]}" --output reached --set "Identification/Target error=0.1"
python3 - <<'PY'
import json

missed, reached = (json.load(open(folder + "/results.json")) for folder in ("missed", "reached"))
assert "Target error 1e-06 is not reached by vector fitting with up to 8 pole pairs" in json.dumps(missed)
(fit,) = missed["analyses"]["identification"]
assert fit["target_reached"] is False and fit["error_E"] > 1e-6 and fit["n_pole_pairs_asked"] <= 8
(fit,) = reached["analyses"]["identification"]
assert fit["target_reached"] is True and fit["error_E"] <= 0.1
PY

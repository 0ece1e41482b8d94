# A Count that would split a pair of equal frequencies takes the pair, and says so: a block of square section on its foot.
program=$1
cat >case.prm <<'END'
set Bodies = block
set Analyses = modes
subsection block
  set Type = block
  subsection Modes
    set Count = 1
  end
end
END
"$program" case.prm --set Output/Figures=false --set Output/Fields=false --output pair | tee screen
grep -q "1 more than the 1 asked for: equal frequencies" screen
python3 - <<'PY'
import json

one, two = json.load(open("pair/results.json"))["analyses"]["modes"]["block"]["frequencies_Hz"]
assert abs(one / two - 1) < 1e-6, (one, two)
PY

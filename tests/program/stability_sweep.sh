# A stability sweep over lateral position and sense of sliding, all positions on one reduction: each case has the
# roots of a run of its own at that position (equal meshes: to round-off) and those of its mirror image (position and
# sense reversed); two ranks give the same, and the second count finds the unstable pair.
program=$1
mpirun=$2
{ echo "set Analyses = stability"; cat "$(dirname "$0")/slider.prm" - <<'END_OF_FILE'
subsection Output
  set Figures = false
end
END_OF_FILE
} >case.prm
cat >sweep.prm <<'END_OF_FILE'
subsection Stability
  subsection Sweep
    set Entry = Contact/Lateral position
    set Range = -5e-3, 5e-3, 5e-3
    set Second entry = Rolling/Lateral creepage
    set Second values = -0.05, 0.05
  end
end
END_OF_FILE
cat case.prm sweep.prm >both.prm
"$program" both.prm --quiet --output sweep
"$program" case.prm --quiet --set "Contact/Lateral position=-0.005" --set "Stability/Second count=true" --output own
rm -r cache
"$mpirun" -n 2 "$program" both.prm --quiet --output two_ranks
cat >compare.py <<'END_OF_FILE'
import csv, json
def table(name):
    return list(csv.DictReader(line for line in open(name) if not line.startswith("#")))
def roots(rows, **wanted):
    return sorted((float(r["frequency_Hz"]), float(r["growth_1_s"])) for r in rows
                  if all(abs(float(r[k]) - v) < 1e-9 for k, v in wanted.items()))
def same(a, b, tolerance, what):
    assert len(a) == len(b) > 15, (what, len(a), len(b))
    worst = max(max(abs(f - g), abs(s - t)) / max(f, 1.) for (f, s), (g, t) in zip(a, b))
    print(what, worst)
    assert worst < tolerance, (what, worst)
sweep = table("sweep/stability.csv")
at = lambda y, creepage: roots(sweep, lateral_position_m=y, lateral_creepage=creepage)
same(at(-0.005, -0.05), roots(table("own/stability.csv")), 1e-7, "own reduction")
same(at(-0.005, -0.05), at(0.005, 0.05), 1e-6, "mirror image")
other = table("two_ranks/stability.csv")
same(roots(sweep, case=3), roots(other, case=3), 1e-6, "two ranks")
cases = json.load(open("sweep/results.json"))["analyses"]["stability"]["cases"]
assert [len(case["unstable"]) for case in cases] == [1, 0, 1, 1, 0, 1]
own = json.load(open("own/results.json"))["analyses"]["stability"]["cases"][0]
assert own["second_count"]["unstable_roots"] == 2 and len(own["unstable"]) == 1
maps = table("sweep/stability_map.csv")
assert [int(row["n_unstable"]) for row in maps] == [len(case["unstable"]) for case in cases]
# a path keeps its name: one row per case and root
paths = table("sweep/stability_sweep.csv")
keys = [(row["case"], row["root"]) for row in paths]
assert len(keys) == len(set(keys)) > 0
END_OF_FILE
python3 compare.py

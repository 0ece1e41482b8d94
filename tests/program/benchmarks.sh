# contrib/benchmarks/run.py: its report, its comparison with a baseline in which one row is cheaper and one more exact than can
# be, and a member without a picture.
python=/usr/bin/python3
$python -c 'import matplotlib' 2>/dev/null || exit 77
scripts=$(dirname "$3")/contrib/benchmarks
build=$(dirname "$1")
fail() { echo "$*"; exit 1; }

$python -B "$scripts/run.py" --build "$build" --list >list.txt || fail "a member is on no picture: $(grep MISSING list.txt)"
grep -q "Contact/Solver/Method = automatic, few points" list.txt || fail "no list"
$python -B - "$scripts" "$1" <<'END' || fail "a new member without a picture is not found"
import subprocess, sys
sys.path.insert(0, sys.argv[1])
import members
from studies import ALL
text = subprocess.run([sys.argv[2], "--parameters"], text=True, stdout=subprocess.PIPE).stdout
new = text.replace("first-order upwind, second-order upwind", "first-order upwind, third-order upwind, second-order upwind")
assert new != text and members.without_picture(text, ALL) == []
assert members.without_picture(new, ALL) == ["Contact/Creep scheme = third-order upwind is on no picture"]
END

# a row whose stored runs spread 154-fold hides neither its own fivefold cost nor that the default became slower
$python -B - "$scripts" <<'END' || fail "spread rows hide what became slower"
import sys
sys.path.insert(0, sys.argv[1])
import baseline
from study import Point, Study

def costs(default, **others):
    study = Study("one", "", "", "", "", {}, None)
    study.points = [Point("default", "", default, 0., True)] + [Point(name, "", seconds, 0.) for name, seconds in others.items()]
    return [study]

baseline.write(costs([1., 1.], wild=[1., 154.], calm=[1., 1.], even=[3., 3.]), "spread.csv")
stored = baseline.read("spread.csv")
assert baseline.worse(costs([1., 1.], wild=[1., 1.], calm=[1., 1.4], even=[4.2, 4.2]), stored) == []
slower, = baseline.worse(costs([1., 1.], wild=[5., 5.], calm=[1., 1.], even=[3., 3.]), stored)
assert "wild became slower: 5 times the default, 1 before" in slower, slower
slower, = baseline.worse(costs([2., 2.], wild=[1., 1.], calm=[1., 1.], even=[3., 3.]), stored)
assert "the default became slower" in slower, slower
END

# wrong use is said before anything runs, and ends with 1
refused() { # regex, options
  words=$1; shift; code=0
  $python -B "$scripts/run.py" --build "$build" --output wrong "$@" >said.txt 2>&1 || code=$?
  [ $code = 1 ] || fail "run.py $*: exit code $code: $(cat said.txt)"
  grep -q -e "$words" said.txt && ! grep -q points said.txt || fail "run.py $*: $(cat said.txt)"
}
refused 'unrecognized arguments: --speed' --speed
refused 'expected one argument' --quick --repetitions
refused '--repetitions 0: at least one' --quick --repetitions 0
refused 'there is no folder nowhere' --quick --pictures nowhere
refused 'there is no folder .*nowhere' --quick --write-baseline --baseline nowhere/new.csv
refused 'there is no baseline nowhere.csv' --quick --only ring --baseline nowhere.csv
echo study,label >columns.csv
refused 'columns.csv is no baseline.* no column cost_ratio, spread, error' --quick --only ring --baseline columns.csv
refused 'columns.csv is no baseline' --quick --only ring --write-baseline --baseline columns.csv
printf 'study,label,cost_ratio,spread,error\nring,analytic,1,,1\n' >numbers.csv
refused 'numbers.csv:2 is no row of a baseline' --quick --only ring --baseline numbers.csv
refused 'cannot write to --output columns.csv' --only ring --output columns.csv
refused 'cannot write to --output /proc/nothing' --only ring --output /proc/nothing
mkdir -p folder/vibrocontact fails
printf '#!/bin/sh\necho broken library; exit 3\n' >fails/vibrocontact
chmod +x fails/vibrocontact
refused 'no program folder/vibrocontact that can be executed' --list --build folder
refused 'fails/vibrocontact --parameters does not list the entries (broken library)' --list --build fails

$python -B - "$scripts" <<'END' || fail "what was not compared is not said"
import sys
sys.path.insert(0, sys.argv[1])
import baseline
from study import Point, Study

study = Study("one", "", "", "", "", {}, None)
study.points = [Point("default", "", [1.], 0., True), Point("new", "", [1.], 0.)]
row = {"study": "one", "label": "default"}
assert baseline.verdict([], [row], []) == ["No study was compared with the baseline: none was measured."]
assert baseline.verdict([study], [], []) == ["Not compared, as the baseline has no row of it: one.", "No study was compared with the baseline."]
assert baseline.verdict([study], [row], []) == ["Not compared, as the baseline has no row of it: one: new.",
                                                "Nothing of the 1 study compared became slower or less exact than the baseline."]
assert baseline.verdict([study], [row], ["worse"]) == ["Not compared, as the baseline has no row of it: one: new."]
END

# of two quantities, one point beats another only if it is no less exact in either; the baseline holds both errors, and the cost once
$python -B - "$scripts" <<'END' || fail "errors of two quantities"
import sys
sys.path.insert(0, sys.argv[1])
import baseline, report
from study import Point, Study

study = Study("two", "", "", "", "", {}, None, further={"impulse": ""})
study.points = [Point("default", "", [1.], 1., True, {}, {"impulse": 2.}), Point("other", "", [1.], 2., False, {}, {"impulse": 1.}),
                Point("worse", "", [1.], 2., False, {}, {"impulse": 2.})]
assert [point.label for point in study.front()] == ["default", "other"]
assert [point.label for point in study.better_than(study.points[0], ["impulse"])] == ["other"]
verdict = report.default_rows([study])[0][-1]
assert verdict.startswith("on the front; by impulse alone better: other"), verdict
baseline.write([study], "two.csv")
stored = baseline.read("two.csv")
assert [row["label"] for row in stored[:2]] == ["default", "default: impulse"] and baseline.worse([study], stored) == []
study.points[1].further["impulse"], study.points[1].seconds = 1.5, [9.]
assert [sentence.split(" became ")[1].split(":")[0] for sentence in baseline.worse([study], stored)] == ["slower", "less exact"]
END

cat >planted.csv <<'END'
study,label,cost_ratio,spread,error
ring,analytic,1,1,1e-6
ring,beam elements,1e-3,1,1
ring,solid elements,1,50,1e-5
END
code=0
$python -B "$scripts/run.py" --build "$build" --quick --repetitions 1 --only ring --output report --baseline planted.csv >said.txt || code=$?
[ $code = 2 ] || fail "exit code $code: $(cat said.txt)"
grep -q 'WORSE: ring: beam elements became slower' said.txt || fail "slower is not said: $(cat said.txt)"
grep -q 'WORSE: ring: solid elements became less exact' said.txt || fail "less exact is not said: $(cat said.txt)"
[ "$(grep -c WORSE said.txt)" = 2 ] || fail "more than was planted: $(cat said.txt)"
for file in report.html ring.png ring.csv; do
  [ -s report/$file ] || fail "no $file"
done
for words in 'Truth: the closed form order by order' 'solid elements became less exact' 'on the front' 'machine'; do
  grep -q "$words" report/report.html || fail "the report does not say: $words"
done
$python -B - <<'END' || fail "the table is wrong"
import csv
rows = list(csv.DictReader(line for line in open("report/ring.csv") if not line.startswith("#")))
assert [row["label"] for row in rows] == ["analytic", "beam elements", "solid elements"]
assert [row["default"] for row in rows] == ["1", "0", "0"]
assert all(float(row["cost_median_s"]) > 0 for row in rows)
assert float(rows[0]["error"]) < 1e-6 and float(rows[1]["error"]) < 1e-4 and float(rows[2]["error"]) < 1e-2
END

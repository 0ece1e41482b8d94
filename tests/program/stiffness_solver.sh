# The solver of a stiffness: --check names the one that the memory leaves, iterative answers are those of direct ones on one and
# two ranks, and a body that single precision cannot hold ends with exit code 2.
program=$1
cat >case.prm <<'END'
set Bodies = ball, cube
set Analyses = modes, quasi-static rolling
subsection ball
  set Type = rigid
  subsection Rigid
    set Radius x = 50
    set Radius y = 50
  end
end
subsection cube
  set Type = block
  subsection Block
    set Divisions x = 5
    set Divisions y = 5
    set Divisions z = 4
  end
  subsection Modes
    set Count = 6
  end
end
subsection Contact
  set Grid spacing         = 1e-2
  set Half length          = 3e-2
  set Half width           = 3e-2
  set Friction coefficient = 0.3
end
subsection Rolling
  set Normal force     = 1e4
  set Speed            = 10
  set Lateral creepage = 0.001
end
END
fail() { echo "$1"; exit 1; }

fine=(--set "cube/Block/Divisions x=20" --set "cube/Block/Divisions y=20" --set "cube/Block/Divisions z=20")
(ulimit -v 3400000; "$program" case.prm --check "${fine[@]}") | tee screen
grep -q "solver of its stiffness *iterative" screen || fail "a factor that the memory does not hold is not avoided"
"$program" case.prm --check | grep -q "solver of its stiffness *direct" || fail "a small body is not solved directly"

quiet=(--quiet --set "Output/Cache directory=" --set Output/Figures=false --set Output/Fields=false)
"$program" case.prm "${quiet[@]}" --set cube/Solver/Method=direct --output direct || fail "direct"
"$program" case.prm "${quiet[@]}" --set cube/Solver/Method=iterative --output iterative || fail "iterative"
mpirun --oversubscribe -n 2 "$program" case.prm "${quiet[@]}" --set cube/Solver/Method=iterative --output two || fail "two ranks"
grep -q "conjugate gradients" iterative/log.txt || fail "the steps are not said"
python3 - <<'PY' || fail "other answers"
import json


def answers(folder):
    results = json.load(open(folder + "/results.json"))["analyses"]
    rolling = results["quasi_static_rolling"]["cases"][0]
    statics = [rolling["approach_m"], rolling["max_pressure_Pa"]] + rolling["tangential_force_N"]
    return results["modes"]["cube"]["frequencies_Hz"], statics


direct = answers("direct")
for folder in ("iterative", "two"):
    for found, expected, tolerance in zip(answers(folder), direct, (1e-9, 1e-8)):
        assert len(found) == len(expected) and all(abs(a / b - 1) < tolerance for a, b in zip(found, expected)), (
            folder, found, expected)
PY

# 1 m long, 1 mm thick
code=0
"$program" case.prm "${quiet[@]}" --set Analyses=modes --output slender \
  --set cube/Block/Length=1 --set cube/Block/Width=1e-3 --set cube/Block/Height=1e-3 --set cube/Block/Held=left \
  --set "cube/Block/Divisions x=100" --set "cube/Block/Divisions y=1" --set "cube/Block/Divisions z=1" \
  --set cube/Solver/Method=iterative 2>message || code=$?
[ $code = 2 ] || fail "exit code of what does not converge"
cat message
grep -q "conjugate gradients leave a residual" message || fail "message of what does not converge"

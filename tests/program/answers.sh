# The terminal ends with the answer to what was asked, of every analysis, and results.json has the same lines.
program=$1
cp "$3/../tests/program/slider.prm" .
cat >>slider.prm <<'END'
subsection Output
  set Cache directory =
  set Figures = false
  set Fields = false
end
subsection Transient
  set Time step = 2e-6
  set End time = 0.004
  set Perturbed mode = slider:mode 1
  set Perturbation velocity = 1e-3
  subsection Signals
    set Probes = side: slider 0.03 0 0.02 along y
  end
end
END
"$program" slider.prm --set "Analyses=modes, quasi-static rolling, stability, transient" --output slider >screen
"$program" "$3/examples/bouncing_bar.prm" --set Output/Figures=false --output bar >bar_screen
python3 - <<'END'
import json
results = json.load(open("slider/results.json"))
answers, analyses = results["answers"], results["analyses"]
assert list(answers) == ["modes", "quasi-static rolling", "stability", "transient"], list(answers)
screen = [line.strip() for line in open("screen")]
last = [line for lines in answers.values() for line in lines]
assert [line for line in screen if line in last][-len(last):] == last, screen[-30:]
assert screen[-1] == answers["transient"][-1] and screen[-1].startswith("look at histories.h5"), screen[-1]
roots = analyses["stability"]["unstable"] or [analyses["stability"]["cases"][0]["nearest"]]
fastest = max(roots, key=lambda root: root["growth_1_s"])
text = "\n".join(answers["stability"])
assert f"{fastest['frequency_Hz']:.2f} Hz" in text and fastest["label"] in text, text
assert ("grow" if analyses["stability"]["unstable"] else "nothing grows") in answers["stability"][0], text
rolling = analyses["quasi_static_rolling"]["cases"][-1]
assert f"normal force {rolling['normal_force_N']:.6g} N" in "\n".join(answers["quasi-static rolling"]), answers
transient = analyses["transient"]
side = next(signal for signal in transient["signals"] if signal["name"] == "side_velocity")
assert f"level {side['level_dB']:.1f} dB (rms re 5e-08 m/s)" in "\n".join(answers["transient"]), answers["transient"]
# a velocity of amplitude a has the level 20 log10(a / sqrt(2) / 5e-8 m/s) if it is one sine
import math
assert abs(side["level_dB"] - 20 * math.log10(side["cycle"]["rms"] / 5e-8)) < 1.5, side
# the modes' own amplitudes: a table of them, and growth where they grow or decay exponentially
table = [line for line in open("slider/mode_amplitudes.csv") if not line.startswith("#")]
modes = transient["modes"]
assert table[0].strip().split(",") == ["time_s"] + [mode["column"] for mode in modes], table[0]
assert len(table) > 500
for mode in modes:
    assert mode["growth_1_s"] is None or mode["residual"] <= 0.05, mode
perturbed = next(mode for mode in modes if mode["label"] == "slider:mode 1")
assert abs(perturbed["growth_1_s"] / perturbed["root_growth_1_s"] - 1) < 0.01, perturbed
assert abs(perturbed["amplitude_begin_m_s"] / 1e-3 - 1) < 1e-3, perturbed
bar = json.load(open("bar/results.json"))
assert bar["analyses"]["transient"]["estimated_error"] < 0.02
assert any("estimated error of the steps" in line for line in bar["answers"]["transient"]), bar["answers"]
END

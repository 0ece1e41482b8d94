# What is doubtful is said with numbers, on standard error and in results.json, what is useless ends with exit code 2; what replaces
# what, in the log.
program=$1
bar="$3/examples/bouncing_bar.prm"
"$program" "$bar" --quiet --set Output/Figures=false --output good
"$program" "$bar" --quiet --set Output/Figures=false --set "Transient/Integrator=exact propagator" \
  --set "Transient/Time step=0.1" --set "Transient/Signals/Spectrum duration=50" --output long 2>warnings && code=0 || code=$?
[ $code = 2 ] || { echo "FAILED: exit code $code where a seventh of the energy is lost"; exit 1; }
python3 - <<'END'
import json
good, long = (json.load(open(f"{name}/results.json")) for name in ("good", "long"))
assert "messages" not in good, good["messages"]
assert good["status"] == "converged" and good["analyses"]["transient"]["estimated_error"] < 0.01, good
assert long["status"] == "not converged" and long["not_converged"][0]["analysis"] == "transient", long
assert long["analyses"]["transient"]["impulse_Ns"] > 0 and "estimated_error" in long["analyses"]["transient"]
text = "\n".join(long["messages"])
energy = long["analyses"]["transient"]["energy"]
assert abs(energy["imbalance_J"]) > 0.05 * energy["initial_J"], energy
for part in ("energy account of the transient does not close: 500 J at the start", f"imbalance is {energy['imbalance_J']:.3g} J",
             "reactions that are linear in the step ring", "Spectrum duration is 50 s, longer than the run of 1.5 s"):
    assert part in text, (part, text)
    assert part in open("warnings").read().replace("\n", " "), part
END
"$program" "$3/examples/rolling_transient.prm" --set "Transient/Hub displacement=1e-4*t" --check >screen
grep -q "driven by its own hub displacement: Rolling/Normal force, 66000 N, is not used" screen ||
  { echo "FAILED: nothing about the normal force"; cat screen; exit 1; }

# theta takes (theta - 1/2) w^2 h from the growth of a mode: of the one that is perturbed no more than its own damping does, and a fifth
# of it by the end
perturbed() {
  "$program" "$bar" --quiet --set Output/Figures=false --set Transient/Theta=0.6 --set "Transient/Perturbed mode=bar:mode 1" \
    --set "Transient/Perturbation velocity=0.1" --set "Transient/Time step=$1" --output perturbed 2>warnings && code=0 || code=$?
}
perturbed 0.1
[ $code = 1 ] && grep -q "Theta is 0.6, so that the steps take .* from the growth of bar:mode 1 at" warnings ||
  { echo "FAILED: exit code $code where theta damps the mode"; cat warnings; exit 1; }
step=$(grep -o "Time step of [0-9.e-]* s" warnings | cut -d' ' -f4)
perturbed "$step"
[ $code != 1 ] || { echo "FAILED: the step that is said is refused as well: $step"; cat warnings; exit 1; }

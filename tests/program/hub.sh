# A load finds the hub's place and the hub is then held there: stability and transient by a normal force are those by the
# displacement that it makes. A massless or suspended hub follows, and results.json says which one applied.
program=$1
{ echo "set Analyses = quasi-static rolling, stability, transient"; cat "$(dirname "$0")/slider.prm" - <<'END_OF_FILE'
subsection Output
  set Figures = false
end
subsection Transient
  set Time step = 5e-6
  set End time = 5e-4
  set Perturbed mode = slider:mode 1
  set Perturbation = 1e-8
end
END_OF_FILE
} >case.prm
run() { folder=$1; shift; "$program" case.prm --output "$folder" --set "Contact/Lateral position=-0.005" "$@" >"$folder.screen"; }
springs=(--set "Rolling/Suspension/Stiffness x=1e6" --set "Rolling/Suspension/Stiffness y=1e6" --set "Rolling/Suspension/Stiffness z=1e6")
run displacement
force=$(python3 -c 'import json; print(json.load(open("displacement/results.json"))["analyses"]["quasi_static_rolling"]["cases"][0]["normal_force_N"])')
run force --set "Rolling/Normal force=$force"
run massless --set "Rolling/Normal force=$force" --set Rolling/Hub=massless
run massless_place --set Rolling/Hub=massless
run heavy --set "Rolling/Normal force=$force" --set Rolling/Hub=suspended --set "Rolling/Suspension/Unsprung mass=1e9" "${springs[@]}"
run light --set "Rolling/Normal force=$force" --set Rolling/Hub=suspended --set "Rolling/Suspension/Unsprung mass=1" \
  "${springs[@]}" --set "Rolling/Suspension/Damping z=100"
run load --set Analyses=transient --set "Transient/Normal force=$force*(1+t)"
run load_light --set Analyses=transient --set "Transient/Normal force=$force*(1+200*t)" \
  --set Rolling/Hub=suspended --set "Rolling/Suspension/Unsprung mass=1" "${springs[@]}"
grep -q "hub.*massless: moved by the load Transient/Normal force, so that it is not held" load.screen
python3 - <<'END'
import json
names = ("displacement", "force", "massless", "massless_place", "heavy", "light", "load", "load_light")
runs = {name: json.load(open(f"{name}/results.json"))["analyses"] for name in names}
hubs = {name: run["transient"]["hub"] for name, run in runs.items()}
assert hubs == {"displacement": "held", "force": "held", "massless": "massless", "massless_place": "massless",
                "heavy": "suspended", "light": "suspended", "load": "massless", "load_light": "suspended"}, hubs
def roots(name):
    case = runs[name]["stability"]["cases"][0]
    assert case["hub"] == runs[name]["stability"]["hub"] == hubs[name]
    return [(root["frequency_Hz"], root["growth_1_s"]) for root in case["unstable"] if root["frequency_Hz"] > 1]
def same(a, b, tolerance):
    assert len(roots(a)) == len(roots(b)), (a, b, roots(a), roots(b))
    for (f, s), (g, t) in zip(roots(a), roots(b)):
        assert abs(f / g - 1) < tolerance and abs(s / t - 1) < tolerance, (a, b, f, g, s, t)
for name in names[:6]:
    print(name, roots(name), runs[name]["transient"]["impulse_Ns"])
assert len(roots("displacement")) > 0
same("force", "displacement", 1e-4)
same("heavy", "displacement", 1e-4)
same("massless_place", "massless", 1e-4)
assert roots("massless") != roots("force") and roots("light") != roots("force")
impulse = lambda name: runs[name]["transient"]["impulse_Ns"]
assert abs(impulse("force") / impulse("displacement") - 1) < 1e-6
assert abs(impulse("heavy") / impulse("displacement") - 1) < 1e-6
place, own = runs["force"]["transient"]["hub_displacement_m"], runs["displacement"]["quasi_static_rolling"]["cases"][0]["approach_m"]
assert abs(place / own - 1) < 1e-5, (place, own)
# the massless hub: the force is as given at every instant
end = runs["massless"]["transient"]["time_s"]
force = runs["displacement"]["quasi_static_rolling"]["cases"][0]["normal_force_N"]
assert abs(impulse("massless") / (force * end) - 1) < 1e-6
assert abs(impulse("load") / (force * end * (1 + end / 2)) - 1) < 1e-6
# a free mass under a growing load: more than the constant force, less than the load by the mass that is accelerated
assert 1.0 < impulse("load_light") / (force * end) < 1 + 100 * end
for name in ("displacement", "light"):
    energy = runs[name]["transient"]["energy"]
    assert abs(energy["imbalance_J"]) < 1e-3 * energy["initial_J"], (name, energy)
END

# --check with an output folder draws the scene: bodies with a mesh by their surfaces, others by their sizes.
program=$1
for name in half_space_rolling bouncing_bar tyre_three_points blade_rub; do
  "$program" "$3/examples/$name.prm" --check --output "$name" >"$name.log"
  grep -q "The file is valid; nothing was run." "$name.log"
  [ ! -e "$name/results.json" ]
done
python3 - <<'END'
import json
import os
ring, blade = (json.load(open(f"{name}/scene.json"))["bodies"][0] for name in ("tyre_three_points", "blade_rub"))
assert ring["type"] == "ring" and ring["radius_m"] > 0 and "surface" not in ring, ring
assert os.path.getsize(os.path.join("blade_rub", blade["surface"])) > 10000, blade
grid = json.load(open("half_space_rolling/scene.json"))["contacts"][0]["grid"]
assert grid["n_x"] * grid["n_y"] == 357, grid
END
for name in half_space_rolling bouncing_bar tyre_three_points blade_rub; do
  grep -q "no figures: Python's matplotlib" "$name.log" || [ -s "$name/figures/scene.png" ]
done

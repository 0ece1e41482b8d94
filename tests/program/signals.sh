# Probes, frames of the patch, table and sound of a transient: the sound is the velocity, by its scale, at 48 kHz.
program=$1
cp "$3/../tests/transient/linear_mode.prm.in" case.prm
"$program" case.prm --quiet --set Output/Figures=false --set "Transient/Signals/Patch interval=0.01" --output out
python3 - <<'END'
import math, struct, wave
sound = wave.open("out/tip_velocity.wav")
assert (sound.getframerate(), sound.getnchannels(), sound.getsampwidth()) == (48000, 1, 3), sound.getparams()
data = sound.readframes(sound.getnframes())
values = [int.from_bytes(data[k:k + 3], "little", signed=True) / 2**23 for k in range(0, len(data), 3)]
assert abs(len(values) - 2400) < 3, len(values)
scale = float(open("out/tip_velocity.wav.txt").read().split("=")[1].split()[0])
assert abs(max(map(abs, values)) - 0.9) < 1e-6
lines = [line for line in open("out/histories.csv") if not line.startswith("#")]
header = lines[0].strip().split(",")
assert header[-4:] == ["tip_displacement_m", "tip_velocity_m_s", "upper_displacement_m", "upper_velocity_m_s"], header
assert len(lines) == 502, len(lines)
# 0.3 m/s at the beginning; a quarter period, 2e-4 s, later the displacement is 0.3 / (2 pi f)
first, third = ([float(x) for x in lines[k].split(",")] for k in (1, 3))
v = first[-3]
assert abs(abs(v) - 0.3) < 1e-7 and abs(third[-4] / (v / 7854) - 1) < 2e-3, (first, third)
# v cos(2 pi f t) exp(-7.854 t), apart from the faded ends
worst = max(abs(values[k] * scale - v * math.cos(2 * math.pi * 1250 * k / 48000) * math.exp(-7.85398 * k / 48000))
            for k in range(200, 2200))
assert worst < 3e-4, worst
pvd = open("out/patch.pvd").read()
assert pvd.count("DataSet") == 6, pvd
END
[ -f out/fields/patch_0005.vtu ] || { echo "FAILED: no frames"; exit 1; }

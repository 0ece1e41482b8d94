"""Limit cycles by Newton's method on a period of steps and by harmonic balance, beside the march that settles on them."""
import program
from study import Point, Study

PAD = "contrib/benchmarks/pad.prm"
INTEGRATOR = "Transient/Integrator"
SIGNAL = "side_velocity"
# steps have no default: that of a period in 500
MARKED_STEP = 2e-7


def limit_cycle(bench, entries, step, repetitions=None):
    """Frequency [Hz] and rms velocity [m/s] of the pad's side, and what it took from its unstable root on."""
    runs = bench.run(PAD, {**entries, "Limit cycle/Time step": step, "Limit cycle/Multipliers": 0}, cached=True, repetitions=repetitions)
    cycles = [run["analyses"]["limit_cycle"][0] for run in runs.results]
    rms = next(signal["rms"] for signal in cycles[-1]["signals"] if signal["name"] == SIGNAL + "_m_s")
    return (cycles[-1]["frequency_Hz"], rms), [cycle["seconds"] for cycle in cycles]


def harmonic_balance(bench, entries, step, harmonics):
    """The same by harmonics, which begin at the cycle by steps: the time of both. A list with one item per number of harmonics."""
    runs = bench.run(PAD, {**entries, "Limit cycle/Time step": step, "Limit cycle/Multipliers": 0,
                           "Limit cycle/Harmonics": ", ".join(str(one) for one in harmonics)}, cached=True)
    cycles = [run["analyses"]["limit_cycle"][0] for run in runs.results]
    return [((one["frequency_Hz"], one["rms"]), [cycle["seconds"] + cycle["harmonic_balance"][k]["seconds"] for cycle in cycles])
            for k, one in enumerate(cycles[-1]["harmonic_balance"])]


def march(bench, entries, step):
    """The same of a transient over two hundred periods, from five quarters of the amplitude; its last hundred are looked at."""
    runs = bench.run(PAD, {**entries, "Analyses": "transient", "Transient/Time step": step, "Transient/End time": 0.02,
                           "Transient/Perturbed mode": "pad:mode 2", "Transient/Perturbation velocity": 0.1,
                           "Transient/Signals/Spectrum duration": 0.01, "Transient/Error estimate": "false"}, cached=True, repetitions=1)
    found = runs.analysis("transient")
    cycle = next(signal["cycle"] for signal in found["signals"] if signal["name"] == SIGNAL)
    return (cycle["frequency_Hz"], cycle["rms"]), [found["seconds_per_step"] * found["steps"]]


def pad(bench):
    """Limits of steps that vanish: both integrators have errors of first order in the frequency, by the rate of the residual
    flexibility, and share the limit; the rms velocity of their finest steps."""
    (coarse, _), _ = limit_cycle(bench, {INTEGRATOR: "exact propagator"}, 5e-8, 1)
    (fine, rms), _ = limit_cycle(bench, {INTEGRATOR: "exact propagator"}, 2.5e-8, 1)
    limit = 2 * fine - coarse
    points = []
    for integrator in ("theta method", "exact propagator"):
        entries = {INTEGRATOR: integrator}
        for step in (4e-7, 2e-7) if bench.quick else (8e-7, 4e-7, 2e-7, 1e-7, 5e-8):
            for name, way in (("limit cycle", limit_cycle), ("march", march)):
                if name == "march" and (step < 2e-7 or bench.quick and step < 4e-7):
                    continue
                found, seconds = way(bench, entries, step)
                points.append(Point(f"{name}, {integrator}, step {step:g} s", f"{name}, {integrator}", seconds, abs(found[0] / limit - 1),
                                    name == "limit cycle" and integrator == "theta method" and step == MARKED_STEP, entries,
                                    {"rms velocity": abs(found[1] / rms - 1)}))
    harmonics, step = (5, 20) if bench.quick else (2, 5, 10, 20, 40), 8e-7
    entries = {INTEGRATOR: "exact propagator"}
    for number, (found, seconds) in zip(harmonics, harmonic_balance(bench, entries, step, harmonics)):
        points.append(Point(f"harmonic balance, {number} harmonics", "harmonic balance", seconds, abs(found[0] / limit - 1), False, entries,
                            {"rms velocity": abs(found[1] / rms - 1)}))
    return points


STUDIES = [
    Study("limit_cycle", "Squeal of a pad: its limit cycle at once, and by a march that settles",
          "the limit of vanishing steps, which both integrators share; the march settles on the same motion by itself.",
          "seconds of the clock, from the unstable root or the disturbance on [s]", "frequency [-]", {INTEGRATOR: ["theta method", "exact propagator"]},
          pad, floor=1e-7, further={"rms velocity": "rms velocity [-]"},
          reason="the exact propagator is a line of the file: see transient_free")]

"""Shipped scenes, what is asked of each, and which entries make its model smaller: the table of smallest_models.py.

Values of a knob run from small to fine; the last is the truth of the knob. Entries that go with a knob (an element length with its
step) stand in the same dictionary. Errors are relative to the quantity; of several numbers the largest one counts, each over its scale.
"""
from dataclasses import dataclass, field

import program


@dataclass
class Knob:
    """name, values by label from small to fine as entries, and the label of what the file ships."""
    name: str
    shipped: str
    values: dict


@dataclass
class Scene:
    """file       below parameter_files/examples
    quantity   in words
    ask        function of an analyses object of results.json, and beside the analyses the "folder" of its tables: numbers by name
    knobs      entries to vary, one at a time
    base       entries of all runs of the study: what the quantity does not need is switched off
    exact      closed form by name, where there is one
    scale      what errors are over: "each" number itself, or the "largest" of them
    expensive  runs only when named or with --expensive"""
    file: str
    quantity: str
    ask: object
    knobs: list
    base: dict = field(default_factory=dict)
    exact: dict = field(default_factory=dict)
    scale: str = "each"
    expensive: bool = False


def one(name, entry, shipped, *values, more=None):
    """Knob of one entry; more(value): entries that go with it."""
    return Knob(name, str(shipped), {str(value): {entry: value, **(more(value) if more else {})} for value in values})


def growths(analyses):
    """Growth rates of the unstable roots by name [1/s]."""
    return {root["label"]: root["growth_1_s"] for root in analyses["stability"]["unstable"]}


def rim_growth(analyses):
    """Growth rate [1/s] and frequency [Hz] of the largest motion of the rim in a transient."""
    growth = next(one for one in analyses["transient"]["signals"] if one["name"] == "wheel_rim_axial_velocity")["growth"][0]
    return {"growth": growth["growth_1_s"], "frequency": growth["frequency_Hz"]}


def cycle(analyses):
    """Frequency [Hz] and rms of the rim's axial velocity [m/s] in the first limit cycle."""
    found = analyses["limit_cycle"][0]
    rms = next(one["rms"] for one in found["signals"] if one["name"] == "wheel_rim_axial_velocity_m_s")
    return {"frequency": found["frequency_Hz"], "velocity": rms}


def friction_energy(analyses):
    """Energy that friction takes in a transient [J]."""
    return {"energy": analyses["transient"]["energy"]["friction_J"]}


def lowest_growth(analyses):
    """Growth rate and frequency of the unstable root of the lowest frequency [1/s, Hz]."""
    root = min(analyses["stability"]["unstable"], key=lambda root: root["frequency_Hz"])
    return {"growth": root["growth_1_s"], "frequency": root["frequency_Hz"]}


def forces(analyses):
    """Tangential forces and normal force of all rolling cases, over the normal force."""
    rolling = analyses["quasi_static_rolling"]
    return {f"case {k} {axis}": case["tangential_force_N"][i] / case["normal_force_N"]
            for k, case in enumerate(rolling["cases"]) for i, axis in enumerate("xy")}


def contact_loads(analyses):
    """Normal force of each of several contacts [N]."""
    contacts = analyses["quasi_static_rolling"]["contacts"]
    return {name: contact["cases"][0]["normal_force_N"] for name, contact in contacts.items()}


def motion(analyses):
    """Swing of the tip [m], impulse [N s] and energy [J] of a periodic motion."""
    found = analyses["periodic"][0]
    return {"swing": found["tip_max_m"] - found["tip_min_m"], "impulse": found["impulse_Ns"][0], "energy": found["energy_norm_J"]}


def contact_range(analyses):
    """From the first grazing to the highest fold [Hz], 0 without them."""
    response = analyses["response"]
    return {"contact range": max(response["folds_Hz"], default=0.) - min(response["grazing_Hz"], default=0.)}


def impulse(analyses):
    """Impulse of a transient [N s]."""
    return {"impulse": analyses["transient"]["impulse_Ns"]}


def impulses(analyses):
    """Impulses of the points of a modal convolution [N s]; the largest is their scale."""
    return {f"point {k}": value for k, value in enumerate(analyses["modal_convolution"]["impulse_Ns"])}


def friction_work(analyses):
    """Work of friction of a modal convolution [J]."""
    return {"friction": analyses["modal_convolution"]["friction_J"]}


def end_force(analyses):
    """Tangential force at the end and impulse of a transient [N, N s]."""
    return {"end": analyses["transient"]["last"]["tangential_force_N"][1]}


def levels(analyses):
    """Magnitudes of all mobilities of a point under a force at itself [m/(N s)], at every frequency."""
    found = {}
    for row in program.read_table(f"{analyses['folder']}/frequency_response_rail.csv"):
        for column, value in row.items():
            words = column.removesuffix("_real_m_Ns").split("_")
            if column.endswith("_real_m_Ns") and words[:2] == words[2:]:
                found[f"{words[0]} {words[1]}, {float(row['frequency_Hz']):.0f} Hz"] = abs(
                    complex(float(value), float(row[column.replace("real", "imag")])))
    return found


def irregular_levels(analyses):
    """Magnitudes of the mobilities on a track that scatters [m/(N s)], at every frequency."""
    return {f"{column}, {float(row['frequency_Hz']):.0f} Hz": float(row[column])
            for row in program.read_table(f"{analyses['folder']}/irregular_track_rail.csv") for column in ("midspan_z_m_Ns", "midspan_y_m_Ns")}


def peak(analyses):
    """Largest vertical mobility mid-span [m/(N s)] and its frequency [Hz]."""
    maxima = analyses["frequency_response"]["bodies"]["rail"]["maxima"]
    highest = max((one for one in maxima if one["point"] == "midspan_z"), key=lambda one: one["magnitude"])
    return {"magnitude": highest["magnitude"], "frequency": highest["frequency_Hz"]}


def truncation(analyses):
    """One plus the error E of the receptance at the driving point by the poles that contact runs with."""
    return {"poles": 1 + next(one for one in analyses["frequency_response"]["bodies"]["tyre"]["truncation"] if one["poles"])["error_E_driving_point"]}


def time_in_contact(analyses):
    """Share of the time in contact, of every case of a sweep [-]."""
    return {f"case {k}": case["modal_convolution"]["closed_points_mean"] for k, case in enumerate(analyses["modal_convolution_sweep"]["cases"])}


def fit(analyses):
    """One plus the error E of the fitted poles: what is left to one is E itself."""
    return {"fit": 1 + analyses["identification"][0]["error_E"]}


NO_PAIRS = {"Periodic/Comparison/Pairs": "", "Periodic/Reference": "false"}
NO_ESTIMATE = {"Transient/Error estimate": "false"}
SIX = {"Frequency response/Number of frequencies": 6, "Frequency response/Refined frequencies": 0}
# of periodic_track.prm, whose section is the same
RAIL_LEVELS = {"midspan z, 265 Hz": 6.21574e-6, "midspan y, 265 Hz": 3.25405e-5, "support z, 265 Hz": 5.57112e-6,
               "midspan z, 1061 Hz": 1.286980e-5, "midspan y, 1061 Hz": 1.541920e-5, "support z, 1061 Hz": 1.928724e-6,
               "midspan z, 4244 Hz": 3.193185e-6, "midspan y, 4244 Hz": 2.182142e-5, "support z, 4244 Hz": 4.058935e-6}
FUNCTIONS = (15, 31, 63, 127, 255)


def bar_knobs(functions, *numbers):
    return [one("functions", "Periodic/Number of functions", functions, *numbers),
            one("elements", "bar/Bar/Divisions", 25, 10, 15, 25, 50, 100),
            Knob("modes", "all", {**{str(n): {"Periodic/Model": "reduced", "bar/Modes/Count": n} for n in (2, 5, 10)}, "all": {}})]


SCENES = [
    Scene("axial_bar_150", "swing, impulse and energy of the periodic motion", motion, bar_knobs(127, *FUNCTIONS), NO_PAIRS),
    Scene("axial_bar_1275", "swing, impulse and energy of the periodic motion", motion, bar_knobs(127, *FUNCTIONS), NO_PAIRS),
    Scene("axial_bar_signorini", "swing, impulse and energy of the periodic motion", motion, bar_knobs(63, *FUNCTIONS), NO_PAIRS),
    Scene("axial_bar_response", "frequencies in contact: first grazing to fold", contact_range,
          bar_knobs(63, 15, 31, 63, 127), {"Periodic/Continuation/Pairs": "", "Periodic/Continuation/Location tolerance": 1e-3}),
    Scene("blade_rub", "frequencies in contact: first grazing to fold", contact_range,
          [one("functions", "Periodic/Number of functions", 101, 15, 31, 63, 101, 201), one("modes", "blade/Modes/Count", 20, 1, 3, 6, 10, 20, 40),
           Knob("elements", "16 x 8, degree 3", {
               "8 x 4, degree 2": {"blade/Blade/Length divisions": 8, "blade/Blade/Chord divisions": 4, "blade/Blade/Element degree": 2},
               "8 x 4, degree 3": {"blade/Blade/Length divisions": 8, "blade/Blade/Chord divisions": 4},
               "16 x 8, degree 3": {}, "24 x 12, degree 3": {"blade/Blade/Length divisions": 24, "blade/Blade/Chord divisions": 12}})],
          {"Periodic/Continuation/Pairs": "", "Periodic/Continuation/Numbers": ""}),
    Scene("bouncing_bar", "impulse, closed form 200 N s", impulse,
          [one("modes", "bar/Modes/Count", 20, 5, 10, 20, 40), one("step, s", "Transient/Time step", 1e-3, 4e-3, 2e-3, 1e-3, 5e-4)],
          NO_ESTIMATE, {"impulse": 200.}),
    Scene("bouncing_bar_gravity", "impulse, closed form 1600 N s", impulse,
          [one("elements and step", "bar/Bar/Divisions", 200, 25, 50, 100, 200, 400, more=lambda n: {"Transient/Time step": 10 / n / 120})],
          NO_ESTIMATE, {"impulse": 1600.}),
    Scene("carter", "force over mu N, closed form 0.64", forces,
          [one("grid, m", "Contact/Grid spacing", 0.0005, 2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4)],
          {}, {"case 0 x": -0.64 * 0.3, "case 0 y": 0.}, "largest"),
    Scene("lap_joint", "energy that friction takes", friction_energy,
          [one("step, s", "Transient/Time step", 2e-06, 8e-6, 4e-6, 2e-6, 1e-6),
           one("modes of each bar", "upper/Modes/Count", 20, 5, 10, 20, 30, more=lambda count: {"lower/Modes/Count": count})],
          {}, {}, "each", True),
    Scene("creep_curves", "creep forces of all cases over mu N", forces,
          [one("grid, m", "Contact/Grid spacing", 0.0015, 2e-3, 1.5e-3, 1e-3, 5e-4)], {}, {}, "largest"),
    Scene("half_space_rolling", "creep force over mu N", forces,
          [one("grid, m", "Contact/Grid spacing", 0.001, 3e-3, 2e-3, 1.5e-3, 1e-3, 5e-4, 2.5e-4)], {}, {}, "largest"),
    Scene("rolling_transient", "lateral force at the end, limit of the creep force 0.712 mu N", end_force,
          [one("grid, m", "Contact/Grid spacing", 0.001, 2e-3, 1.5e-3, 1e-3, 5e-4),
           Knob("step, s", "1e-05", {str(h): {"Transient/Time step": h} for h in (1e-4, 4e-5, 2e-5, 1e-5, 5e-6)})],
          {"Analyses": "transient", **NO_ESTIMATE}, {"end": -0.712 * 0.3 * 66000}),
    Scene("several_contacts", "normal forces of both contacts", contact_loads,
          [Knob("grid and elements", "2 mm", {
              "2 mm": {}, "1 mm": {"block/Block/Divisions x": 30, "block/Block/Divisions y": 14, "block/Block/Divisions z": 4,
                                   "left/Grid spacing": 1e-3, "right/Grid spacing": 1e-3, "left/Half width": 3e-3, "right/Half width": 3e-3}})],
          {"Analyses": "quasi-static rolling"}, {}, "largest"),
    Scene("disc_brake", "growth and frequency of the unstable root at friction 0.6", lowest_growth,
          [one("modes of each pad", "pad_above/Modes/Count", 40, 10, 20, 40, 80, 160, more=lambda n: {"pad_below/Modes/Count": n}),
           one("modes of the disc", "disc/Modes/Count", 60, 30, 60, 120, 240),
           Knob("cells of a pad", "3 x 10 x 2", {
               f"{x} x {y} x {z}": {f"{pad}/Block/Divisions {axis}": n for pad in ("pad_above", "pad_below")
                                    for axis, n in zip("xyz", (x, y, z))}
               for x, y, z in ((3, 5, 2), (3, 10, 2), (6, 10, 4))})],
          {"Analyses": "stability", "Stability/Sweep/Entry": "", "Stability/Sweep/Range": "", "upper/Friction coefficient": 0.6,
           "lower/Friction coefficient": 0.6}),
    Scene("sliding_layer", "growth and frequency of the lowest unstable root", lowest_growth,
          [Knob("elements", "16 x 8", {f"{2 * n} x {n}": {"layer/Layer/Divisions x": 2 * n, "layer/Layer/Divisions z": n} for n in (4, 8, 12, 16)}),
           one("degree", "layer/Layer/Element degree", 1, 1, 2)], {"Analyses": "stability"}),
    Scene("identify_tyre", "error E of the fit", fit,
          [one("pairs of poles", "Identification/Numbers of pole pairs", "16, 25", 8, 12, 16, 20, 25, 30)],
          {"Identification/Method": "vector fitting", "Identification/Stabilisation chart": "false"}, {"fit": 1.}),
    Scene("tyre_from_data", "impulses, those of the ring itself known", impulses,
          [one("pairs of poles", "Identification/Numbers of pole pairs", 25, 8, 12, 16, 20, 25, 30),
           one("step, s", "Modal convolution/Time step", 2e-05, 8e-5, 4e-5, 2e-5, 1e-5)], {}, {}, "largest"),
    Scene("oscillator_on_belt", "work of friction", friction_work,
          [one("step, s", "Modal convolution/Time step", 2.5e-05, 4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5)]),
    Scene("oscillator_on_sine", "impulse", impulses, [one("step, s", "Modal convolution/Time step", 0.0001, 1e-3, 4e-4, 1e-4, 5e-5)]),
    Scene("tyre_three_points", "impulses of the points", impulses,
          [one("orders", "tyre/Ring/Highest order", 60, 10, 20, 30, 40, 50, 60, 120),
           one("step, s", "Modal convolution/Time step", 2e-05, 1.6e-4, 8e-5, 4e-5, 2e-5, 1e-5)], {}, {}, "largest"),
    Scene("tyre_rolling", "impulse of all points", lambda analyses: {"impulse": sum(analyses["modal_convolution"]["impulse_Ns"])},
          [one("orders", "tyre/Ring/Highest order", 50, 20, 30, 40, 50, 80),
           Knob("points", "100", {str(n): {"tyre/Ring/Contact points": n, "tyre/Ring/Contact spacing": 0.12 / n, "tyre/Ring/Tread stiffness": 4032000 / n}
                                  for n in (25, 50, 100, 200)}),
           one("step, s", "Modal convolution/Time step", 1.953125e-05, 7.8125e-5, 3.90625e-5, 1.953125e-5, 9.765625e-6)],
          {"Modal convolution/End time": 0.1}),
    Scene("ring_green_functions", "error E of the poles that contact runs with, driving point", truncation,
          [one("orders", "tyre/Ring/Highest order", 60, 5, 10, 15, 20, 25, 40, 60)],
          {"Frequency response/Truncated orders": "", "Frequency response/Impulse response time": 0}, {"poles": 1.}),
    Scene("speeds_over_a_sine", "share of the time in contact, 24 cases", time_in_contact,
          [one("step, s", "Modal convolution/Time step", 4e-05, 1.6e-4, 8e-5, 4e-5, 2e-5, 1e-5, 5e-6)],
          {"Modal convolution/Error estimate": "false"}, {}, "largest"),
    Scene("periodic_track", "peak mid-span, its level and frequency", peak,
          [Knob("frequencies", "24 and 24", {f"{n} and {n}": {"Frequency response/Number of frequencies": n, "Frequency response/Refined frequencies": n}
                                             for n in (6, 12, 24)})],
          {"Frequency response/Points": "midspan: 0, 0, z"}),
    Scene("periodic_track", "vertical and lateral mobilities at six frequencies", levels,
          [one("degree", "rail/Rail/Element degree", 2, 1, 2, 3)], SIX),
    Scene("random_track", "mobilities mid-span at six frequencies", irregular_levels,
          [one("degree", "rail/Rail/Element degree", 2, 1, 2, 3), one("supports", "rail/Rail/Supports", 40, 10, 20, 40, 80)], {**SIX, "Frequency response/Pass bands": "false"}),
    Scene("rail_mobility", "mobilities of the solid rail at 265, 1061 and 4244 Hz, those of the rail without ends known", levels,
          [Knob("length, m", "24", {str(n): {"rail/Rail/Length": n} for n in (12, 24, 36)})],
          {"Frequency response/Bodies": "rail", "Frequency response/First frequency": 265.25, "Frequency response/Last frequency": 4244,
           "Frequency response/Number of frequencies": 3, "Frequency response/Refined frequencies": 0}, RAIL_LEVELS, "each", True),
    Scene("wheel_study", "growth of the unstable roots", growths,
          [one("modes to, Hz", "wheel/Modes/Upper frequency", 6000, 4500, 6000, 9000), one("grid, m", "Contact/Grid spacing", 0.0015, 3e-3, 1.5e-3, 1e-3, 7.5e-4),
           one("section cells, m", "wheel/Wheel/Section cell size", 0.012, 24e-3, 12e-3, 8e-3)], {"Analyses": "stability"}, {}, "largest", True),
    Scene("curve_squeal", "growth of the unstable roots", growths,
          [one("modes to, Hz", "wheel/Modes/Upper frequency", 8000, 4000, 6000, 8000, 12000), one("grid, m", "Contact/Grid spacing", 0.001, 2e-3, 1e-3, 7.5e-4)],
          {"Analyses": "stability"}, {}, "largest", True),
    Scene("curve_squeal", "growth and frequency of the rim's axial motion, first 0.05 s", rim_growth,
          [one("step, s", "Transient/Time step", 2e-06, 8e-6, 4e-6, 2e-6, 1e-6)],
          {"Transient/End time": 0.05, "Transient/History interval": 2.4e-5, "Transient/Error estimate": "false",
           "Transient/Signals/Patch begin": 0, "Transient/Signals/Patch interval": 0}, {}, "each", True),
    Scene("squeal_cycles", "frequency and rms velocity of the rim in the cycle at 917 Hz", cycle,
          [one("step, s", "Limit cycle/Time step", 2e-05, 4e-5, 2e-5, 1e-5, 5e-6),
           one("modes to, Hz", "wheel/Modes/Upper frequency", 8000, 4000, 6000, 8000, 12000), one("grid, m", "Contact/Grid spacing", 0.001, 2e-3, 1e-3)],
          {"Analyses": "limit cycle", "Limit cycle/Roots": 917, "Limit cycle/Multipliers": 0, "wheel/Wheel/Model": "harmonics"}, {}, "each", True),
    Scene("squeal_map", "growth of the unstable roots at one place", growths,
          [one("modes to, Hz", "wheel/Modes/Upper frequency", 5000, 3000, 5000, 8000), one("rail's modes to, Hz", "rail/Modes/Upper frequency", 5000, 3000, 5000, 10000),
           one("grid, m", "Contact/Grid spacing", 0.002, 2e-3, 1e-3, more=lambda h: {"wheel/Wheel/Contact cell size": 2 * h})],
          {"Stability/Sweep/Entry": "", "Stability/Sweep/Range": "", "Stability/Sweep/Second entry": "", "Stability/Sweep/Second values": ""}, {}, "largest", True),
    Scene("wheel_on_rail", "forces over the normal force", forces,
          [one("grid, m", "Contact/Grid spacing", 0.001, 4e-3, 2e-3, 1e-3)],
          {"Analyses": "quasi-static rolling"}, {}, "largest", True),
    Scene("curve_squeal_solid", "growth of the unstable roots", growths,
          [one("modes to, Hz", "wheel/Modes/Upper frequency", 8000, 5000, 8000), one("rail's modes to, Hz", "rail/Modes/Upper frequency", 5000, 2500, 3500, 5000),
           one("grid, m", "Contact/Grid spacing", 0.001, 2e-3, 1e-3)],
          {"Analyses": "quasi-static rolling, stability"}, {}, "largest", True),
]

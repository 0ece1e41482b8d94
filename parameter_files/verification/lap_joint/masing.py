"""Masing's rule: a mass on a joint whose loops follow from its backbone f(u), the force of the first loading.

From any turning point (x0, f0) on, the joint pulls with F = f0 -+ 2 f(|x - x0| / 2), as long as ways get shorter: it remembers f0, not where it would
stand without friction. A mass goes on until F has done no work. So half the way, a, tells all of a half cycle: what friction takes, its time, and the
forces at its ends. No number but those of the loading goes in.
"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "contrib", "python"))
import vibrocontact as vc  # noqa: E402
from vibrocontact import prm  # noqa: E402


class Backbone:
    """f(u) between the steps of a loading, linear, and its integral."""

    def __init__(self, displacement, force):
        self.u, self.f = np.asarray(displacement), np.asarray(force)
        self.energy = np.append(0, np.cumsum(np.diff(self.u) * (self.f[1:] + self.f[:-1]) / 2))

    def force(self, u):
        return np.interp(u, self.u, self.f)

    def work(self, u):
        k = np.clip(np.searchsorted(self.u, u) - 1, 0, len(self.u) - 2)
        return self.energy[k] + (u - self.u[k]) * (self.f[k] + self.force(u)) / 2

    def loss(self, a):
        """What friction takes in a half cycle of the amplitude a [J]: half the area of the loop."""
        return 4 * self.work(a) - 2 * a * self.force(a)

    def start_force(self, a):
        """The force at the beginning of a half cycle that ends at rest, too [N]."""
        return 2 * self.work(a) / a

    def half_period(self, a, mass, n=2000):
        angle = (np.arange(n) + 0.5) / n * np.pi
        way = a * (1 - np.cos(angle))
        work = self.start_force(a) * way - 4 * self.work(way / 2)
        return np.sum(a * np.sin(angle) / np.sqrt(2 * work / mass)) * np.pi / n

    def amplitude(self, force):
        """Half the way from a turning point with this force to the next."""
        low, high = 0., self.u[-1]
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if force * middle > 2 * self.work(middle) else (low, middle)
        return low

    def turns(self, mass, n, remembers=True):
        """Times, places and forces of n turning points of a mass that is let go where the loading ends.
        @param remembers False: each half cycle begins with the force of the first loading at its place, which is wrong"""
        rows = [(0., self.u[-1], self.f[-1])]
        while len(rows) < n:
            time, place, force = rows[-1]
            side, a = np.sign(force), self.amplitude(abs(force))
            place -= side * 2 * a
            force = force - side * 2 * self.force(a) if remembers else -side * self.force(abs(place))
            rows.append((time + self.half_period(a, mass), place, force))
        return np.array(rows).T


def backbone(results):
    """Of the second part of the loading, the first pull along x."""
    steps = [step for step in results.analyses.quasi_static_loading.steps if step["part"] == 2]
    return Backbone([0.] + [step["displacement_m"][0] for step in steps], [0.] + [step["driving_force_N"][0] for step in steps])


def loops(folder):
    """Of a loading to and fro, a row for each part after the first pull: amplitude, energy that friction took in it, and by the rule."""
    results = vc.Results(folder)
    curve = backbone(results)
    ends = [step for step in results.analyses.quasi_static_loading.steps if step["ends_part"] and step["part"] > 1]
    rows = []
    for before, after in zip(ends, ends[1:]):
        a = abs(after["displacement_m"][0] - before["displacement_m"][0]) / 2
        rows.append({"amplitude_m": a, "loss_J": after["dissipated_sum_J"] - before["dissipated_sum_J"], "loss_masing_J": curve.loss(a)})
    return rows


def branch_errors(folder):
    """Of a loading between two opposite forces, in as many steps as the first pull had, part by part: the largest distance of a step from the rule over
    the first pull's displacement. Steps of the rule are steps of the first pull, so that nothing lies between them."""
    steps = vc.Results(folder).analyses.quasi_static_loading.steps
    place = {part: np.array([0.] + [step["displacement_m"][0] for step in steps if step["part"] == part])
             for part in range(2, steps[-1]["part"] + 1)}
    errors = []
    for part in range(3, max(place) + 1):
        start, side = place[part - 1][-1], -1 if part % 2 else 1
        errors.append(np.max(np.abs(place[part][1:] - start - side * 2 * place[2][1:])) / place[2][-1])
    return errors


def used(results, entry):
    """What the run took for an entry."""
    return prm.read_entries((results.folder / "used.prm").read_text(encoding="utf-8"))[entry]


def alone(results, n, remembers=True):
    """Turning points by the rule, of the mass that the run had."""
    return backbone(results).turns(float(used(results, "Rolling/Suspension/Unsprung mass")), n, remembers)


def to_and_fro(results, n):
    """Settings of a loading that goes on from the pull between the forces of the rule's n turning points, in steps of the same number."""
    steps = [word.strip() for word in used(results, "Loading/Steps").split(",")]
    return ["Loading/Force x=0, " + ", ".join(f"{force:.17g}" for force in alone(results, n)[2]),
            "Loading/Steps=" + ", ".join(steps[:1] + steps[1:2] * n)]


def turns(results):
    """Times of the turning points of the hub, its places since it was let go, and the energy left there, of the march."""
    history = results.histories()
    time = history["time_s"]
    at, place = vc.turning_points(time, history["hub_x_displacement_m"], history["hub_x_velocity_m_s"])
    return at, place, np.interp(at, time, history["stored_energy_J"])


def compared(folder):
    """Half cycle by half cycle, a row each: amplitude of the march; energy that it lost and time that it took; both by the rule from that
    amplitude; and the amplitude that the rule alone has by then."""
    results = vc.Results(folder)
    curve, mass = backbone(results), float(used(results, "Rolling/Suspension/Unsprung mass"))
    time, place, energy = turns(results)
    amplitude, predicted = np.abs(np.diff(place)) / 2, np.abs(np.diff(alone(results, len(time))[1])) / 2
    return [{"amplitude_m": a, "amplitude_masing_m": by_rule, "loss_J": loss, "loss_masing_J": curve.loss(a), "time_s": t,
             "time_masing_s": curve.half_period(a, mass)}
            for a, by_rule, loss, t in zip(amplitude, predicted, -np.diff(energy), np.diff(time))]


def cycles(rows):
    """Two half cycles in one: sums, and the amplitude of the first."""
    return [{key: first[key] if key.startswith("amplitude") else first[key] + second[key] for key in first}
            for first, second in zip(rows[::2], rows[1::2])]


def error(row, what):
    """Against the rule, relative. @param what "loss_J", for instance, beside which there is "loss_masing_J" """
    name, unit = what.rsplit("_", 1)
    return row[what] / row[f"{name}_masing_{unit}"] - 1

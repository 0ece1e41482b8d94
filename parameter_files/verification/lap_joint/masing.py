"""Masing's rule: a mass on a joint whose loops follow from its backbone f(u), the force of the first loading.

From a turning point x0 on the joint pulls with F(x) = f(x0) - 2 f((x0 - x) / 2). The next turning point -x1 is where this force has
done no work, which gives the decrement; half a period is the time between them. No number but those of the loading goes in.
"""
import bisect
import csv
import json
import math
import os


class Backbone:
    """f(u) between the steps of a loading, linear, and its integral."""

    def __init__(self, displacement, force):
        self.u, self.f, self.energy = list(displacement), list(force), [0.]
        for k in range(1, len(self.u)):
            self.energy.append(self.energy[-1] + (self.u[k] - self.u[k - 1]) * (self.f[k] + self.f[k - 1]) / 2)

    def _place(self, u):
        k = min(max(bisect.bisect_right(self.u, u), 1), len(self.u) - 1)
        return k, (u - self.u[k - 1]) / (self.u[k] - self.u[k - 1])

    def force(self, u):
        k, share = self._place(u)
        return self.f[k - 1] + share * (self.f[k] - self.f[k - 1])

    def work(self, u):
        k, _ = self._place(u)
        return self.energy[k - 1] + (u - self.u[k - 1]) * (self.f[k - 1] + self.force(u)) / 2

    def work_from(self, x0, x):
        """of F(x) between a turning point and a place on the way back"""
        return self.force(x0) * (x0 - x) - 4 * self.work((x0 - x) / 2)

    def next_turn(self, x0):
        """x1 of the next turning point -x1"""
        low, high = 0.5 * x0, x0
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if self.work_from(x0, -middle) > 0 else (low, middle)
        return low

    def half_period(self, x0, mass, n=2000):
        x1 = self.next_turn(x0)
        middle, radius, time = (x0 - x1) / 2, (x0 + x1) / 2, 0.
        for k in range(n):
            angle = (k + 0.5) / n * math.pi
            speed = math.sqrt(max(2 * self.work_from(x0, middle + radius * math.cos(angle)) / mass, 0.))
            time += radius * math.sin(angle) / speed * math.pi / n if speed > 0 else 0.
        return time


def backbone(results):
    """Of the steps of analyses.quasi_static_loading that pull along x."""
    steps = [step for step in results["quasi_static_loading"]["steps"] if step["part"] > 1]
    return Backbone([0.] + [step["displacement_m"][0] for step in steps], [0.] + [step["driving_force_N"][0] for step in steps])


def turning_points(folder, start):
    """Times and sizes of the turning points of the hub along x, from histories.csv. @param start its displacement at t = 0"""
    with open(os.path.join(folder, "histories.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    time, place, speed = ([float(row[name]) for row in rows]
                          for name in ("time_s", "hub_x_displacement_m", "hub_x_velocity_m_s"))
    found = []
    for k in range(1, len(time)):
        if speed[k - 1] * speed[k] < 0:
            share = speed[k - 1] / (speed[k - 1] - speed[k])
            # between two samples the hub goes along a parabola
            largest = max(abs(start + place[k - 1]), abs(start + place[k]))
            h, v = time[k] - time[k - 1], abs(speed[k - 1]) if share < 0.5 else abs(speed[k])
            found.append((time[k - 1] + share * h, largest + min(share, 1 - share) * h * v / 2))
    return found


def compared(folder, mass):
    """Cycle by cycle: amplitude at its beginning, decrement and period of the march, and by the rule from that amplitude on."""
    with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
        curve = backbone(json.load(file)["analyses"])
    turns = turning_points(folder, curve.u[-1])
    rows = []
    for (t0, x0), (t2, x2) in zip(turns[::2], turns[2::2]):
        x1 = curve.next_turn(x0)
        rows.append({"amplitude_m": x0, "decrement": math.log(x0 / x2), "decrement_masing": math.log(x0 / curve.next_turn(x1)),
                     "period_s": t2 - t0, "period_masing_s": curve.half_period(x0, mass) + curve.half_period(x1, mass)})
    return rows

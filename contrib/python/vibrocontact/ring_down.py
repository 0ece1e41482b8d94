"""What rings down: its frequency and damping over its amplitude, from the places where it turns."""
from __future__ import annotations

from typing import NamedTuple, Tuple

import numpy as np
from numpy.typing import ArrayLike

from .tables import Array


class RingDown(NamedTuple):
    """Of each half cycle, from one turning point to the next."""

    amplitude_m: Array
    """half the way between both: where the middle lies, and whether it drifts, does not matter"""
    frequency_Hz: Array
    damping_ratio: Array
    """of the critical damping, by the ways before and after; nan for the first and the last half cycle"""


def turning_points(time: ArrayLike, place: ArrayLike, speed: ArrayLike) -> Tuple[Array, Array]:
    """Times and places where a motion turns; it may start with one, after a rest. Between two samples the motion is a parabola."""
    t, x, v = (np.asarray(values, dtype=float) for values in (time, place, speed))
    moving = np.flatnonzero(v)
    back = np.flatnonzero(v[moving[:-1]] * v[moving[1:]] < 0) + 1
    # the last sample before the way back, perhaps at rest
    k = moving[back] - 1
    share = v[k] / (v[k] - v[k + 1])
    at = t[k] + share * (t[k + 1] - t[k])
    near = k + (share > 0.5)
    places = x[near] + v[near] * (at - t[near]) / 2
    start = moving[:1] - 1 if len(moving) and moving[0] > 0 else []
    return np.append(t[start], at), np.append(x[start], places)


def ring_down(times: ArrayLike, places: ArrayLike) -> RingDown:
    """Frequency and damping over the amplitude, from turning_points()."""
    ways = np.abs(np.diff(places))
    damping = np.full(len(ways), np.nan)
    decrement = np.log(ways[:-2] / ways[2:])
    damping[1:-1] = decrement / np.hypot(2 * np.pi, decrement)
    return RingDown(ways / 2, 0.5 / np.diff(times), damping)

"""Compiled arithmetic of the clusters in scan order. `scan_clusters` wraps it and tells what the numbers mean."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class ThingRules(NamedTuple):
    """What makes neighbouring rays one thing; `ScanClusterParams` in rad and in rays."""

    near: float
    far: float
    jump: float
    slope: float
    bridge: int
    hidden: float


class TrunkRules(NamedTuple):
    """What makes a thing a trunk, and how well it is known; see `ScanClusterParams`."""

    thinnest: float
    thickest: float
    fewest: float
    rough: float
    ray_std: float
    ray_std_share: float
    cut_std: float


@njit(cache=True)
def ray_step(angles: Floats) -> float:
    """Angle between two rays, rad: the median, for a turn may have gaps. 0.225 deg for fewer than two."""
    return float(np.median(np.abs(np.diff(angles)))) if len(angles) > 1 else math.radians(0.225)


@njit(cache=True)
def runs(distances: Floats, near: float, far: float, step: float, jump: float, slope: float, bridge: int) -> Ints:
    """First and last ray of each thing, (K, 2): runs of rays whose ends lie close to each other.

    `step` between rays, rad. Two neighbours are of one thing if their ranges differ by less than `jump` and by less
    than a surface does that the rays meet at `slope` rad; up to `bridge` rays between them may have come back empty.
    """
    found = np.empty((len(distances), 2), dtype=np.int64)
    k, last = -1, -1
    for i in range(len(distances)):
        r = distances[i]
        if not near <= r <= far:
            continue
        reach = jump + min(r, distances[last]) * step * (i - last) / math.tan(slope) if last >= 0 else 0.0
        if last < 0 or i - last > bridge + 1 or abs(r - distances[last]) > reach:
            k += 1
            found[k, 0] = i
        found[k, 1] = i
        last = i
    return found[: k + 1]


@njit(cache=True)
def circle(angles: Floats, distances: Floats, first: int, last: int, step: float, far: float) -> tuple[float, ...]:
    """Circle of the rays `first` to `last`: bearing and range of its centre, radius, rays used, and the RMS residual.

    Its silhouette tells the radius, its near side the range: n rays `step` apart that hit it span n steps, and a
    circle of radius R at range rho spans 2 asin(R / rho).
    """
    bearing = 0.5 * (angles[first] + angles[last])
    half = 0.5 * (abs(angles[last] - angles[first]) + step)
    sine = math.sin(min(half, 1.2))
    rho, radius, used = 0.0, 0.0, 0
    for _ in range(3):
        total, used = 0.0, 0
        for i in range(first, last + 1):
            if 0.0 < distances[i] <= far:
                total += distances[i] + _bulge(angles[i] - bearing, rho, radius)
                used += 1
        front = total / used  # range of the point that is nearest
        radius = front * sine / (1.0 - sine)
        rho = front + radius
    squares = 0.0
    for i in range(first, last + 1):
        if 0.0 < distances[i] <= far:
            squares += (distances[i] - (rho - radius - _bulge(angles[i] - bearing, rho, radius))) ** 2
    return bearing, rho, radius, float(used), math.sqrt(squares / used)


@njit(cache=True)
def _bulge(off: float, rho: float, radius: float) -> float:
    """How much further a circle's nearest point is than where the ray `off` rad beside its centre ends: <= 0."""
    aside = rho * math.sin(off)
    return rho - radius - (rho * math.cos(off) - math.sqrt(max(radius * radius - aside * aside, 0.0)))


@njit(cache=True)
def hidden_edge(distances: Floats, first: int, last: int, nearer: float, beside: int) -> float:
    """1 if something nearer than that stands within `beside` rays of either edge, or the turn ends there, else 0."""
    if first == 0 or last == len(distances) - 1:
        return 1.0
    for k in range(1, beside + 1):
        if first - k >= 0 and 0.0 < distances[first - k] < nearer:
            return 1.0
        if last + k < len(distances) and 0.0 < distances[last + k] < nearer:
            return 1.0
    return 0.0


@njit(cache=True)
def things(angles: Floats, distances: Floats, step: float, rules: ThingRules) -> Floats:
    """All things of a scan, (K, 8): as `circle` tells them, first and last ray, and whether an edge is hidden."""
    found = runs(distances, rules.near, rules.far, step, rules.jump, rules.slope, rules.bridge)
    out = np.empty((len(found), 8))
    for k in range(len(found)):
        first, last = found[k]
        bearing, rho, radius, used, rms = circle(angles, distances, first, last, step, rules.far)
        cut = hidden_edge(distances, first, last, rho - rules.hidden, rules.bridge + 1)
        out[k] = bearing, rho, radius, used, rms, float(first), float(last), cut
    return out


@njit(cache=True)
def may_be_trunk(thing: Floats, step: float, rules: TrunkRules) -> bool:
    """Thick enough or cut, not too thick, of enough rays, round enough: one of `things`."""
    _, rho, radius, rays, rms, _, _, _ = thing
    slack = step * rho  # the silhouette is told to a ray on either side
    fits = rules.thinnest - slack <= 2.0 * radius <= rules.thickest + slack
    fewest = max(1.0, math.floor(rules.fewest * expected_rays(rules.thinnest, rho, step)))
    return bool(fits and rays >= fewest and rms <= rules.rough * ray_std(rho, rules))


@njit(cache=True)
def expected_rays(diameter: float, reach: float | Floats, step: float) -> float | Floats:
    """Rays that a trunk returns from a range: N = 360 D / (2 pi r 0.225) (paper B), `step` rad for its 0.225 deg."""
    return diameter / (reach * step)


@njit(cache=True)
def ray_std(rho: float, rules: TrunkRules) -> float:
    """1-sigma of a range, m."""
    return math.hypot(rules.ray_std, rules.ray_std_share * rho)


@njit(cache=True)
def trunks(angles: Floats, distances: Floats, of_things: ThingRules, of_trunks: TrunkRules) -> Floats:
    """Columns of `ScanTrunks`, (12, K), of one turn: bearings (N,) rad and ranges (N,) m."""
    step = ray_step(angles)
    found = things(angles, distances, step, of_things)
    out, k = np.empty((12, len(found))), 0
    for thing in found:
        if not may_be_trunk(thing, step, of_trunks):
            continue
        bearing, rho, radius, rays, rms, first, last, cut = thing
        noise, edge = ray_std(rho, of_trunks), 0.41 * step * rho  # two edges, each known to a step: sqrt(2 / 12)
        loose = of_trunks.cut_std if cut > 0.0 else 0.0
        out[0, k], out[1, k] = bearing, rho
        out[2, k] = math.sqrt(noise**2 / rays + (0.5 * edge) ** 2 + loose**2)
        out[3, k] = math.hypot(0.5 * edge, loose) / rho
        out[4, k], out[5, k] = 2.0 * radius, math.hypot(edge, loose)
        out[6, k], out[7, k] = cut, rays
        out[8, k], out[9, k] = 0.5 * (first + last) / max(len(angles) - 1, 1), rms / noise
        out[10, k], out[11, k] = first, last
        k += 1
    return out[:, :k].copy()

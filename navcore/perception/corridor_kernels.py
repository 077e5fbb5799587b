"""Compiled arithmetic of the corridor fit. `corridor_fit` wraps it and tells what the numbers mean.

A foot point at lateral Y and distance X ahead of a camera of height h is seen on the ray (1, s, -t) with s = Y / X
(left) and t = h / X (down). A line of plants Y = Y0 + m X is then the straight line s = m + (Y0 / h) t, for every
distance, and a camera pitched by delta too far down sees t smaller by about delta: that is why the two sides
together tell the pitch, as the height at which they meet.

State z = (offset, heading, width, pitch); a mount is (x, y, height) of the camera in the driving frame; a noise is
(ray_u, ray_v, plant, curve), see `CorridorFitParams`.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.perception.foot_kernels import on_ground, pairs
from navcore.perception.line_consensus import GATE, Floats, Mount, Noise, best_lines
from navcore.perception.plant_kernels import add_pairs, add_plants, best_plant_lines, plants_score

Ints = NDArray[np.int64]
# Plants (M, 4) and pairs (P, 2), see `plant_kernels`.
Scanned = tuple[Floats, Floats]
# A scanned plant counts among those that stand in a row if it is as sure as that.
SURE = 0.5


@njit(cache=True)
def levelled(s: float, t: float, pitch: float) -> tuple[float, float]:
    """The ray (1, s, -t) of a camera that is pitched further down than its mount says, as it really points."""
    c, p = math.cos(pitch), math.sin(pitch)
    ahead = c - t * p
    return s / ahead, (p + t * c) / ahead


@njit(cache=True)
def residual(z: Floats, s: float, t: float, side: float, mount: Mount, noise: Noise, row: Floats) -> float:
    """Normalised distance of a ray from one side (+1 left, -1 right); writes its gradient over z into `row`."""
    sl, tl = levelled(s, t, z[3])
    c, m = math.cos(z[1]), math.tan(z[1])
    across = z[0] + 0.5 * side * z[2]
    slope = (across / c + m * mount[0] - mount[1]) / mount[2]
    reach = mount[2] / max(tl, 0.02)
    lateral = (noise[2] + noise[3] * reach * reach) / reach
    scale = 1.0 / math.sqrt(noise[0] ** 2 + (slope * noise[1]) ** 2 + lateral**2)
    row[0] = -tl / (mount[2] * c) * scale
    row[1] = -(1.0 / (c * c) + tl / mount[2] * (across * m / c + mount[0] / (c * c))) * scale
    row[2] = 0.5 * side * row[0]
    row[3] = (sl * tl - slope * (1.0 + tl * tl)) * scale
    return float((sl - m - slope * tl) * scale)


@njit(cache=True)
def nearer_side(z: Floats, s: float, t: float, mount: Mount, noise: Noise, row: Floats) -> tuple[float, float]:
    """Residual to the nearer of the two sides, and which one; `row` holds that side's gradient."""
    right = residual(z, s, t, -1.0, mount, noise, row)
    keep = row.copy()
    left = residual(z, s, t, 1.0, mount, noise, row)
    if abs(left) <= abs(right):
        return left, 1.0
    row[:] = keep
    return right, -1.0


@njit(cache=True)
def score(
    z: Floats, rays: Floats, plants: Floats, mean: Floats, information: Floats, mount: Mount, noise: Noise
) -> float:
    """Log likelihood over "all points are clutter", prior included; objects inside the corridor speak against it."""
    row = np.empty(4)
    d = z - mean
    total = -0.5 * float(d @ information @ d) + plants_score(z, plants, noise)
    for i in range(len(rays)):
        e, _ = nearer_side(z, rays[i, 0], rays[i, 1], mount, noise, row)
        if abs(e) < GATE:
            total += 0.5 * (GATE * GATE - e * e)
        elif _inside(z, rays[i, 0], rays[i, 1], mount):
            total -= 2.0
    return total


@njit(cache=True)
def _inside(z: Floats, s: float, t: float, mount: Mount) -> bool:
    sl, tl = levelled(s, t, z[3])
    if tl < 0.08:
        return False
    x = mount[2] / tl
    y = mount[1] + sl * x - (z[0] / math.cos(z[1]) + math.tan(z[1]) * (mount[0] + x))
    return bool(abs(y) < 0.35 * z[2])


@njit(cache=True)
def refine(
    z: Floats, rays: Floats, scanned: Scanned, mean: Floats, information: Floats, mount: Mount, noise: Noise,
    steps: int, widen: float,
) -> tuple[Floats, Floats, Ints, Ints]:  # fmt: skip
    """Robust Gauss-Newton from z: state, its information (4, 4), each ray's and each plant's side (+1, -1, 0).

    The gate starts `widen` times as wide and closes to its size, so that a start that is off still finds the line.
    """
    z, (plants, pairs) = z.copy(), scanned
    sides, plant_sides = np.zeros(len(rays), dtype=np.int64), np.zeros(len(plants), dtype=np.int64)
    hessian = information.copy()
    row = np.empty(4)
    for step in range(steps):
        loose = widen + (1.0 - widen) * min(1.0, step / max(1.0, steps - 2.0))
        hessian = information.copy()
        gradient = information @ (z - mean)
        for i in range(len(rays)):
            e, side = nearer_side(z, rays[i, 0], rays[i, 1], mount, noise, row)
            w = 1.0 - (e / (GATE * loose)) ** 2
            sides[i] = int(side) if w > 0.0 else 0
            if w <= 0.0:
                continue
            w = w * w / (loose * loose)
            for a in range(4):
                gradient[a] += w * e * row[a]
                for b in range(4):
                    hessian[a, b] += w * row[a] * row[b]
        add_plants(z, plants, noise, loose, hessian, gradient, plant_sides)
        add_pairs(z, pairs, mount, noise, loose, hessian, gradient)
        z = z - np.linalg.solve(hessian, gradient)
        z[1] = min(1.2, max(-1.2, z[1]))
        z[3] = min(0.15, max(-0.15, z[3]))
    return z, hessian, sides, plant_sides


@njit(cache=True)
def told(
    start: Floats, rays: Floats, used: Ints, paired: Ints, plants: Floats, mean: Floats, information: Floats,
    mount: Mount, noise: Noise, widen: float,
) -> tuple[Floats, Floats, Ints, Floats, Ints]:  # fmt: skip
    """What all feet and plants tell, refined from `start`: state, its information, each foot's side and where it
    stands, each plant's side. Of the `rays` only those `used` count as feet by themselves; see `foot_kernels`.
    """
    scanned = plants, pairs(rays, paired, plants, mount)
    z, after, found, plant_sides = refine(start, rays[used], scanned, mean, information, mount, noise, 5, widen)
    sides = np.zeros(len(rays), dtype=np.int64)
    sides[used] = found
    for i in range(len(rays)):
        if paired[i] >= 0:
            sides[i] = plant_sides[paired[i]]
    return z, after, sides, on_ground(rays, paired, plants, z[3], mount), plant_sides


@njit(cache=True)
def each_once(xy: Floats, sides: Ints, paired: Ints, plants: Floats, plant_sides: Ints) -> tuple[Floats, Ints]:
    """How far ahead, m, and on which side each plant is, (K,): feet (N,) that are no scanned plant's, then those
    scanned ones (M,) that are sure.
    """
    alone, sure = paired < 0, plants[:, 3] >= SURE
    return np.append(xy[alone, 0], plants[sure, 0]), np.append(sides[alone], plant_sides[sure])


@njit(cache=True)
def line_state(m: float, b: float, side: float, width: float, mount: Mount) -> Floats:
    """State whose side `side` is the line s = m + b t, seen level."""
    z = np.zeros(4)
    z[1] = math.atan(m)
    across = math.cos(z[1]) * (b * mount[2] + mount[1]) - math.sin(z[1]) * mount[0]
    z[0], z[2] = across - 0.5 * side * width, width
    return z


@njit(cache=True)
def hypotheses(lines: Floats, width: float, mount: Mount) -> Floats:
    """States (K, 4): each line as either side of a level corridor, and each two lines as its two sides."""
    n = len(lines)
    states = np.zeros((2 * n + n * n, 4))
    k = 0
    for i in range(n):
        for side in (1.0, -1.0):
            states[k] = line_state(lines[i, 0], lines[i, 1], side, width, mount)
            k += 1
        for j in range(n):
            spread = lines[i, 1] - lines[j, 1]
            if spread < 0.5:
                continue
            meet = (lines[j, 0] - lines[i, 0]) / spread
            m = lines[i, 0] + lines[i, 1] * meet
            if abs(meet) < 0.1 and abs(m) < 1.5:
                w = mount[2] * spread * math.cos(math.atan(m))
                states[k] = line_state(m, lines[i, 1], 1.0, w, mount)
                states[k, 3] = -meet
                k += 1
    return states[:k]


@njit(cache=True)
def acquire(
    rays: Floats, scanned: Scanned, mean: Floats, information: Floats, mount: Mount, noise: Noise, lines: int,
    tries: int, reach: tuple[float, float],
) -> tuple[Floats, float]:  # fmt: skip
    """The best corridor within `reach` (m, rad) of the prior's offset and heading, the `tries` best of which are
    refined; its score.
    """
    plants = scanned[0]
    found = np.vstack((best_lines(rays, lines, mount, noise), best_plant_lines(plants, lines, mount, noise)))
    states = hypotheses(found, mean[2], mount)
    first = np.empty(len(states))
    for i in range(len(states)):
        first[i] = score(states[i], rays, plants, mean, information, mount, noise)
        if _beyond(states[i], mean, reach, 1.3):
            first[i] = -1e9
    best, best_score = mean.copy(), score(mean, rays, plants, mean, information, mount, noise)
    for i in np.argsort(-first, kind="mergesort")[:tries]:
        z, _, _, _ = refine(states[i], rays, scanned, mean, information, mount, noise, 6, 2.0)
        value = score(z, rays, plants, mean, information, mount, noise)
        if value > best_score and not _beyond(z, mean, reach, 1.0):
            best, best_score = z, value
    return best, best_score


@njit(cache=True)
def _beyond(z: Floats, mean: Floats, reach: tuple[float, float], times: float) -> bool:
    return bool(abs(z[0] - mean[0]) > times * reach[0] or abs(z[1] - mean[1]) > times * reach[1])

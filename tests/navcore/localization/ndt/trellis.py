"""Points of a small trellis: ground, posts, wires of leaves; drawn anew for every look."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]
NOISE_M = 0.01
ROWS, POSTS = (-9.0, -3.0, 3.0, 9.0), np.arange(-30.0, 31.0, 3.0)


def ground(rng: np.random.Generator, n: int, reach: float = 25.0) -> Floats:
    xy = rng.uniform(-reach, reach, (n, 2))
    return np.column_stack((xy, 0.05 * np.sin(0.3 * xy[:, 0]) + 0.05 * np.sin(0.4 * xy[:, 1])))


def posts(rng: np.random.Generator, each: int) -> Floats:
    """Round ones, 10 cm thick, each a little off its place."""
    places = np.random.default_rng(1)
    found = []
    for row in ROWS:
        for x in POSTS:
            dx, dy = places.normal(0.0, 0.08, 2)
            angle, z = rng.uniform(0.0, 2.0 * np.pi, each), rng.uniform(0.0, 2.5, each)
            found.append(np.column_stack((x + dx + 0.05 * np.cos(angle), row + dy + 0.05 * np.sin(angle), z)))
    return np.vstack(found)


def leaves(rng: np.random.Generator, n: int) -> Floats:
    row = rng.choice(ROWS, n)
    return np.column_stack((rng.uniform(-25.0, 25.0, n), row + rng.normal(0.0, 0.3, n), rng.uniform(0.8, 2.2, n)))


def orchard(seed: int, n: int) -> Floats:
    """About `n` points of all in `map`, measured with noise."""
    rng = np.random.default_rng(seed)
    points = np.vstack((ground(rng, n // 2), posts(rng, n // 4 // 84 + 1), leaves(rng, n // 4)))
    return np.asarray(points + rng.normal(0.0, NOISE_M, points.shape))


def mapped_orchard() -> NdtMap:
    ndt_map = NdtMap()
    ndt_map.add(orchard(seed=100, n=400_000))
    return ndt_map


def scan_at(T_map_sensor: SE3, seed: int, n: int = 4000) -> Floats:
    """What a sensor there sees within 20 m, in its own frame."""
    points = T_map_sensor.inverse().apply(orchard(seed, n))
    return np.ascontiguousarray(points[np.hypot(points[:, 0], points[:, 1]) < 20.0])

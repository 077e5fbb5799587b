"""A block whose rows and posts repeat themselves exactly, without an end: what no LiDAR can tell apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]
ROW_M, POST_M, NOISE_M, REACH_M = 6.0, 3.0, 0.01, 20.0


def points(rng: np.random.Generator, half: float, n: int) -> Floats:
    """Level ground, and posts 10 cm thick on a lattice, within a square of 2 `half`."""
    ground = np.column_stack((rng.uniform(-half, half, (n // 2, 2)), np.zeros(n // 2)))
    rows = np.arange(-half + ROW_M / 2, half, ROW_M)
    spots = np.array([(x, y) for x in np.arange(-half, half + 0.1, POST_M) for y in rows])
    of = spots[rng.integers(len(spots), size=n // 2)]
    angle, height = rng.uniform(0.0, 2.0 * np.pi, n // 2), rng.uniform(0.0, 2.5, n // 2)
    posts = np.column_stack((of[:, 0] + 0.05 * np.cos(angle), of[:, 1] + 0.05 * np.sin(angle), height))
    together = np.vstack((ground, posts))
    return np.asarray(together + rng.normal(0.0, NOISE_M, together.shape))


def mapped_block() -> NdtMap:
    """So large that no cloud from near its middle sees an edge."""
    ndt_map = NdtMap()
    ndt_map.add(points(np.random.default_rng(1), 42.0, 600_000))
    return ndt_map


def scan_in_block(at: SE2, seed: int) -> Floats:
    """What a LiDAR sees within 20 m, in the robot's frame."""
    seen = points(np.random.default_rng((seed, 5)), 42.0, 40_000)
    local = at.inverse().apply(seen[:, :2])
    near = np.hypot(local[:, 0], local[:, 1]) < REACH_M
    return np.ascontiguousarray(np.column_stack((local, seen[:, 2]))[near])

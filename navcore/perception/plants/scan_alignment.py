"""Where the robot stands among the plants it knows: the scan laid over them. Wheels slip, trunks do not."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.plants.alignment_kernels import laid_over

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanAlignmentParams:
    """Parameters of `align`.

    Attributes:
        still_std, still_turn_std: 1-sigma of odometry between two scans of a robot that stands, m and rad.
        drift, turn_drift: 1-sigma of odometry as a share of what was driven (m) and turned (rad).
        gate: a trunk belongs to a plant nearer than that, m; near_gate: and at last than that.
        noise: 1-sigma of a plant's place beside what is told, m: trunks are not round.
        rounds: matched and fitted so often.
    """

    still_std: float = 0.01
    still_turn_std: float = 0.003
    drift: float = 0.15
    turn_drift: float = 0.25
    gate: float = 0.35
    near_gate: float = 0.15
    noise: float = 0.01
    rounds: int = 3


def align(
    predicted: SE2, moved: SE2, seen: Floats, seen_std: Floats, known: Floats, known_std: Floats,
    p: ScanAlignmentParams,
) -> SE2:  # fmt: skip
    """The pose at which trunks `seen` (N, 2), in its frame, best lie on the plants `known` (M, 2) of the outer one.

    `predicted` is that pose by odometry, `moved` the motion since the last scan that led there.
    """
    if not len(seen) or not len(known):
        return predicted
    gates = _gates(p.gate, p.near_gate, p.rounds)
    start, information = np.array((predicted.x, predicted.y, predicted.yaw)), _odometry_information(moved, p)
    x, y, yaw = laid_over(start, information, seen, seen_std, known, known_std, gates, p.noise)
    return SE2(float(x), float(y), float(yaw))


@lru_cache(maxsize=8)  # asked for with each scan
def _gates(first: float, last: float, rounds: int) -> Floats:
    return np.linspace(first, last, rounds)


def _odometry_information(moved: SE2, p: ScanAlignmentParams) -> Floats:
    driven = math.hypot(moved.x, moved.y)
    std = p.still_std + p.drift * driven
    turn = p.still_turn_std + p.turn_drift * abs(moved.yaw)
    return np.array((std**-2, std**-2, turn**-2))

"""Where the robot stands among the plants it knows: the scan laid over them. Wheels slip, trunks do not."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


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
    information = _odometry_information(moved, p)
    pose = predicted
    for gate in np.linspace(p.gate, p.near_gate, p.rounds):
        there = pose.apply(seen)
        mine, theirs = matches(there, known, float(gate))
        variance = seen_std[mine] ** 2 + known_std[theirs] ** 2 + p.noise**2
        pose = _fitted(pose, predicted, information, there[mine], known[theirs], variance)
    return pose


def matches(seen: Floats, known: Floats, gate: float) -> tuple[Ints, Ints]:
    """Indices of those that are each other's nearest, and no further apart than `gate` m."""
    apart = np.hypot(seen[:, None, 0] - known[None, :, 0], seen[:, None, 1] - known[None, :, 1])
    if not apart.size:
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    to_known, to_seen = np.argmin(apart, axis=1), np.argmin(apart, axis=0)
    mine = np.flatnonzero((to_seen[to_known] == np.arange(len(seen))) & (np.min(apart, axis=1) <= gate))
    return mine, to_known[mine]


def _odometry_information(moved: SE2, p: ScanAlignmentParams) -> Floats:
    driven = math.hypot(moved.x, moved.y)
    std = p.still_std + p.drift * driven
    turn = p.still_turn_std + p.turn_drift * abs(moved.yaw)
    return np.array((std**-2, std**-2, turn**-2))


def _fitted(
    pose: SE2, predicted: SE2, information: Floats, there: Floats, known: Floats, variance: Floats
) -> SE2:  # fmt: skip
    """One Gauss-Newton step from `pose`: shift (x, y) and turn about its own place."""
    arm, off = there - (pose.x, pose.y), known - there
    w = 1.0 / variance
    H = np.zeros((3, 3))
    H[0, 0] = H[1, 1] = w.sum()
    H[0, 2] = H[2, 0] = -(w * arm[:, 1]).sum()
    H[1, 2] = H[2, 1] = (w * arm[:, 0]).sum()
    H[2, 2] = (w * np.sum(arm**2, axis=1)).sum()
    across = w * (arm[:, 0] * off[:, 1] - arm[:, 1] * off[:, 0])
    g = np.array(((w * off[:, 0]).sum(), (w * off[:, 1]).sum(), across.sum()))
    back = np.array((predicted.x - pose.x, predicted.y - pose.y, predicted.yaw - pose.yaw))
    back[2] = math.remainder(back[2], math.tau)
    dx, dy, turn = np.linalg.solve(H + np.diag(information), g + information * back)
    return SE2(pose.x + float(dx), pose.y + float(dy), pose.yaw + float(turn))

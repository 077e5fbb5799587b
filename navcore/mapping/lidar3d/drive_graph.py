"""The pose graph of a drive: its steps, its loops, gravity and the fixes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.localization.gnss_noise import GnssNoiseParams
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.pose_graph.pose_graph import PoseGraph, PoseGraphParams
from navcore.mapping.pose_graph.terms import LevelTerm, PositionTerm, RelativeTerm

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveGraphParams:
    """Parameters of `drive_graph`.

    Attributes:
        step_std, step_turn_std: no step is surer, m and rad, above 0: the local map is crooked by as much.
        adding: share of a keyframe's own 1-sigma that adds up from step to step, 0 to 1. The rest is jitter about the
            local map, gone with the next keyframe: in simulated rows 5 mm after one step and 9 mm after twenty.
        slip, slip_turn: 1-sigma of a step of which turns were lost, by odometry alone: share of the way, rad per m.
        lasting_s: a fix's error is the same for so long, s, twice its time constant: fixes that
            follow each other sooner share one's weight.
        level_std: of gravity as the IMU has it, rad, above 0: mount, bias and the robot's own jerks.
        graph: its kernels.
    """

    step_std: float = 0.002
    step_turn_std: float = math.radians(0.03)
    adding: float = 0.3
    slip: float = 0.05
    slip_turn: float = math.radians(1.0)
    lasting_s: float = 2.0 * GnssNoiseParams().fixed.slow_s
    level_std: float = math.radians(1.0)
    graph: PoseGraphParams = field(default_factory=PoseGraphParams)


def drive_graph(
    keyframes: Sequence[Keyframe], start: Sequence[SE3], loops: Sequence[RelativeTerm], *, georeferenced: bool,
    params: DriveGraphParams = DriveGraphParams(),
) -> PoseGraph:  # fmt: skip
    """A node for each keyframe, from a `start` of each; without a georeference the fixes are left out."""
    graph = PoseGraph(start, params.graph)
    for i, (before, after) in enumerate(pairwise(keyframes)):
        graph.add(_step(i, before, after, params))
    for i, k in enumerate(keyframes):
        graph.add(LevelTerm(i=i, up=k.up, std=params.level_std))
    for position in fix_terms(keyframes, params) if georeferenced else ():
        graph.add(position)
    for loop in loops:
        graph.add(loop)
    return graph


def fix_terms(keyframes: Sequence[Keyframe], p: DriveGraphParams) -> Iterator[PositionTerm]:
    """The fixes of keyframes, those that follow each other soon with a small share of the weight each."""
    before_ns: int | None = None
    for i, k in enumerate(keyframes):
        if k.fix is None:
            continue
        since_s = p.lasting_s if before_ns is None else (k.stamp_ns - before_ns) * 1e-9
        before_ns = k.stamp_ns
        yield PositionTerm(
            i=i, antenna=k.fix.antenna, place=k.fix.place, information=np.diag(k.fix.std**-2.0),
            share=since_s / (since_s + p.lasting_s),
        )  # fmt: skip


def _step(i: int, before: Keyframe, after: Keyframe, p: DriveGraphParams) -> RelativeTerm:
    T = before.T_odom_base.inverse() @ after.T_odom_base
    floor = np.repeat((p.step_std**2, p.step_turn_std**2), 3)
    if after.lost:
        way = float(np.linalg.norm(T.t))
        floor += np.repeat(((p.slip * way) ** 2, (p.slip_turn * way) ** 2), 3)
    covariance = p.adding**2 * along_axes(after.covariance, before.T_odom_base.R.T) + np.diag(floor)
    return RelativeTerm(i=i, j=i + 1, T_i_j=T, information=np.asarray(np.linalg.inv(covariance)))


def along_axes(covariance: Floats, R: Floats) -> Floats:
    """A covariance (6, 6) of translation and rotation, turned."""
    A = np.zeros((6, 6))
    A[:3, :3], A[3:, 3:] = R, R
    return np.asarray(A @ covariance @ A.T)

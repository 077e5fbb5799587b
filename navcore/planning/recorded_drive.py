"""A drive that was recorded elsewhere, made followable: jumps, noise and turns on the spot taken out."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_smoothing_spline

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2
from navcore.messages import MissionPlan, PathSegment, SegmentKind
from navcore.planning.params import PlanningParams
from navcore.planning.speeds import planned_speeds
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedDriveParams:
    """Lengths in m.

    Attributes:
        step: spacing of the points.
        standing: moves shorter than this are standing still.
        smoothing: length over which the recorded positions are averaged.
        outlier: positions further than this from the smoothed line lose their weight.
        radius: no turn of the result is tighter.
        look_ahead: of the imagined robot that drives the smoothed line once.
    """

    step: float = 0.1
    standing: float = 0.05
    smoothing: float = 0.5
    outlier: float = 0.15
    radius: float = 0.9
    look_ahead: float = 0.8


def followable_course(points: Floats, params: RecordedDriveParams = RecordedDriveParams()) -> Polyline:
    """Path near recorded positions (N, 2), in order, that a robot of bounded turning can drive.

    A robust smoothing spline over the arc length takes out jumps and noise; an imagined robot then drives it by pure
    pursuit with bounded curvature, and its trace is the result, so that turns on the spot become turns of `radius`.
    Raises InputError for too few positions, NotFiniteError for such that are no numbers.
    """
    p = np.asarray(points, dtype=np.float64)
    if p.ndim != 2 or p.shape[1] != 2:
        raise InputError(f"A recorded drive is a list of (x, y); got an array of shape {p.shape}.")
    if not np.isfinite(p).all():
        raise NotFiniteError("A recorded drive must not contain NaN or infinite positions.")
    moved = _without_standing(p, params.standing)
    if len(moved) < 5:
        raise InputError("A recorded drive needs at least five different positions.")
    return _trace(_smoothed(moved, params), params)


def _without_standing(points: Floats, least: float) -> Floats:
    kept = [0]
    for i in range(1, len(points)):
        if math.dist(points[i], points[kept[-1]]) >= least:
            kept.append(i)
    return points[kept]


def _smoothed(points: Floats, params: RecordedDriveParams) -> Polyline:
    """Smoothing spline of evenly spaced points, three rounds with outliers losing weight."""
    even = Polyline(points).resampled(params.step)
    weights = np.ones(len(even.s))
    stiffness = params.smoothing**4 / params.step
    for _ in range(3):
        line = np.column_stack(
            [make_smoothing_spline(even.s, even.points[:, k], weights, stiffness)(even.s) for k in (0, 1)]
        )
        off = np.hypot(*(line - even.points).T)
        weights = 1.0 / np.maximum(off / params.outlier, 1.0) ** 2
    return Polyline(line)


def _trace(line: Polyline, params: RecordedDriveParams) -> Polyline:
    """Trace of an imagined robot that pursues a point on the line, its curvature bounded."""
    pose, s = SE2(*line.at(0.0), line.heading_at(0.0)), 0.0
    trace = [(pose.x, pose.y)]
    for _ in range(round(3.0 * line.length / params.step)):
        s = _progress(line, pose, s)
        if s >= line.length - params.step:
            break
        x, y = pose.inverse().apply_point(*line.at(s + params.look_ahead))
        wanted = 2.0 * y / max(x * x + y * y, 1e-9) if x > 0.0 else math.copysign(1.0 / params.radius, y)
        curvature = min(max(wanted, -1.0 / params.radius), 1.0 / params.radius)
        pose = pose @ SE2.arc(params.step, params.step * curvature)
        trace.append((pose.x, pose.y))
    return Polyline(np.array(trace))


def _progress(line: Polyline, pose: SE2, s: float) -> float:
    """Place on the line that the robot has come to; never back, and on by itself while it swings round."""
    near = line.project(pose.x, pose.y, s + 0.5, 1.0).s
    return max(near, s)


def plan_for_drive(
    course: Polyline, *, mission_id: str, name: str, datum: tuple[float, float, float], vehicle: VehicleParams,
    speed: float = 0.8, params: PlanningParams = PlanningParams(),
) -> MissionPlan:  # fmt: skip
    """A mission that follows a course on GNSS at up to `speed` m/s."""
    speeds = planned_speeds(course.points, np.full(len(course.points), speed), vehicle, params)
    points = tuple((x, y) for x, y in course.points.round(4).tolist())
    segment = PathSegment(kind=SegmentKind.ROAD, points=points, speeds=tuple(speeds.round(4).tolist()))
    return MissionPlan(mission_id=mission_id, name=name, datum=datum, segments=(segment,))

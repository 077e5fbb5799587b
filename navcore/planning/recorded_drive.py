"""A drive that was recorded elsewhere, made followable: jumps, noise and turns on the spot taken out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

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
        turn_within: a drive that turns round within this length turned on the spot.
        look_ahead: of the imagined robot that drives the smoothed line once.
    """

    step: float = 0.1
    standing: float = 0.05
    smoothing: float = 0.5
    outlier: float = 0.15
    radius: float = 0.9
    turn_within: float = 1.0
    look_ahead: float = 0.8


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of the drive, driven one way; at its end the robot stands."""

    course: Polyline
    reverse: bool


def followable_drive(points: Floats, params: RecordedDriveParams = RecordedDriveParams()) -> tuple[Stretch, ...]:
    """Stretches near recorded positions (N, 2), in order, that a robot of bounded turning can drive.

    A robust smoothing spline over the arc length takes out jumps and noise. Where the recorded robot turned round on
    the spot, ours drives on a little, swings back in reverse and goes on forwards. An imagined robot then drives each
    part by pure pursuit with bounded curvature, and its trace is the result.
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
    parts = _between_turns(_smoothed(moved, params), params)
    start = SE2(*parts[0].at(0.0), parts[0].heading_at(0.0))
    stretches: list[Stretch] = []
    for part in parts:
        trace, last = _trace(part, start, params)
        stretches.append(Stretch(trace, reverse=False))
        if part is not parts[-1]:
            swing, start = _swing(last, params)
            stretches.append(Stretch(swing, reverse=True))
    return tuple(stretches)


def _between_turns(line: Polyline, params: RecordedDriveParams) -> list[Polyline]:
    """The line cut where it turns round within `turn_within`; a part before that goes on straight, to swing."""
    half = params.turn_within / 2
    places = np.arange(half + 1.0, line.length - half - 1.0, params.step)
    before = line.at_all(places - half) - line.at_all(places - half - 1.0)
    after = line.at_all(places + half + 1.0) - line.at_all(places + half)
    opposed = (before * after).sum(axis=1) < -0.8 * np.hypot(*before.T) * np.hypot(*after.T)
    beside = np.hypot(*(line.at_all(places + half + 1.0) - line.at_all(places - half - 1.0)).T) < params.radius
    cuts = _middles(places[opposed & beside], params.turn_within)
    ends = [0.0, *cuts, line.length]
    return [_prolonged(line.slice(a, b), b < line.length, params) for a, b in pairwise(ends)]


def _middles(places: Floats, within: float) -> list[float]:
    """Middle of each run of places that lie closer together than `within`."""
    if not len(places):
        return []
    runs = np.split(places, np.flatnonzero(np.diff(places) > within) + 1)
    return [float(run.mean()) for run in runs]


def _prolonged(part: Polyline, turns: bool, params: RecordedDriveParams) -> Polyline:
    """The part without its last, bent half metre, and two radii more straight on before a turn."""
    if not turns:
        return part
    end = part.length - params.turn_within / 2
    (x0, y0), (x1, y1) = part.at(end - 1.0), part.at(end)
    heading = math.atan2(y1 - y0, x1 - x0)
    further = 2.0 * params.radius + params.turn_within / 2
    tip = (x1 + further * math.cos(heading), y1 + further * math.sin(heading))
    return Polyline(np.vstack((part.slice(0.0, end).points, tip))).resampled(params.step)


def _swing(pose: SE2, params: RecordedDriveParams) -> tuple[Polyline, SE2]:
    """A quarter turn backwards from `pose`; and the pose of the body then, from which a quarter turn forwards leads
    back onto its own line in the other direction.
    """
    length = params.radius * math.pi / 2
    ways = np.linspace(0.0, length, round(length / params.step) + 1)
    swung = [pose @ SE2(0.0, 0.0, math.pi) @ SE2.arc(float(w), float(w) / params.radius) for w in ways]
    body = swung[-1] @ SE2(0.0, 0.0, math.pi)
    return Polyline(np.array([(p.x, p.y) for p in swung])), body


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


def _trace(line: Polyline, start: SE2, params: RecordedDriveParams) -> tuple[Polyline, SE2]:
    """Trace of an imagined robot that pursues a point on the line, its curvature bounded; and its last pose."""
    pose, s = start, 0.0
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
    return Polyline(np.array(trace)), pose


def _progress(line: Polyline, pose: SE2, s: float) -> float:
    """Place on the line that the robot has come to; never back, and on by itself while it swings round."""
    near = line.project(pose.x, pose.y, s + 0.5, 1.0).s
    return max(near, s)


def plan_for_drive(
    drive: tuple[Stretch, ...], *, mission_id: str, name: str, datum: tuple[float, float, float],
    vehicle: VehicleParams, speed: float = 0.8, params: PlanningParams = PlanningParams(),
) -> MissionPlan:  # fmt: skip
    """A mission that follows a drive on GNSS at up to `speed` m/s."""
    segments = []
    for stretch in drive:
        points = stretch.course.points
        speeds = planned_speeds(points, np.full(len(points), speed), vehicle, params)
        segments.append(
            PathSegment(
                kind=SegmentKind.ROAD, points=tuple((x, y) for x, y in points.round(4).tolist()),
                speeds=tuple(speeds.round(4).tolist()), reverse=stretch.reverse,
            )
        )  # fmt: skip
    return MissionPlan(mission_id=mission_id, name=name, datum=datum, segments=tuple(segments))

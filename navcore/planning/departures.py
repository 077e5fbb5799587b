"""Ways to get going from the warehouse or out of a row, each ending where the robot drives forward."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.messages import SegmentKind
from navcore.planning.connection import Option
from navcore.planning.driven_row import DrivenRow
from navcore.planning.free_space import FreeSpace
from navcore.planning.params import PlanningParams, straight_cost

Floats = NDArray[np.float64]
_HALF_TURN = SE2(0.0, 0.0, math.pi)
# What a change of direction costs beside its way: stop, other camera, start; m of way.
_CUSP = 4.0


@dataclass(frozen=True, slots=True)
class Part:
    """A stretch of poses (N, 3) in the direction of motion."""

    kind: SegmentKind
    poses: Floats
    reverse: bool = False
    row: DrivenRow | None = None


@dataclass(frozen=True, slots=True)
class Departure:
    """Stretches driven first, then `pose`, from which the robot goes on forwards. `cost` in metres of way."""

    parts: tuple[Part, ...]
    pose: SE2
    cost: float


def options(departures: list[Departure]) -> list[Option]:
    """As starts of a connection; the key is the index."""
    return [Option(d.pose, d.cost, float(i)) for i, d in enumerate(departures)]


def from_parking(pose: SE2, space: FreeSpace, params: PlanningParams) -> list[Departure]:
    """Straight on, or first some metres backwards where that is free."""
    departures = [Departure((), pose, 0.0)]
    for back in (2.0, 4.0, 6.0):
        poses = _backwards(pose, 0.0, back, params.step)
        if space.blocked(poses) is None:
            part = Part(SegmentKind.ROAD, poses, reverse=True)
            departures.append(Departure((part,), pose @ SE2(-back, 0.0, 0.0), back + _CUSP))
    return departures


def through_the_end(row: DrivenRow, params: PlanningParams) -> list[Departure]:
    """Straight out at the far end, a shorter or longer way."""
    inside = max(row.length - params.exit_inside, row.length / 2)
    departures = []
    for out in params.exits:
        part = Part(SegmentKind.EXIT, row.line(inside, row.length + out, params.step), row=row)
        departures.append(Departure((part,), row.pose(row.length + out), straight_cost(out, params.turn_exit)))
    return departures


def backwards_out(row: DrivenRow, space: FreeSpace, params: PlanningParams) -> list[Departure]:
    """Straight out in reverse at the entrance, then on in reverse along an arc to where the robot drives forward.

    `row` is the row as it was driven in. Only arcs that are free are offered, if there are any.
    """
    back = row.reversed()
    inside = max(back.length - params.exit_inside, back.length / 2)
    every, free = [], []
    for out in (params.exit_length, params.exit_length + 2.0, params.exit_length + 3.0):
        part = Part(SegmentKind.EXIT, back.line(inside, back.length + out, params.step), reverse=True, row=back)
        for poses, pose, cost in _swings(row.pose(-out), params):
            parts = (part, Part(SegmentKind.HEADLAND, poses, reverse=True)) if len(poses) > 1 else (part,)
            straight = straight_cost(out, params.turn_exit) if len(poses) > 1 else out
            departure = Departure(parts, pose, straight + cost + _CUSP)
            every.append(departure)
            if space.blocked(poses) is None:
                free.append(departure)
    return free or every


def _swings(pose: SE2, params: PlanningParams) -> Iterator[tuple[Floats, SE2, float]]:
    """Backward arcs from `pose`: poses in the direction of motion, pose of the body at the end, length."""
    yield np.array([(pose.x, pose.y, pose.yaw)], dtype=np.float64), pose, 0.0
    for radius in params.radii:
        for degrees in (-120, -90, -60, 60, 90, 120):
            length = radius * math.radians(abs(degrees))
            curvature = math.copysign(1.0 / radius, degrees)
            poses = _backwards(pose, curvature, length, params.step)
            yield poses, SE2(*map(float, poses[-1])) @ _HALF_TURN, length + (params.radii[0] - radius)


def _backwards(pose: SE2, curvature: float, length: float, step: float) -> Floats:
    """Poses in the direction of motion while the body at `pose` drives backwards."""
    count = max(math.ceil(length / step), 1)
    ways = [length * k / count for k in range(count + 1)]
    moved = [pose @ _HALF_TURN @ SE2.arc(way, way * curvature) for way in ways]
    return np.array([(p.x, p.y, p.yaw) for p in moved], dtype=np.float64)

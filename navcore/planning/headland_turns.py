"""Changing from a row into another over the headland."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.planning.connection import Blocked, Option, connect
from navcore.planning.driven_row import DrivenRow
from navcore.planning.dubins import dubins_paths
from navcore.planning.params import PlanningParams, straight_cost

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Turn:
    """A way from one row's axis to another's.

    Attributes:
        exit_length, entry_length: straight run past the end of the row left, and before the one entered, m.
        parts: (poses (N, 3) in the direction of motion, driven in reverse) in order; at each change the robot stops.
        obstacle: what the turn meets if no turn is free, else empty; at `place`.
    """

    exit_length: float
    entry_length: float
    parts: tuple[tuple[Floats, bool], ...]
    obstacle: str = ""
    place: tuple[float, float] = (0.0, 0.0)


def headland_turn(left: DrivenRow, entered: DrivenRow, blocked: Blocked, params: PlanningParams) -> Turn:
    """The cheapest turn that is free: one sweep (U or bulb) where there is room, else three points with reverse.

    If none is free the returned turn says what it meets.
    """
    sweep = _sweep(left, entered, blocked, params)
    if not sweep.obstacle:
        return sweep
    fishtails = [_fishtail(left, entered, radius, params) for radius in params.radii]
    for turn in fishtails:
        if turn is not None and all(blocked(poses) is None for poses, _ in turn.parts):
            return turn
    return sweep


def _sweep(left: DrivenRow, entered: DrivenRow, blocked: Blocked, params: PlanningParams) -> Turn:
    starts = [Option(left.pose(left.length + d), straight_cost(d, params.turn_exit), d) for d in params.exits]
    entries = (d for d in (5.0, 4.0, 3.0, 2.0, params.least_entry) if d >= params.least_entry)
    goals = [Option(entered.pose(-d), straight_cost(d, params.turn_entry), d) for d in entries]
    found = connect(starts, goals, params.radii, blocked, longest=25.0)
    parts = ((found.path.poses(params.step), False),)
    return Turn(found.start.key, found.goal.key, parts, found.obstacle, found.place)


def _fishtail(left: DrivenRow, entered: DrivenRow, radius: float, params: PlanningParams) -> Turn | None:
    """Quarter turn towards the other row, straight back, quarter turn into it: for near rows on a shallow headland.

    Both quarter turns end on one line across the rows, which lies as near to the rows as both straight runs allow.
    None where the other row is further away than a plain U turn, or not about parallel.
    """
    local = left.pose(left.length).inverse() @ entered.pose(0.0)
    if abs(abs(local.yaw) - math.pi) > math.radians(15.0) or abs(local.y) >= 2.0 * radius:
        return None
    side = math.copysign(1.0, local.y)
    out = max(params.exit_length, local.x + params.least_entry)
    first = _arc(left.pose(left.length + out), side / radius, math.pi / 2 * radius, params.step)
    turned = SE2(*map(float, first[-1]))
    back = 2.0 * radius - abs(local.y)
    reverse = _arc(turned @ SE2(0.0, 0.0, math.pi), 0.0, back, params.step)
    # A little tighter than exact: with rounding noise the exact radius would make a full circle of it.
    last = dubins_paths(turned @ SE2(-back, 0.0, 0.0), entered.pose(local.x - out), 0.97 * radius)[0]
    return Turn(out, out - local.x, ((first, False), (reverse, True), (last.poses(params.step), False)))


def _arc(start: SE2, curvature: float, length: float, step: float) -> Floats:
    count = max(math.ceil(length / step), 1)
    poses = [start @ SE2.arc(length * k / count, length * k / count * curvature) for k in range(count + 1)]
    return np.array([(p.x, p.y, p.yaw) for p in poses], dtype=np.float64)

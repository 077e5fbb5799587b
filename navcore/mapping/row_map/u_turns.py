"""Turns over the headlands between neighbouring rows, as the planner drives them."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.maps.site_map import Point, Row, SiteMap
from navcore.maps.vector_map.vector_map import UTurn
from navcore.planning.driven_row import DrivenRow
from navcore.planning.free_space import FreeSpace
from navcore.planning.headland_turns import Turn, headland_turn
from navcore.planning.params import PlanningParams
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]

# Points of a turn's line are this far apart, m.
_STEP = 0.3
# Rows further apart than this, end from end, are no neighbours, m; and their directions differ by less, cosine.
_NEIGHBOURS, _PARALLEL = 14.0, 0.97


def u_turns(site: SiteMap, vehicle: VehicleParams, params: PlanningParams = PlanningParams()) -> tuple[UTurn, ...]:
    """One sweep for each two neighbouring rows at each end where one fits: within the planner's radii and the free
    space of the site's zones. A change of rows that needs three points with reverse is no U turn.
    """
    space = FreeSpace(site, vehicle, params)
    found = []
    for a, b in _neighbours(site.rows):
        for from_start in (True, False):
            left = DrivenRow(a, from_start)
            entered = _entered(left, b)
            turn = headland_turn(left, entered, partial(space.blocked_turn, end=left.far_end), params)
            if not turn.obstacle and len(turn.parts) == 1:
                found.append(UTurn(leaves=a.id, enters=b.id, line=_line(left, entered, turn)))
    return tuple(found)


def _neighbours(rows: tuple[Row, ...]) -> list[tuple[Row, Row]]:
    """Pairs of parallel rows with nothing between them."""
    pairs = []
    for a in rows:
        near = [(gap, b) for b in rows if a is not b and (gap := _gap(a, b)) <= _NEIGHBOURS]
        for gap, b in near:
            if rows.index(a) < rows.index(b) and not any(
                _gap(b, c) < gap and other < gap for other, c in near if c is not b
            ):
                pairs.append((a, b))
    return pairs


def _gap(a: Row, b: Row) -> float:
    """Distance between the ends of parallel rows, the larger of both ends', m; infinite for others."""
    ax, ay, bx, by = a.end[0] - a.start[0], a.end[1] - a.start[1], b.end[0] - b.start[0], b.end[1] - b.start[1]
    if abs(ax * bx + ay * by) < _PARALLEL * math.hypot(ax, ay) * math.hypot(bx, by):
        return math.inf
    same = max(math.dist(a.start, b.start), math.dist(a.end, b.end))
    turned = max(math.dist(a.start, b.end), math.dist(a.end, b.start))
    return min(same, turned)


def _entered(left: DrivenRow, row: Row) -> DrivenRow:
    end = left.far_end
    return DrivenRow(row, math.dist(end, row.start) <= math.dist(end, row.end))


def _line(left: DrivenRow, entered: DrivenRow, turn: Turn) -> tuple[Point, ...]:
    """From the end of one row to the entrance of the other, straight runs included."""
    out = left.line(left.length, left.length + turn.exit_length, _STEP)
    into = entered.line(-turn.entry_length, 0.0, _STEP)
    sweep = turn.parts[0][0]
    kept = sweep[:: max(round(_STEP / 0.1), 1)]
    poses: Floats = np.vstack((out, kept[1:], into))
    points = [(round(x, 3), round(y, 3)) for x, y in poses[:, :2].tolist()]
    return (points[0], *(q for p, q in pairwise(points) if math.dist(p, q) > 0.02))

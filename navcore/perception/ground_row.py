"""From the two image lines to the corridor on the ground, for the published fitters."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.angles import difference
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints
from navcore.perception.row_lines import GroundRow, RowLines

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundRowParams:
    """What two image lines must be on the ground to be a corridor.

    Attributes:
        near, far: distances ahead of the camera between which the lines are read, m.
        max_convergence_deg: two sides that differ more in direction do not belong to one corridor.
        min_width, max_width: m.
        offset_std, heading_std_deg: 1-sigma told for a row of this kind; single frames scatter by about that.
    """

    near: float = 2.0
    far: float = 6.0
    max_convergence_deg: float = 25.0
    min_width: float = 1.0
    max_width: float = 6.0
    offset_std: float = 0.15
    heading_std_deg: float = 4.0


def ground_row(
    lines: RowLines, corners: CornerPoints, camera: PinholeCamera, params: GroundRowParams
) -> GroundRow | str:
    """The corridor between both lines in the driving frame, or why they do not make one.

    `camera` is mounted in the driving frame. The ground is taken as flat and the camera as level as it was mounted.
    """
    if lines.left is None or lines.right is None:
        return lines.reason
    left, right = _on_ground(lines.left, camera, params), _on_ground(lines.right, camera, params)
    if left is None or right is None:
        return "the lines of plants rise above the horizon"
    if abs(difference(left.heading, right.heading)) > math.radians(params.max_convergence_deg):
        return "the two lines of plants do not run the same way"
    heading = left.heading + difference(right.heading, left.heading) / 2
    width = _across(left, heading) - _across(right, heading)
    if not params.min_width <= width <= params.max_width:
        return f"the lines of plants are {abs(width):.1f} m apart"
    return _row(
        lines, corners, camera, params, (_across(left, heading) + _across(right, heading)) / 2, heading, width
    )


def _on_ground(line: Line2, camera: PinholeCamera, params: GroundRowParams) -> Line2 | None:
    """The image line on the ground, directed ahead; None if it does not come down to the ground there."""
    ahead = np.array([[camera.x + d, camera.y, 0.0] for d in (params.near, params.far)])
    rows = camera.project(ahead)[:, 1]
    pixels = [(line.x_at(float(v)), float(v)) for v in rows]
    if any(u is None for u, _ in pixels):
        return None
    ground = camera.ground(np.array(pixels, dtype=np.float64))
    try:
        return Line2.through(tuple(ground[0]), tuple(ground[1])) if np.isfinite(ground).all() else None
    except InputError:
        return None


def _across(line: Line2, heading: float) -> float:
    """Distance of the line's foot to the left of the origin, across `heading`."""
    x, y = line.foot
    return -math.sin(heading) * x + math.cos(heading) * y


def _row(
    lines: RowLines, corners: CornerPoints, camera: PinholeCamera, params: GroundRowParams,
    offset: float, heading: float, width: float,
) -> GroundRow:  # fmt: skip
    x = camera.ground(corners.feet)[:, 0]
    used = lines.kept & np.isfinite(x)
    seen = 0.5 * (lines.left_seen + lines.right_seen)
    return GroundRow(
        offset=offset, heading=heading, width=width, pitch=0.0,
        covariance=np.diag((params.offset_std**2, math.radians(params.heading_std_deg) ** 2)),
        left_x=x[used & lines.on_left], right_x=x[used & ~lines.on_left], quality=0.7 * seen,
    )  # fmt: skip

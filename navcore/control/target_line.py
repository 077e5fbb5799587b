"""The line to follow, whoever found it, as the robot sees it now."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from navcore.errors import NotFiniteError
from navcore.geometry.angles import wrap
from navcore.geometry.line2 import Line2
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2

# How much of a path is handed to the controller: enough behind for a projection, ahead for braking, m.
BEHIND = 1.5
AHEAD = 8.0
# Over how many metres a line bends on as it was seen to bend, and the points' distance on such a line, m.
BENDING = 1.5
BENT_STEP = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetLine:
    """A line in the driving frame (x the way the robot drives, y left) at the moment `now` of its making.

    Attributes:
        source: who found it, a word for people and logs.
        stamp_ns: capture time of the oldest measurement that it rests on.
        max_age_ns: how old that may be while still being driven on.
        path: the line in the driving frame, directed the way it is driven.
        s: arc length on `path` of the point nearest to the robot.
        lateral_error: of the robot from the line, m, positive when the robot is left of it.
        heading_error: of the robot from the line's direction, rad, positive when it points too far left.
        remaining: metres from that point to the line's end; None if the line has no known end.
        scanned: it runs between plants that a 2D LiDAR has placed, and is known to centimetres.
    """

    source: str
    stamp_ns: int
    max_age_ns: int
    path: Polyline
    s: float
    lateral_error: float
    heading_error: float
    remaining: float | None = None
    scanned: bool = False

    @property
    def deadline_ns(self) -> int:
        """After this moment the line must not be driven on."""
        return self.stamp_ns + self.max_age_ns

    def curvature_ahead(self, distance: float) -> float:
        """Curvature of the line `distance` metres ahead of the robot, 1/m."""
        return self.path.curvature_at(self.s + distance)


def target_from_path(
    path: Polyline, T_map_driving: SE2, *, source: str, stamp_ns: int, max_age_ns: int, near_s: float | None = None,
    ahead: float = AHEAD, scanned: bool = False,
) -> TargetLine:  # fmt: skip
    """Target of a path in `map` for a robot at `T_map_driving`; `near_s` as in `Polyline.project`.

    `ahead`: so much of the path is handed over beyond the robot, m.

    Past the path's end the line goes on straight. Raises NotFiniteError for a pose that is no number.
    """
    hit = path.project(T_map_driving.x, T_map_driving.y, near_s)
    s0, s1 = hit.s - BEHIND, hit.s + hit.beyond + ahead
    if s0 > 0.0 and s1 < path.length:
        seen = path.seen_from(T_map_driving, s0, s1)
        s = hit.s - path.vertex_before(s0)
    else:
        seen, s = _prolonged(path, T_map_driving, s0, s1), BEHIND + hit.beyond
    return TargetLine(
        source=source, stamp_ns=stamp_ns, max_age_ns=max_age_ns, path=seen, s=s, lateral_error=hit.lateral,
        heading_error=wrap(T_map_driving.yaw - hit.heading), remaining=path.length - hit.s - hit.beyond,
        scanned=scanned,
    )  # fmt: skip


def bent(target: TargetLine, curvature: float, since: float) -> TargetLine:
    """The same line where it bends by `curvature`, 1/m, to the left, from `since` m behind the robot on.

    Past `BENDING` m nobody has said how it goes on: straight.
    """
    # The robot's place lies in the middle of a step: there a chord runs as the arc does.
    behind = (math.ceil(max(since, BEHIND) / BENT_STEP) + 0.5) * BENT_STEP
    s = np.arange(target.s - behind, target.path.length, BENT_STEP)
    driven = s - (target.s - since)
    arc = np.clip(driven, 0.0, BENDING)
    left = curvature * arc * (driven - 0.5 * arc)
    ahead = target.path.at_all(s + 0.5 * BENT_STEP) - target.path.at_all(s - 0.5 * BENT_STEP)
    normal = np.column_stack((-ahead[:, 1], ahead[:, 0])) / BENT_STEP
    path = Polyline(target.path.at_all(s) + left[:, None] * normal)
    hit = path.project(0.0, 0.0, float(target.s - s[0]))
    return replace(target, path=path, s=hit.s, lateral_error=hit.lateral, heading_error=wrap(-hit.heading))


def _prolonged(path: Polyline, T_map_driving: SE2, s0: float, s1: float) -> Polyline:
    """The stretch in the driving frame, going on straight beyond the path's ends."""
    first, last = np.searchsorted(path.s, (s0 + 1e-6, s1 - 1e-6))
    points = np.vstack((path.at(s0), path.points[first:last], path.at(s1)))
    return Polyline(T_map_driving.inverse().apply(points))


def target_from_line(
    line: Line2, *, source: str, stamp_ns: int, max_age_ns: int, remaining: float | None = None
) -> TargetLine:
    """Target of a straight line in the driving frame, such as a row's centre line moved to now.

    The line may point either way: it is turned to the way the robot drives. Raises NotFiniteError.
    """
    if not all(map(math.isfinite, (line.nx, line.ny, line.offset))):
        raise NotFiniteError("A line to follow must be finite.")
    ahead = line if abs(line.heading) <= math.pi / 2 else line.reversed()
    fx, fy = ahead.foot
    ux, uy = math.cos(ahead.heading), math.sin(ahead.heading)
    points = np.array([(fx + a * ux, fy + a * uy) for a in (-BEHIND, AHEAD)])
    return TargetLine(
        source=source, stamp_ns=stamp_ns, max_age_ns=max_age_ns, path=Polyline(points), s=BEHIND,
        lateral_error=ahead.distance(0.0, 0.0), heading_error=wrap(-ahead.heading), remaining=remaining,
    )  # fmt: skip


def line_from_row(offset: float, heading: float) -> Line2:
    """A row observation (`offset` positive if the line is left of the robot, `heading` of the line) as a line."""
    return Line2.along((-offset * math.sin(heading), offset * math.cos(heading)), heading)

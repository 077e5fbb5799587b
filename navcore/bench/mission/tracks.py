"""The three tracks of paper A's Table 12: 100 m of straight road, of curve, and of Z, driven on GNSS alone."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from navcore.bench.mission.cases import Track
from navcore.geometry.polyline import Floats
from navcore.maps.site_map import Datum, Lane, SiteMap
from navcore.messages import MissionPlan, PathSegment, Point, SegmentKind

LENGTH_M = 100.0
# The robot starts so far left of the line, m: paper A's drives include the capture of the path.
START_OFFSET_M = 1.1
SPEED = 0.8
_STEP_M = 0.1
# Curvature (1/m) of the curve: a half circle of 100 m. The Z's two corners: 120 deg each, 1.5 m radius.
_CURVE = math.pi / LENGTH_M
_Z_RADIUS, _Z_TURN = 1.5, math.radians(120.0)


def track_site(track: Track) -> SiteMap:
    """Open ground with the track as its only lane."""
    points = track_points(track)
    lane = tuple((float(x), float(y)) for x, y in points[:: round(2.0 / _STEP_M)])
    return SiteMap(
        name=f"Track {track}",
        datum=Datum(lat_deg=45.0, lon_deg=9.0, height_m=100.0),
        lanes=(Lane(id="track", points=lane),),
    )


def track_plan(track: Track) -> MissionPlan:
    """One road segment along the track at 0.8 m/s."""
    points: tuple[Point, ...] = tuple((float(x), float(y)) for x, y in track_points(track))
    road = PathSegment(kind=SegmentKind.ROAD, points=points, speeds=(SPEED,) * len(points))
    return MissionPlan(mission_id=f"track-{track}", name=str(track), datum=(45.0, 9.0, 100.0), segments=(road,))


def track_start() -> tuple[float, float, float]:
    """Pose of the robot at first: beside the track's first point, along it."""
    return 0.0, START_OFFSET_M, 0.0


def track_points(track: Track) -> Floats:
    """Points (N, 2), 0.1 m apart, from the origin eastwards, by integration of the curvature."""
    s = np.arange(0.0, LENGTH_M + _STEP_M / 2, _STEP_M)
    heading = np.cumsum([_CURVATURE[track](float(a)) for a in s]) * _STEP_M
    steps = _STEP_M * np.column_stack((np.cos(heading), np.sin(heading)))
    return np.vstack((np.zeros((1, 2)), np.cumsum(steps[:-1], axis=0)))


def _z(s: float) -> float:
    """Curvature of the Z: three legs, turned by 120 deg to the left, then to the right."""
    arc = _Z_RADIUS * _Z_TURN
    leg = (LENGTH_M - 2.0 * arc) / 3.0
    if leg <= s < leg + arc:
        return 1.0 / _Z_RADIUS
    return -1.0 / _Z_RADIUS if 2.0 * leg + arc <= s < 2.0 * (leg + arc) else 0.0


_CURVATURE: dict[Track, Callable[[float], float]] = {
    Track.STRAIGHT: lambda _: 0.0,
    Track.CURVE: lambda _: _CURVE,
    Track.Z: _z,
}

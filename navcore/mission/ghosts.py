"""What each source alone says of the robot's place: four ghosts, and how far each is from the driven pose."""

from __future__ import annotations

import math
from collections.abc import Iterator

from navcore.geometry.se2 import SE2
from navcore.messages import Ghost, GhostSource, PoseEstimate
from navcore.mission.mode_selector import ON_POSE
from navcore.mission.situation import Situation

# Older than this a source says nothing of now, s.
FRESH_S = 1.0


def ghosts(now: Situation, now_ns: int, driven: PoseEstimate | None) -> tuple[Ghost, ...]:
    """Those of the sources that speak now; none on a robot without a 3D LiDAR."""
    if now.senses.on_map.told is None or driven is None:
        return ()
    return tuple(
        Ghost(source=source, x=at.x, y=at.y, yaw=at.yaw, apart=math.hypot(at.x - driven.x, at.y - driven.y))
        for source, at in _places(now, now_ns, driven)
    )


def _places(now: Situation, now_ns: int, driven: PoseEstimate) -> Iterator[tuple[GhostSource, SE2]]:
    senses, pilot = now.senses, now.pilot
    age_s, fix = senses.gnss.age_s(now_ns), senses.gnss.newest
    if fix is not None and age_s is not None and age_s <= FRESH_S:
        by_fix = senses.on_map.base_by_fix(driven.yaw)
        if by_fix is not None:
            yield GhostSource.GNSS, _carried(by_fix, senses.filter.odom_at(fix.stamp_ns), senses.T_odom_base)
    if pilot is not None:
        yield GhostSource.ODOMETRY, pilot.start_tie @ senses.T_odom_base
        if pilot.mode not in ON_POSE:
            yield GhostSource.ROWS, pilot.anchor.T_map_odom @ senses.T_odom_base
    age_s = senses.on_map.age_s(now_ns)
    if age_s is not None and age_s <= FRESH_S:
        yield GhostSource.MAP, senses.on_map.T_map_odom @ senses.T_odom_base


def _carried(at: SE2, T_odom_then: SE2, T_odom_now: SE2) -> SE2:
    """A place of a moment ago, carried on by what was driven since."""
    return at @ (T_odom_then.inverse() @ T_odom_now)

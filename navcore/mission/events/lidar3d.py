"""When a 3D LiDAR does not do well or its map is old, and what the operator is told then. All are warnings: a place
on the map is believed or not by other witnesses.
"""

from __future__ import annotations

import math

from navcore.messages import LidarCondition
from navcore.mission.events.facts import EventFacts, EventParams

_MEND = "its mount has moved. Straighten it, or correct its mount in the settings."


def is_empty(f: EventFacts, p: EventParams) -> bool:
    """It turns and hardly anything comes back."""
    lidar = _lidar(f)
    return lidar is not None and lidar.points < p.lidar3d_least


def empty_words(f: EventFacts) -> str:
    """For the operator."""
    return "The 3D LiDAR sees nothing. Look whether something covers it, and wipe it clean."


def is_leaning(f: EventFacts, p: EventParams) -> bool:
    """The ground under the robot seems to lean."""
    lidar = _lidar(f)
    return lidar is not None and max(abs(lidar.roll), abs(lidar.pitch)) > math.radians(p.lidar3d_deg)


def leaning_words(f: EventFacts) -> str:
    """By how much, and to which side: where the LiDAR has sunk, the ground seems to rise."""
    lidar = _lidar(f) or LidarCondition(points=0)
    if abs(lidar.roll) >= abs(lidar.pitch):
        lean, side = lidar.roll, "left" if lidar.roll > 0.0 else "right"
    else:
        lean, side = lidar.pitch, "back" if lidar.pitch > 0.0 else "front"
    return f"The 3D LiDAR leans {abs(math.degrees(lean)):.0f} degrees to the {side}: {_MEND}"


def is_aside(f: EventFacts, p: EventParams) -> bool:
    """The robot goes elsewhere than the LiDAR looks."""
    return abs(f.lidar3d_turned) > math.radians(p.lidar3d_deg)


def aside_words(f: EventFacts) -> str:
    """By how much, and to which side."""
    side = "left" if f.lidar3d_turned > 0.0 else "right"
    return f"The 3D LiDAR looks {abs(math.degrees(f.lidar3d_turned)):.0f} degrees too far to the {side}: {_MEND}"


def is_raining(f: EventFacts, p: EventParams) -> bool:
    """Much hangs in the air before it."""
    lidar = _lidar(f)
    return lidar is not None and lidar.air > p.air


def raining_words(f: EventFacts) -> str:
    """How much."""
    lidar = _lidar(f) or LidarCondition(points=0)
    return (
        f"Rain, snow or dust before the 3D LiDAR: {lidar.air:.0%} of what is near hangs in the air. Look whether the "
        "place on the map stays right, and wipe the LiDAR."
    )


def is_outdated(f: EventFacts, p: EventParams) -> bool:
    """Posts and trunks of the map are not there."""
    m = f.map_match
    return m is not None and m.passed >= p.passed and m.gone > p.gone * m.passed


def outdated_words(f: EventFacts) -> str:
    """How many."""
    gone, passed = (f.map_match.gone, f.map_match.passed) if f.map_match else (0, 0)
    return (
        f"The 3D map is old: {gone} of the last {passed} posts and trunks of it are not there any more. "
        "Make a new one from this run."
    )


def _lidar(f: EventFacts) -> LidarCondition | None:
    return f.map_match.lidar if f.map_match is not None else None

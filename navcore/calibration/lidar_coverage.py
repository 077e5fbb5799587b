"""Which poses of the board are still missing to tell where a camera sits to a LiDAR."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarCoverageParams:
    """What a good set of poses has. Ours; such sets tell rendered mounts to 2 mm and 0.1 deg.

    Attributes:
        poses: in all; 6 or more.
        side: board's middle further to the side than that share of its distance counts as left or right; 0 to 1.
        tilt_deg: tilted from here, the normal against the ray to the board; 5 to 45.
        turn_deg: turned in its own plane from here; 5 to 90.
        each: poses of each kind; >= 1.
        depth: the furthest is so many times as far as the nearest; > 1.
    """

    poses: int = 20
    side: float = 0.2
    tilt_deg: float = 15.0
    turn_deg: float = 15.0
    each: int = 2
    depth: float = 1.5


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarCoverage:
    """What is missing, sentences, the most useful first; and the share of what is asked that is there, 0 to 1."""

    missing: tuple[str, ...]
    share: float


def missing_lidar_poses(poses: Sequence[Floats], params: LidarCoverageParams) -> LidarCoverage:
    """Of poses T_camera_board (4, 4), optical axes."""
    T = np.array(poses, dtype=np.float64).reshape(-1, 4, 4)
    asked = [*_kinds(T, params), _depth(T[:, :3, 3], params)]
    asked.append((len(T) >= params.poses, f"Take {params.poses} poses, each another one."))
    missing = tuple(wish for is_there, wish in asked if not is_there)
    return LidarCoverage(missing=missing, share=1.0 - len(missing) / len(asked))


def _kinds(T: Floats, params: LidarCoverageParams) -> list[tuple[bool, str]]:
    """Sides, tilts and turns, each asked for a few times."""
    sideways = T[:, 0, 3] / np.maximum(T[:, 2, 3], 1e-9)
    across, down = tilts_deg(T)
    turn = np.degrees(np.arctan2(T[:, 1, 0], T[:, 0, 0]))
    side, tilt, spin = params.side, params.tilt_deg, params.turn_deg
    kinds = (
        (sideways < -side, "Hold the board further to the left."),
        (sideways > side, "Hold the board further to the right."),
        (across < -tilt, "Tilt the board: bring its left edge nearer by 30 deg."),
        (across > tilt, "Tilt the board: bring its right edge nearer by 30 deg."),
        (down < -tilt, "Tilt the board: bring its upper edge nearer by 30 deg."),
        (down > tilt, "Tilt the board: bring its lower edge nearer by 30 deg."),
        (turn > spin, "Turn the board clockwise by 30 deg in its plane, so that the LiDAR cuts slanted edges."),
        (turn < -spin, "Turn the board anticlockwise by 30 deg in its plane, so that the LiDAR cuts slanted edges."),
    )
    return [(int(np.count_nonzero(seen)) >= params.each, wish) for seen, wish in kinds]


def _depth(places: Floats, params: LidarCoverageParams) -> tuple[bool, str]:
    away = np.linalg.norm(places, axis=1)
    wide = len(away) > 0 and float(away.max()) >= params.depth * float(away.min())
    return wide, "Hold the board near the robot, and as far away as it is still found."


def tilts_deg(T: Floats) -> tuple[Floats, Floats]:
    """How far the right edge and the lower edge of boards (N, 4, 4) are nearer than if they faced the camera, deg."""
    normal, ray = T[:, :3, 2], T[:, :3, 3]
    across = np.arctan2(normal[:, 0], normal[:, 2]) - np.arctan2(ray[:, 0], ray[:, 2])
    down = np.arctan2(normal[:, 1], normal[:, 2]) - np.arctan2(ray[:, 1], ray[:, 2])
    return np.asarray(across * 180.0 / math.pi), np.asarray(down * 180.0 / math.pi)

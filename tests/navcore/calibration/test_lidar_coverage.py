"""What is missing to tell a mount: sides, tilts, turns, depth."""

from __future__ import annotations

import math

import numpy as np

from navcore.calibration.lidar_coverage import LidarCoverageParams, missing_lidar_poses, tilts_deg
from navcore.geometry.pinhole import rotation_from_rpy
from tests.navcore.calibration.boards import Floats, facing

PARAMS = LidarCoverageParams()


def turned(about: tuple[float, float, float], depth: float = 0.8, x: float = 0.0) -> Floats:
    """A board turned about the camera's right, down and forward axes, deg."""
    T = facing(depth, x=x)
    T[:3, :3] = rotation_from_rpy(*(math.radians(angle) for angle in about))
    return T


def test_an_empty_set_misses_everything_and_a_wish_goes_when_it_is_granted() -> None:
    nothing = missing_lidar_poses([], PARAMS)
    assert nothing.share == 0.0
    assert len(nothing.missing) == 10
    left = missing_lidar_poses([turned((0, -20.6, 0), x=-0.3)] * 2, PARAMS)  # faces the camera
    assert set(nothing.missing) - set(left.missing) == {"Hold the board further to the left."}


def test_tilts_are_told_by_the_edge_that_comes_nearer() -> None:
    right_edge_nearer = turned((0, 20, 0))
    corner = right_edge_nearer[:3, :3] @ (0.1, 0.0, 0.0)
    assert corner[2] < 0.0
    across, down = tilts_deg(np.array([right_edge_nearer]))
    assert across[0] > 15.0
    assert abs(down[0]) < 1e-6
    lower_edge_nearer = turned((-20, 0, 0))
    assert (lower_edge_nearer[:3, :3] @ (0.0, 0.1, 0.0))[2] < 0.0
    assert tilts_deg(np.array([lower_edge_nearer]))[1][0] > 15.0


def test_a_full_set_misses_nothing() -> None:
    kinds = [(0, 20, 0), (0, -20, 0), (20, 0, 0), (-20, 0, 0), (0, 0, 30), (0, 0, -30)]
    poses = [turned(kind, depth) for kind in kinds for depth in (0.6, 1.0)]
    poses += [turned((0, 0, 0), 0.8, x) for x in (-0.3, -0.25, 0.25, 0.3)] + [
        turned((0, 0, 0), d) for d in (0.7, 0.9, 1.1, 1.2)
    ]
    told = missing_lidar_poses(poses, PARAMS)
    assert (told.missing, told.share) == ((), 1.0)

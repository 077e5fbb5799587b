"""A scan becomes points in the robot's frame, as if taken at once."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import LidarScan
from navcore.perception.scan.scan_points import ScanPoints, ScanPointsParams, scan_points
from tests.navcore.perception.scan.scans import MOUNT, driven, trunk_scan

PARAMS = ScanPointsParams()
TRUNKS = np.array([[2.0, 1.2, 0.05], [4.0, -1.3, 0.06], [-1.5, 1.1, 0.04], [1.0, -1.0, 0.07]])


def off_trunks(points: ScanPoints) -> NDArray[np.float64]:
    """How far valid points are from the nearest trunk's bark, m."""
    xy = points.xy[points.valid]
    away = np.hypot(xy[:, None, 0] - TRUNKS[:, 0], xy[:, None, 1] - TRUNKS[:, 1]) - TRUNKS[:, 2]
    return np.asarray(np.abs(away).min(axis=1))


@pytest.mark.parametrize(
    "mount",
    [
        MOUNT,
        replace(MOUNT, roll=math.pi),
        replace(MOUNT, yaw=2.0),
        LidarMount(x=-0.3, y=0.1, z=0.4, roll=math.pi, yaw=-1.0),
        replace(MOUNT, pitch=0.05),
    ],
)
def test_points_lie_on_the_trunks_however_the_sensor_is_mounted(mount: LidarMount) -> None:
    points = scan_points(trunk_scan(TRUNKS, mount), mount, PARAMS)
    assert points.valid.sum() > 40
    assert off_trunks(points).max() < 1e-9  # m


@pytest.mark.parametrize(("speed", "omega"), [(2.0, 0.0), (1.0, 0.7), (0.0, -1.2), (-1.5, 0.3)])
def test_the_robots_own_motion_is_taken_out_ray_by_ray(speed: float, omega: float) -> None:
    scan = trunk_scan(TRUNKS, speed=speed, omega=omega)
    moved, still = (scan_points(scan, MOUNT, PARAMS, motion) for motion in (driven(speed, omega), None))
    assert off_trunks(moved).max() < 1e-9  # m
    assert off_trunks(still).max() > 0.03  # m


def test_the_last_ray_is_where_it_was_and_the_first_is_a_turn_back() -> None:
    scan = LidarScan(stamp_ns=1, began_ns=0, angles=(0.0, 0.0, 0.0), distances=(1.0, 1.0, 1.0))
    points = scan_points(scan, LidarMount(x=0.0, y=0.0, z=0.5), PARAMS, SE2(0.2, 0.0, 0.0))
    assert points.xy[:, 0] == pytest.approx([0.8, 0.9, 1.0])  # m
    assert points.origins[:, 0] == pytest.approx([-0.2, -0.1, 0.0])  # m
    assert points.centre == (0.0, 0.0)


def test_rays_without_a_return_too_near_or_too_far_are_none() -> None:
    scan = LidarScan(stamp_ns=1, began_ns=0, angles=(0.0, 0.1, 0.2, 0.3), distances=(0.0, 0.1, 3.0, 12.5))
    points = scan_points(scan, MOUNT, PARAMS)
    assert points.valid.tolist() == [False, False, True, False]
    assert np.isnan(points.xy[~points.valid]).all()


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_ray_that_is_no_number_is_refused(bad: float) -> None:
    with pytest.raises(NotFiniteError, match="distance 0"):
        scan_points(LidarScan(stamp_ns=1, began_ns=0, angles=(0.0,), distances=(bad,)), MOUNT, PARAMS)
    with pytest.raises(NotFiniteError, match="not a number"):
        scan_points(LidarScan(stamp_ns=1, began_ns=0, angles=(bad,), distances=(1.0,)), MOUNT, PARAMS)
    with pytest.raises(NotFiniteError, match="leave it out"):
        scan_points(trunk_scan(TRUNKS, rays=8), MOUNT, PARAMS, SE2(bad, 0.0, 0.0))


def test_scans_that_are_none_are_refused() -> None:
    with pytest.raises(InputError, match="2 angles but 1 distances"):
        scan_points(LidarScan(stamp_ns=1, began_ns=0, angles=(0.0, 0.1), distances=(1.0,)), MOUNT, PARAMS)
    with pytest.raises(InputError, match="negative"):
        scan_points(LidarScan(stamp_ns=1, began_ns=0, angles=(0.0,), distances=(-1.0,)), MOUNT, PARAMS)
    with pytest.raises(InputError, match="clock"):
        scan_points(LidarScan(stamp_ns=1, began_ns=2, angles=(0.0,), distances=(1.0,)), MOUNT, PARAMS)
    with pytest.raises(ContractError, match="90 deg"):
        scan_points(trunk_scan(TRUNKS, rays=8), MOUNT, PARAMS, SE2(0.0, 0.0, 2.0))


def test_a_scan_of_no_rays_has_no_points() -> None:
    points = scan_points(
        LidarScan(stamp_ns=1, began_ns=0, angles=(), distances=()), MOUNT, PARAMS, SE2(0.1, 0.0, 0.1)
    )
    assert points.xy.shape == (0, 2)
    assert points.centre == (0.0, 0.0)

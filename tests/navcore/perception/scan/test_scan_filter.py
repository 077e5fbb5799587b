"""The published filter of a scan: a window beside the robot, and spikes."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

from navcore.errors import ConfigError
from navcore.geometry.lidar_mount import LidarMount
from navcore.messages import LidarScan
from navcore.perception.scan.scan_filter import ScanFilterParams, scan_filter
from navcore.perception.scan.scan_points import ScanPoints, ScanPointsParams, scan_points

LEFT = math.pi / 2
PARAMS = ScanFilterParams()


def rays(distances: Sequence[float], towards: float = LEFT) -> ScanPoints:
    """Points of rays 0.2 deg apart."""
    angles = tuple(towards + 0.0035 * k for k in range(len(distances)))
    scan = LidarScan(stamp_ns=1, began_ns=0, angles=angles, distances=tuple(distances))
    return scan_points(scan, LidarMount(x=0.4, y=0.0, z=0.5), ScanPointsParams())


def test_only_what_stands_beside_the_robot_within_the_window_counts() -> None:
    points = rays([0.4, 0.6, 1.9, 2.1, 0.0])
    assert scan_filter(points, PARAMS).valid.tolist() == [False, True, True, False, False]
    assert not scan_filter(rays([1.5] * 5, towards=0.0), PARAMS).valid.any()


def test_both_sides_count() -> None:
    assert scan_filter(rays([1.2] * 4, towards=-LEFT), PARAMS).valid.all()


def test_a_spike_takes_its_medians_distance_along_its_own_ray() -> None:
    before = rays([1.2, 1.2, 1.6, 1.2, 1.2])
    after = scan_filter(before, PARAMS)
    assert after.distances.tolist() == [1.2] * 5
    bearing = np.arctan2(*(after.xy - after.origins).T[::-1])
    assert bearing == pytest.approx(np.arctan2(*(before.xy - before.origins).T[::-1]))
    assert np.hypot(*(after.xy - after.origins).T) == pytest.approx(1.2)  # m


def test_what_is_off_its_median_by_less_than_a_spike_stays() -> None:
    assert scan_filter(rays([1.2, 1.2, 1.34, 1.2, 1.2]), PARAMS).distances[2] == 1.34


def test_the_median_is_taken_of_what_stands_in_the_window() -> None:
    """Rays that went through to the next rows do not pull a trunk of two rays away."""
    after = scan_filter(rays([5.0, 5.0, 1.2, 1.25, 5.0, 5.0]), PARAMS)
    assert after.distances[after.valid].tolist() == [1.2, 1.25]


def test_of_an_even_number_the_nearer_middle_one_is_the_median() -> None:
    assert scan_filter(rays([1.2, 1.8]), PARAMS).distances.tolist() == [1.2, 1.2]


def test_windows_that_are_none_are_refused() -> None:
    with pytest.raises(ConfigError, match="nearest < furthest"):
        ScanFilterParams(nearest=2.0, furthest=1.0)
    with pytest.raises(ConfigError, match="nearest < furthest"):
        ScanFilterParams(nearest=math.nan)
    with pytest.raises(ConfigError, match="odd"):
        ScanFilterParams(window=4)

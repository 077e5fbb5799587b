"""A start on the 3D map must lie where GNSS puts the robot, and look where it points."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.localization.ndt.ndt_matcher import NdtMatcher
from navcore.localization.ndt.registration import Registration
from navcore.messages import FixQuality, MapMatch, MatchState, Odometry, PoseEstimate
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at

TRUTH = SE3.from_rpy((0.5, 0.2, 0.6))


def known(off: float, turned_deg: float, yaw_std: float) -> Odometry:
    """By a guess that lies `off` m aside and is turned; known to 0.1 m."""
    pose = PoseEstimate(
        stamp_ns=0, x=float(TRUTH.t[0]), y=float(TRUTH.t[1]) + off, yaw=math.radians(turned_deg), v=0.0, omega=0.0,
        covariance=tuple(np.diag((0.01, 0.01, yaw_std**2)).ravel().tolist()), source="told",
    )  # fmt: skip
    return Odometry(
        stamp_ns=0, x=0.0, y=0.0, yaw=0.0, v=0.0, omega=0.0, roll=0.0, pitch=0.0, pose=pose,
        quality=FixQuality.RTK_FIXED,
    )  # fmt: skip


def started(off: float, turned_deg: float, yaw_std: float) -> MapMatch:
    """The first cloud at a `known` place."""
    return MapLocalizer(mapped_orchard()).process(scan_at(TRUTH, 3, n=20_000), 1, known(off, turned_deg, yaw_std))


@pytest.mark.parametrize(("turned_deg", "yaw_std"), [(0.0, 0.01), (4.0, 0.01), (12.0, 0.3)])
def test_a_start_within_what_is_known_is_taken(turned_deg: float, yaw_std: float) -> None:
    match = started(0.1, turned_deg, yaw_std)
    assert (match.state, match.reason) == (MatchState.STARTING, "the place is being confirmed")
    assert (match.x, match.y) == pytest.approx((0.5, 0.2), abs=0.05)  # m


def test_a_start_that_is_turned_against_a_heading_that_is_known_is_refused() -> None:
    match = started(0.1, 12.0, 0.01)
    assert match.state is MatchState.STARTING
    assert "turned by 12 deg" in match.reason


def test_an_empty_cloud_is_told_and_is_no_place() -> None:
    localizer = MapLocalizer(mapped_orchard())
    motion = Odometry(
        stamp_ns=0, x=0.0, y=0.0, yaw=0.0, v=0.0, omega=0.0, roll=0.0, pitch=0.0, pose=None, quality=FixQuality.NONE
    )
    assert localizer.process(np.empty((0, 3)), 1, motion).state is MatchState.STARTING


def test_where_there_is_no_map_a_start_is_tried_once_a_second_and_not_with_every_cloud(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried, match = list[SE3](), NdtMatcher.match

    def counted(self: NdtMatcher, points: np.ndarray, guess: SE3) -> Registration:
        tried.append(guess)
        return match(self, points, guess)

    monkeypatch.setattr(NdtMatcher, "match", counted)
    localizer, cloud = MapLocalizer(mapped_orchard()), scan_at(TRUTH, 3, n=20_000)
    for tenth in range(20):
        found = localizer.process(cloud, tenth * 100_000_000, known(300.0, 0.0, 0.01))
        assert found.state is MatchState.STARTING
        assert "points lie where the map has any" in found.reason
    assert len(tried) == 2

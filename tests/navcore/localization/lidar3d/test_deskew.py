"""Points of a turn that were taken while the robot drove, turned and swayed, as if all were taken at its end."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.drivers.lidar3d.models import C16
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.errors import InputError, NotFiniteError
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.screw import Screw
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.deskew import Deskew, DeskewParams
from navcore.localization.motion_track import MotionTrack
from navcore.sim.lidar3d_device import Lidar3dDevice
from navcore.sim.lidar3d_sweep import swept_cloud

Floats = NDArray[np.float64]
MS = 1_000_000
STAMP_NS = 3_000 * MS
# From the first ray to the last.
TURN_S = 0.1 - 3.125e-6
MOUNT = SE3.from_rpy((0.4, -0.1, 1.3), 0.02, 0.05, 0.3)
# In the still frame: normal and distance of walls to the left and ahead, and of the ground.
PLANES = np.array(((0.0, 1.0, 0.0, 3.0), (0.8, 0.6, 0.0, 9.0), (0.0, 0.0, -1.0, 0.0)))
FARTHEST = 25.0
Motion = Callable[[float], SE3]


def bumpy(t: float) -> SE3:
    """Where `base_link` is t s after the turn began: speeding up at 1 m/s^2 and 1 rad/s^2, and swaying."""
    yaw, driven = 0.8 * t + 0.5 * t * t, 1.2 * t + 0.5 * t * t
    sway = 0.02 * math.sin(9.0 * t), 0.015 * math.cos(7.0 * t)
    return SE3.from_rpy((driven * math.cos(yaw / 2.0), driven * math.sin(yaw / 2.0), 0.0), sway[0], sway[1], yaw)


@functools.cache
def seen(motion: Motion) -> PointCloud:
    """A seventh of a turn's rays of a C16, of all channels, between the planes while the robot moves."""

    def scene(origins: Floats, directions: Floats, times: Floats) -> Floats:
        met = np.zeros(len(times))
        met[::7] = _far(origins[::7], directions[::7], [motion(t) @ MOUNT for t in times[::7].tolist()])
        return met

    return swept_cloud(scene, C16)


def _far(origins: Floats, directions: Floats, T_still_lidar: list[SE3]) -> Floats:
    """To the nearest plane, m; 0 for none."""
    R, t = np.array([pose.R for pose in T_still_lidar]), np.array([pose.t for pose in T_still_lidar])
    o, d = np.einsum("nij,nj->ni", R, origins) + t, np.einsum("nij,nj->ni", R, directions)
    with np.errstate(divide="ignore"):
        far = (PLANES[:, 3] - o @ PLANES[:, :3].T) / (d @ PLANES[:, :3].T)
    far[far <= 0.0] = np.inf
    return np.where(far.min(axis=1) < FARTHEST, far.min(axis=1), 0.0)


def stamped(motion: Motion, every_ms: int, first_ms: int = -20, last_ms: int = 120) -> MotionTrack:
    """Poses at that pace; 0 is the turn's begin."""
    at = range(first_ms, last_ms + 1, every_ms)
    began = STAMP_NS - round(TURN_S * 1e9)
    return MotionTrack.of_poses([began + ms * MS for ms in at], [motion(ms / 1000.0) for ms in at])


def off_planes(cloud: PointCloud, T_still_lidar: SE3) -> Floats:
    """From the nearest plane, m."""
    points = T_still_lidar.apply(cloud.points)
    return np.asarray(np.abs(points @ PLANES[:, :3].T - PLANES[:, 3]).min(axis=1))


@pytest.mark.parametrize(("every_ms", "within"), [(5, 0.0003), (10, 0.001), (20, 0.003)])  # m
def test_walls_seen_from_a_robot_that_drives_turns_and_sways_are_flat(every_ms: int, within: float) -> None:
    """Within a millimetre at 25 m at the pace of an IMU, 100 a second."""
    cloud = seen(bumpy)
    T_end = bumpy(TURN_S) @ MOUNT
    assert off_planes(cloud, T_end).max() > 0.5  # m: what it is good for
    result = Deskew(MOUNT).process(cloud, STAMP_NS, stamped(bumpy, every_ms))
    assert result.cloud is not None
    assert off_planes(result.cloud, T_end).max() < within


def test_speed_and_turn_rates_do_as_well_as_poses() -> None:
    """At 100 a second, as an IMU tells them."""
    second = Screw.of_rates((1.5, 0.0, 0.0), (0.1, -0.2, 1.0), 1.0)
    stamps = [STAMP_NS + ms * MS for ms in range(-110, 11, 10)]
    track = MotionTrack.of_rates(stamps, [1.5] * len(stamps), [(0.1, -0.2, 1.0)] * len(stamps))
    result = Deskew(MOUNT).process(seen(second.pose), STAMP_NS, track)
    assert result.cloud is not None
    assert off_planes(result.cloud, second.pose(TURN_S) @ MOUNT).max() < 0.001  # m


def test_a_turn_that_came_as_packets_of_a_c16_is_flat_too() -> None:
    """The whole way: rays of a moving robot, bytes, points with their times, and the motion by our own clock."""
    on_ns = 7_000 * MS
    second = Screw.of_rates((1.2, 0.0, 0.0), (0.05, -0.1, 0.9), 1.0)
    device = Lidar3dDevice(lambda turn: seen(lambda t: second.pose(0.1 * turn + t)))
    sent = [data for data in device.run(0.23) if data.startswith(b"\xff\xee")]
    # The device is switched on at on_ns; its packets come half a millisecond after their last ray.
    came = [on_ns + int.from_bytes(data[1200:1204], "little") * 1000 + 500_000 for data in sent]
    stream = LidarStream(C16)
    (turn,) = [turn for data, at in zip(sent, came, strict=True) if (turn := stream.feed(data, at))]
    track = MotionTrack.of_poses(
        [on_ns + ms * MS for ms in range(0, 301, 20)], [second.pose(ms / 1000.0) for ms in range(0, 301, 20)]
    )
    still = Deskew(MOUNT).process(turn.cloud, turn.stamp_ns, track).cloud
    T_end = second.pose((turn.stamp_ns - on_ns) * 1e-9) @ MOUNT
    assert still is not None
    assert len(still) > 3_000
    assert off_planes(turn.cloud, T_end).max() > 0.5  # m
    # Half steps of distance, 1.25 mm, and of azimuth, 0.005 deg, which at a graze is more.
    assert np.percentile(off_planes(still, T_end), 99) < 0.003  # m


def test_without_motion_nothing_changes() -> None:
    cloud = seen(lambda _: SE3.identity())
    track = stamped(lambda _: SE3.from_rpy((5.0, 6.0, 0.0), 0.1, 0.2, 3.0), 20)
    result = Deskew(MOUNT).process(cloud, STAMP_NS, track)
    assert result.cloud is not None
    assert np.abs(result.cloud.points - cloud.points).max() < 1e-9  # m
    assert np.array_equal(result.cloud.times, cloud.times)


def small_cloud(seed: int) -> PointCloud:
    rng = np.random.default_rng(seed)
    n = 40
    return PointCloud(
        points=rng.uniform(-30.0, 30.0, (n, 3)), times=-rng.uniform(0.0, TURN_S, n),
        intensities=np.zeros(n, dtype=np.uint8), rings=np.zeros(n, dtype=np.uint8),
    )  # fmt: skip


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 1000), x=st.floats(-1e3, 1e3), yaw=st.floats(-3.0, 3.0))
def test_it_does_not_matter_in_which_still_frame_the_poses_are(seed: int, x: float, yaw: float) -> None:
    moved = SE3.from_rpy((x, -x, 1.0), 0.1, 0.0, yaw)
    cloud = small_cloud(seed)
    here = Deskew(MOUNT).process(cloud, STAMP_NS, stamped(bumpy, 20)).cloud
    there = Deskew(MOUNT).process(cloud, STAMP_NS, stamped(lambda t: moved @ bumpy(t), 20)).cloud
    assert here is not None
    assert there is not None
    assert there.points == pytest.approx(here.points, abs=1e-8)  # m


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 1000))
def test_each_point_is_moved_by_the_poses_of_its_time_and_of_the_stamp(seed: int) -> None:
    cloud, track = small_cloud(seed), stamped(bumpy, 20)
    result = Deskew(MOUNT).process(cloud, STAMP_NS, track).cloud
    assert result is not None
    T_now = track.T_still_base(STAMP_NS) @ MOUNT
    for point, t, found in zip(cloud.points, cloud.times, result.points, strict=True):
        T_then = track.T_still_base(STAMP_NS + round(float(t) * 1e9)) @ MOUNT
        assert (T_now.inverse() @ T_then).apply(point[None])[0] == pytest.approx(found, abs=1e-6)  # m


def test_motion_goes_on_for_a_moment_beyond_what_is_known_and_no_longer() -> None:
    cloud = seen(bumpy)
    short = stamped(bumpy, 10, last_ms=90)
    result = Deskew(MOUNT).process(cloud, STAMP_NS, short)
    assert result.cloud is not None
    assert off_planes(result.cloud, bumpy(TURN_S) @ MOUNT).max() < 0.02  # m
    for track in (stamped(bumpy, 10, last_ms=40), stamped(bumpy, 10, first_ms=60)):
        refused = Deskew(MOUNT).process(cloud, STAMP_NS, track)
        assert refused.cloud is None
        assert (
            refused.reason == "the robot's motion during the scan is not known: odometry or IMU are missing or late"
        )


def test_a_hole_in_the_motion_is_told() -> None:
    track = stamped(bumpy, 300, first_ms=-100, last_ms=200)
    refused = Deskew(MOUNT).process(seen(bumpy), STAMP_NS, track)
    assert (refused.cloud, refused.reason) == (None, "odometry and IMU were silent during the scan")
    patient = Deskew(MOUNT, DeskewParams(gap_s=0.4)).process(seen(bumpy), STAMP_NS, track)
    assert patient.cloud is not None


def test_an_empty_cloud_stays_empty() -> None:
    result = Deskew(MOUNT).process(PointCloud.of(np.empty((0, 3))), STAMP_NS, stamped(bumpy, 20))
    assert result.cloud is not None
    assert len(result.cloud) == 0


def test_nan_and_stamps_that_do_not_grow_are_refused() -> None:
    broken = SE3(np.eye(3), np.array((math.nan, 0.0, 0.0)))
    with pytest.raises(NotFiniteError, match="not finite"):
        MotionTrack.of_poses((0, 1), (SE3.identity(), broken))
    with pytest.raises(NotFiniteError, match="not finite"):
        MotionTrack.of_rates((0, 1), (0.0, math.inf), ((0.0, 0.0, 0.0),) * 2)
    with pytest.raises(InputError, match="must grow"):
        MotionTrack.of_poses((1, 1), (SE3.identity(),) * 2)
    with pytest.raises(InputError, match="at least two"):
        MotionTrack.of_rates((1,), (0.0,), ((0.0, 0.0, 0.0),))

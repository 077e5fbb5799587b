"""A cloud of a 3D LiDAR survives its message, which is small."""

from __future__ import annotations

import base64

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.errors import InputError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.messages import LidarCloud
from navcore.messages.cloud import packed, unpacked
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, tuning_block
from navcore.transport.codec import decode, encode

TURN_NS = 100_000_000


def _cloud(points: np.ndarray) -> PointCloud:
    n = len(points)
    return PointCloud(
        points=points,
        times=-np.linspace(0.1, 0.0, n),
        intensities=np.arange(n, dtype=np.uint8),
        rings=(np.arange(n) % 16).astype(np.uint8),
    )


def _alike(back: PointCloud, cloud: PointCloud) -> None:
    away = np.linalg.norm(cloud.points, axis=1)
    np.testing.assert_allclose(np.linalg.norm(back.points, axis=1), away, atol=0.00126)  # m, half a step
    np.testing.assert_allclose(back.points, cloud.points, atol=0.0014)  # m, with half an angle's step at 140 m
    np.testing.assert_allclose(back.times, cloud.times, atol=6e-6)  # s
    assert (back.rings == cloud.rings).all()
    assert (back.intensities == cloud.intensities).all()


@given(seed=st.integers(0, 1 << 30), count=st.integers(1, 300))
def test_any_cloud_comes_back_from_the_wire_in_its_order_to_a_millimetre(seed: int, count: int) -> None:
    cloud = _cloud(np.random.default_rng(seed).uniform(-80.0, 80.0, (count, 3)))
    _alike(unpacked(decode(LidarCloud, encode(packed(5, cloud)))), cloud)


def test_what_came_back_once_comes_back_the_same_for_ever() -> None:
    once = unpacked(packed(5, _cloud(np.random.default_rng(1).uniform(-80.0, 80.0, (200, 3)))))
    twice = unpacked(packed(5, once))
    np.testing.assert_allclose(twice.points, once.points, atol=1e-9)  # m
    np.testing.assert_allclose(twice.times, once.times, atol=1e-12)  # s


def test_a_turn_in_an_orchard_takes_no_more_than_three_bytes_a_point() -> None:
    block = tuning_block(0, BlockSize(alleys=1, length=12.0))
    x, y = block.site.rows[0].start
    T_map_base = SE3.from_rpy((x, y, block.ground().height(x, y)))
    lidar = Lidar3d(block.trellised(Season.MATURING).scene, LidarMount(x=0.0, y=0.0, z=0.6), C16, 0)
    cloud = lidar.turn(TURN_NS, (0, TURN_NS), (T_map_base, T_map_base)).cloud
    assert len(cloud) > 10_000
    message = packed(TURN_NS, cloud)
    _alike(unpacked(message), cloud)
    assert len(encode(message)) < 3 * len(cloud)  # bytes as JSON; ten bytes a point and base64 were 13


def test_points_too_far_for_the_message_are_left_out_and_not_wrapped() -> None:
    cloud = _cloud(np.array(((1.0, 0.0, 0.0), (170.0, 0.0, 0.0))))
    np.testing.assert_allclose(unpacked(packed(5, cloud)).points, [[1.0, 0.0, 0.0]], atol=1e-9)


def test_a_point_in_the_sensor_itself_stays_there() -> None:
    np.testing.assert_allclose(unpacked(packed(5, _cloud(np.zeros((3, 3))))).points, np.zeros((3, 3)), atol=1e-9)


def test_an_empty_turn_is_a_message_too() -> None:
    assert len(unpacked(packed(5, _cloud(np.empty((0, 3)))))) == 0


def _older(points: list[list[int]]) -> bytes:
    """As logs were written before: steps of 2.5 mm in int16, 10 us in uint16."""
    n = len(points)
    parts = {
        "points": np.array(points, dtype="<i2").tobytes(), "ages": np.arange(n, dtype="<u2").tobytes(),
        "intensities": bytes(range(n)), "rings": bytes(n),
    }  # fmt: skip
    return msgspec.json.encode({"stamp_ns": 5, **{k: base64.b64encode(v).decode() for k, v in parts.items()}})


def test_clouds_of_older_logs_are_still_read() -> None:
    back = unpacked(decode(LidarCloud, _older([[400, -800, 4], [4, 8, -12]])))
    np.testing.assert_allclose(back.points, [[1.0, -2.0, 0.01], [0.01, 0.02, -0.03]], atol=1e-12)  # m
    np.testing.assert_allclose(back.times, [0.0, -1e-5], atol=1e-12)  # s
    assert back.intensities.tolist() == [0, 1]


@pytest.mark.parametrize("kept", [0.5, 0.9])
def test_a_damaged_cloud_is_refused_with_a_sentence(kept: float) -> None:
    whole = packed(5, _cloud(np.random.default_rng(1).uniform(-80.0, 80.0, (200, 3))))
    with pytest.raises(InputError, match="copy the log again"):
        unpacked(LidarCloud(stamp_ns=5, turn=whole.turn[: int(kept * len(whole.turn))]))
    with pytest.raises(InputError, match="copy the log again"):
        unpacked(LidarCloud(stamp_ns=5, points=b"123", rings=b"1"))
    with pytest.raises(InputError, match="copy the log again"):
        unpacked(LidarCloud(stamp_ns=5, turn=b"no zlib at all"))

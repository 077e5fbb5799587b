"""A cloud of a 3D LiDAR survives its message."""

from __future__ import annotations

import msgspec
import numpy as np

from navcore.geometry.point_cloud import PointCloud
from navcore.messages import LidarCloud
from navcore.messages.cloud import packed, unpacked


def _cloud(points: np.ndarray) -> PointCloud:
    n = len(points)
    return PointCloud(
        points=points,
        times=-np.linspace(0.1, 0.0, n),
        intensities=np.arange(n, dtype=np.uint8),
        rings=(np.arange(n) % 16).astype(np.uint8),
    )


def test_a_cloud_comes_back_from_the_wire_to_a_millimetre() -> None:
    cloud = _cloud(np.random.default_rng(1).uniform(-80.0, 80.0, (200, 3)))
    wire = msgspec.msgpack.encode(packed(5, cloud))
    back = unpacked(msgspec.msgpack.decode(wire, type=LidarCloud))
    np.testing.assert_allclose(back.points, cloud.points, atol=0.00126)  # m, half a step
    np.testing.assert_allclose(back.times, cloud.times, atol=6e-6)  # s
    assert (back.rings == cloud.rings).all()
    assert (back.intensities == cloud.intensities).all()


def test_points_too_far_for_the_message_are_left_out_and_not_wrapped() -> None:
    cloud = _cloud(np.array(((1.0, 0.0, 0.0), (90.0, 0.0, 0.0))))
    assert unpacked(packed(5, cloud)).points.tolist() == [[1.0, 0.0, 0.0]]


def test_an_empty_turn_is_a_message_too() -> None:
    assert len(unpacked(packed(5, _cloud(np.empty((0, 3)))))) == 0

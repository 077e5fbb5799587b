"""A C16's bytes, both models and both return modes, to what stands around it."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from itertools import pairwise

import numpy as np
import pytest

from navcore.drivers.lidar3d.device_packets import device_info
from navcore.drivers.lidar3d.models import C16, C16_FINE, MODELS, VLP16, LidarModel, ModelName
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from navcore.geometry.point_cloud import PointCloud
from navcore.sim.lidar3d_device import BEGAN, Lidar3dDevice, Lidar3dDeviceParams
from tests.navcore.drivers.lidar3d_scenes import arrivals, datagrams, fed, off_walls, room_cloud
from tests.navcore.drivers.plain_lidar3d import plain_c16

LEISHEN = (ModelName.C16, ModelName.C16_FINE)


def data_only(name: ModelName, *, dual: bool = False, long: bool = False) -> tuple[bytes, ...]:
    """Without device packets, which tell angles in hundredths of a degree."""
    return tuple(d for d in datagrams(name, dual=dual, long=long) if d.startswith(b"\xff\xee"))


def decoded(name: ModelName, *, dual: bool = False, long: bool = False) -> tuple[LidarStream, list[Turn]]:
    stream = LidarStream(MODELS[name])
    return stream, fed(stream, arrivals(MODELS[name], data_only(name, dual=dual, long=long), dual=dual))


@pytest.mark.parametrize("long", [False, True])
@pytest.mark.parametrize("dual", [False, True])
@pytest.mark.parametrize("name", LEISHEN)
def test_the_room_is_shown_as_it_is(name: ModelName, dual: bool, long: bool) -> None:
    stream, turns = decoded(name, dual=dual, long=long)
    assert len(turns) == 2
    for turn in turns:
        assert len(turn.cloud) == pytest.approx(32_000, abs=16)
        assert off_walls(turn.cloud).max() < 0.002  # m: half a step of distance is 1.25 mm
        assert turn.period_s == pytest.approx(0.1, abs=1e-4)
        assert np.all(np.diff(turn.cloud.times) >= 0.0)
    assert not stream.refused


@pytest.mark.parametrize("dual", [False, True])
@pytest.mark.parametrize("name", LEISHEN)
def test_every_point_is_where_the_plain_decoder_finds_it(name: ModelName, dual: bool) -> None:
    rays = sorted(
        (ray for data in data_only(name, dual=dual) for ray in plain_c16(data, name, 0.04319)), key=lambda ray: ray.us
    )
    begins = [i + 1 for i, (a, b) in enumerate(pairwise(rays)) if b.turned % 360.0 < a.turned % 360.0 - 180.0]
    for turn, (begin, end) in zip(decoded(name, dual=dual)[1], pairwise(begins), strict=True):
        echoes = [ray for ray in rays[begin:end] if ray.xyz is not None]
        assert np.abs(turn.cloud.points - np.array([ray.xyz for ray in echoes])).max() < 1e-6  # m
        times = np.array([ray.us for ray in echoes]) - rays[end - 1].us
        assert np.abs(turn.cloud.times - times * 1e-6).max() < 2e-6  # s: packets tell whole microseconds


def test_a_beam_that_meets_leaves_and_a_wall_tells_both_and_one_that_meets_one_thing_tells_it_once() -> None:
    wall = room_cloud(ModelName.C16)
    leaves = wall.where(np.arange(len(wall)) % 4 == 0)
    leaves = replace(leaves, points=leaves.points * 0.5)
    both = PointCloud(
        points=np.vstack((wall.points, leaves.points)),
        times=np.concatenate((wall.times, leaves.times)),
        intensities=np.concatenate((wall.intensities, np.full(len(leaves), 7, dtype=np.uint8))),
        rings=np.concatenate((wall.rings, leaves.rings)),
    )
    device = Lidar3dDevice(lambda _: both, Lidar3dDeviceParams(dual=True))
    turn = fed(LidarStream(C16), arrivals(C16, tuple(device.run(0.25)), dual=True))[0]
    near = off_walls(turn.cloud) > 0.1
    # The lever bends half a point's way to another azimuth, so a few leaves lie before another wall's beam.
    assert np.count_nonzero(~near) == pytest.approx(len(wall), rel=0.01)
    assert np.count_nonzero(near) == pytest.approx(len(leaves), rel=0.02)
    assert set(turn.cloud.intensities[near]) == {7}


def test_unit_and_lever_are_settings() -> None:
    """A C32's unit of 4 mm makes the room 1.6 times as large around the head."""
    data = datagrams(ModelName.C16)
    plain = replace(C16, lever=0.0)
    small = fed(LidarStream(plain), arrivals(C16, data))[0].cloud
    large = fed(LidarStream(replace(plain, unit=0.004)), arrivals(C16, data))[0].cloud
    assert large.points == pytest.approx(small.points * 1.6)
    with_lever = fed(LidarStream(C16), arrivals(C16, data))[0].cloud
    apart = np.linalg.norm(with_lever.points - small.points, axis=1)
    assert apart == pytest.approx(np.full(len(small), 0.04319))  # m


def test_time_goes_on_over_the_second_at_which_its_counter_starts_anew() -> None:
    stream = LidarStream(C16)
    device = Lidar3dDevice(lambda _: room_cloud(ModelName.C16).where(np.arange(0, 32_000, 99)))
    device.us = 700_000.0
    turns = fed(stream, arrivals(C16, tuple(device.run(0.8))))
    steps = np.diff([turn.stamp_ns for turn in turns])
    assert len(turns) >= 6
    assert steps == pytest.approx(np.full(len(steps), 100e6), abs=1.2e6)  # ns
    assert not stream.refused


def test_long_packets_tell_date_and_time() -> None:
    stream, _ = decoded(ModelName.C16, long=True)
    assert stream.utc == BEGAN == datetime(2026, 5, 1, 10, 0, tzinfo=UTC)


def test_the_device_packet_tells_speed_clock_and_angles() -> None:
    device = device_info(datagrams(ModelName.C16_FINE)[0])
    assert device is not None
    assert (device.rpm, device.utc) == (600, BEGAN)
    assert device.vertical_deg == pytest.approx(C16_FINE.vertical_deg, abs=0.0051)  # deg: told in hundredths
    assert device.model is C16_FINE


def test_of_an_old_device_packet_angles_and_clock_stand_elsewhere() -> None:
    new = datagrams(ModelName.C16)[0]
    old = bytearray(1206)
    old[:10], old[52:58], old[245:277] = new[:10], new[36:42], new[234:266]
    assert device_info(bytes(old)) == device_info(new)


def calibrated_device(model: LidarModel) -> bytes:
    return Lidar3dDevice(lambda _: room_cloud(ModelName.C16), Lidar3dDeviceParams(model=model)).run(0.01)[0]


def test_measured_angles_take_the_nominal_ones_place() -> None:
    measured = replace(C16, vertical_deg=tuple(angle + 0.3 for angle in C16.vertical_deg))
    data = (calibrated_device(measured), *data_only(ModelName.C16))
    stream = LidarStream(C16)
    points = fed(stream, arrivals(C16, data))[0].cloud.points
    nominal = decoded(ModelName.C16)[1][0].cloud.points
    assert np.median(points[:, 2] - nominal[:, 2]) > 0.005  # m
    assert stream.model is not None
    assert stream.model.vertical_deg == pytest.approx(measured.vertical_deg, abs=1e-9)


def test_angles_that_are_of_no_model_are_not_believed() -> None:
    """As of a device whose memory was never written."""
    empty = bytearray(calibrated_device(C16))
    empty[234:266] = bytes(32)
    stream = LidarStream(C16)
    stream.feed(bytes(empty), 0)
    assert stream.model == C16
    assert stream.device is not None
    assert stream.device.model is None


def test_the_model_is_learnt_from_the_device_packet() -> None:
    stream = LidarStream(None)
    turns = fed(stream, arrivals(C16_FINE, datagrams(ModelName.C16_FINE)))
    assert stream.model is not None
    assert stream.model.name is ModelName.C16_FINE
    assert off_walls(turns[0].cloud).max() < 0.002  # m


def test_the_other_c16_is_refused_in_words_until_it_is_the_right_one() -> None:
    stream = LidarStream(C16)
    assert not fed(stream, arrivals(C16_FINE, datagrams(ModelName.C16_FINE)))
    assert stream.contradiction == (
        "The LiDAR's own angles are those of a Leishen C16 (1.33 deg), but it is set to be a Leishen C16 (2 deg). "
        "Correct its model."
    )
    assert len(fed(stream, arrivals(C16, datagrams(ModelName.C16)))) == 2
    assert stream.contradiction == ""


def test_a_vlp16_in_dual_mode_shows_the_room_too() -> None:
    turns = fed(LidarStream(VLP16), arrivals(VLP16, datagrams(ModelName.VLP16, dual=True), dual=True))
    assert len(turns) >= 2
    assert off_walls(turns[0].cloud).max() < 0.012  # m: beams of later turns lie up to 0.1 deg beside the first one's
    assert len(turns[0].cloud) == pytest.approx(28_930, abs=20)

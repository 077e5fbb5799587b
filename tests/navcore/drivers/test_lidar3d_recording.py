"""A recorded VLP-16: points and times as an independent decoder finds them, and GPS packets for what they are."""

from __future__ import annotations

from functools import reduce
from itertools import pairwise
from operator import xor
from pathlib import Path

import numpy as np
import pytest

from navcore.drivers.lidar3d.capture_file import CaptureFile, Datagram
from navcore.drivers.lidar3d.models import C16, ModelName
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from tests.navcore.drivers.lidar3d_scenes import fed
from tests.navcore.drivers.plain_lidar3d import VLP16_LASERS, PlainRay, plain_vlp16


@pytest.fixture(scope="module")
def recording(shared_data: Path) -> list[Datagram]:
    path = shared_data / "lidar3d" / "sample_velodyne_vlp16_gps.pcap"
    if not path.is_file():
        pytest.skip(f"no recording at {path}")
    return list(CaptureFile(path).datagrams())


@pytest.fixture(scope="module")
def decoded(recording: list[Datagram]) -> tuple[LidarStream, list[Turn]]:
    """The stream after the whole recording, and its turns."""
    stream = LidarStream(None)
    return stream, fed(stream, [(d.data, d.arrived_ns) for d in recording])


@pytest.fixture(scope="module")
def stream(decoded: tuple[LidarStream, list[Turn]]) -> LidarStream:
    return decoded[0]


@pytest.fixture(scope="module")
def turns(decoded: tuple[LidarStream, list[Turn]]) -> list[Turn]:
    return decoded[1]


@pytest.fixture(scope="module")
def plain(recording: list[Datagram]) -> list[list[PlainRay]]:
    """Whole turns of the independent decoder."""
    rays = [ray for d in recording if len(d.data) == 1206 for ray in plain_vlp16(d.data)]
    begins = [i + 1 for i, (a, b) in enumerate(pairwise(rays)) if b.turned % 360.0 < a.turned % 360.0 - 180.0]
    return [rays[begin:end] for begin, end in pairwise(begins)]


def test_every_point_is_where_the_independent_decoder_finds_it(
    turns: list[Turn], plain: list[list[PlainRay]]
) -> None:
    assert len(turns) == len(plain) == 3
    for turn, rays in zip(turns, plain, strict=True):
        echoes = [ray for ray in rays if ray.xyz is not None]
        assert len(turn.cloud) == len(echoes) > 18_000
        assert np.abs(turn.cloud.points - np.array([ray.xyz for ray in echoes])).max() < 1e-6  # m
        assert turn.cloud.intensities.tolist() == [ray.intensity for ray in echoes]


def test_every_point_has_the_independent_decoders_time(turns: list[Turn], plain: list[list[PlainRay]]) -> None:
    for turn, rays in zip(turns, plain, strict=True):
        times = np.array([ray.us for ray in rays if ray.xyz is not None]) - rays[-1].us
        assert np.abs(turn.cloud.times - times * 1e-6).max() < 1e-7  # s
        assert turn.period_s == pytest.approx((rays[-1].us - rays[0].us) * 1e-6, abs=1e-9)


def test_rings_count_from_the_lowest_beam(turns: list[Turn], plain: list[list[PlainRay]]) -> None:
    beams = [VLP16_LASERS[ray.laser][0] for ray in plain[0] if ray.xyz is not None]
    assert turns[0].cloud.rings.tolist() == [(beam + 15) // 2 for beam in beams]


def test_turns_follow_each_other_at_ten_a_second(turns: list[Turn]) -> None:
    steps = np.diff([turn.stamp_ns for turn in turns])
    assert steps == pytest.approx(100.1e6, abs=0.2e6)  # ns
    assert all(turn.cloud.times.max() <= 0.0 for turn in turns)


def test_a_turn_is_stamped_just_before_its_last_packet_came(recording: list[Datagram], turns: list[Turn]) -> None:
    arrived = np.array([d.arrived_ns for d in recording if len(d.data) == 1206])
    for turn in turns:
        after = arrived[arrived >= turn.stamp_ns].min() - turn.stamp_ns
        assert 0 <= after < 2_500_000  # ns: within two packets


def test_the_model_is_read_from_the_packets_and_nothing_is_refused(stream: LidarStream) -> None:
    assert stream.model is not None
    assert stream.model.name is ModelName.VLP16
    assert (stream.packets, stream.lost, dict(stream.refused), stream.contradiction) == (293, 0, {}, "")


def test_position_packets_are_read_as_such(stream: LidarStream, recording: list[Datagram]) -> None:
    assert stream.position is not None
    assert stream.position.pps == "locked to the pulse per second"
    sentence, _, checksum = stream.position.sentence.removeprefix("$").partition("*")
    assert sentence.startswith("GPRMC,081802.00,A,3649.7478558,N,00224.4542928,W")
    assert reduce(xor, sentence.encode()) == int(checksum, 16)
    newest = max(int.from_bytes(d.data[1200:1204], "little") for d in recording if len(d.data) == 1206)
    assert abs(stream.position.counter_us - newest) < 20_000  # us


def test_a_recorded_vlp16_is_no_c16(recording: list[Datagram]) -> None:
    stream = LidarStream(C16)
    assert not [d for d in recording if stream.feed(d.data, d.arrived_ns)]
    assert stream.contradiction == (
        "The packets come from a Velodyne VLP-16, but the LiDAR is set to be a Leishen C16 (2 deg). "
        "Correct its model."
    )

"""An RPLIDAR's bytes to turns of its head, in every format, and what is made of bytes that are none."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.drivers.rplidar.protocol import Answer, Command, express_scan, motor_speed, request
from navcore.drivers.rplidar.revolutions import Revolution, Revolutions
from navcore.drivers.rplidar.single_packets import standard_rays
from navcore.drivers.rplidar.stream import Refused, RplidarStream
from navcore.sim.rplidar_device import RplidarDevice
from tests.navcore.drivers.rplidar_scenes import POLE_DEG, room, room_with_pole

STREAMS = (Answer.STANDARD, Answer.EXPRESS, Answer.DENSE, Answer.ULTRA, Answer.ULTRA_DENSE, Answer.HQ)
# Worst of the formats' steps within 12 m, and what half a step of angle (0.23 deg) makes of a slanting wall, m.
RESOLUTION = 0.03


def turns(device: RplidarDevice, stream: RplidarStream, seconds: float, portion: int = 977) -> list[Revolution]:
    """Whole turns out of so many seconds, fed in portions as a serial port hands them over, 1 ms apart."""
    gathered, found = Revolutions(), []
    for ms in range(round(seconds * 1000)):
        data = device.run(0.001)
        for at in range(0, len(data), portion):
            for rays in stream.feed(data[at : at + portion]):
                found += gathered.add(rays, ms * 1_000_000)
    return found


def scanning(kind: Answer) -> tuple[RplidarDevice, RplidarStream]:
    device, stream = RplidarDevice(room, kind), RplidarStream()
    stream.feed(device.receive(request(Command.SCAN)))
    return device, stream


@pytest.mark.parametrize("kind", STREAMS)
def test_every_format_shows_the_room_as_it_is(kind: Answer) -> None:
    device, stream = scanning(kind)
    found = turns(device, stream, 0.6)
    assert stream.kind is kind
    assert len(found) >= 3
    for turn in found:
        met = turn.rays.distance > 0.0
        truth = room(-np.degrees(turn.rays.angle))
        assert np.array_equal(met, truth > 0.0) or np.mean(met == (truth > 0.0)) > 0.98
        both = met & (truth > 0.0)
        assert np.percentile(np.abs(turn.rays.distance - truth)[both], 95) < RESOLUTION  # m
    assert not stream.refused


@pytest.mark.parametrize("kind", STREAMS)
def test_a_turn_holds_all_rays_once_and_each_ray_its_time(kind: Answer) -> None:
    turn = turns(*scanning(kind), 0.6)[-1]
    assert len(turn.rays.angle) == pytest.approx(800, abs=1)
    assert np.all(np.diff(turn.stamps_ns) >= 0)
    assert turn.stamps_ns[-1] - turn.stamps_ns[0] == pytest.approx(100e6, abs=15e6)  # ns: 10 turns a second


def test_a_pole_to_the_left_is_to_the_left() -> None:
    """The sensor counts clockwise, and we to the left (REP 103)."""
    device, stream = scanning(Answer.STANDARD)
    device.scene = room_with_pole
    rays = turns(device, stream, 0.4)[-1].rays
    pole = rays.angle[np.abs(rays.distance - 1.2) < 0.01]
    assert math.remainder(float(pole.mean()) - math.radians(POLE_DEG), math.tau) == pytest.approx(
        0.0, abs=0.03
    )  # rad


def test_near_things_beside_far_ones_begin_no_new_turn() -> None:
    """Rays of the ultra format lie up to 8 deg behind their places, those of near things further."""
    device, stream = scanning(Answer.ULTRA)
    device.scene = lambda deg: np.where(np.mod(deg, 2.0) < 1.0, 0.3, 8.0)
    rays = [len(turn.rays.angle) for turn in turns(device, stream, 0.6)]
    assert 4 <= len(rays) <= 5
    assert rays == pytest.approx([800] * len(rays), abs=40)


def test_one_known_packet_of_each_single_kind() -> None:
    ray = standard_rays(bytes((0x3E, 0x01 | 0x2D00 << 1 & 0xFF, 0x2D00 << 1 >> 8, 0xA0, 0x0F)))
    assert (-math.degrees(ray.angle[0]), ray.distance[0], ray.quality[0]) == pytest.approx((180.0, 1.0, 15))
    stream = RplidarStream()
    stream.feed(bytes.fromhex("a55a1400000004") + bytes((0x18, 29, 1, 7)) + bytes(range(16)))
    assert stream.info is not None
    assert (stream.info.model, stream.info.firmware, stream.info.hardware) == (0x18, (1, 29), 7)
    stream.feed(bytes.fromhex("a55a0300000006" + "010280"))
    assert stream.health is not None
    assert stream.health.words == "LiDAR health: warning, code 32770"


def test_requests_are_those_of_the_manual() -> None:
    assert request(Command.STOP) == bytes.fromhex("a525")
    assert request(Command.GET_HEALTH) == bytes.fromhex("a552")
    assert express_scan() == bytes.fromhex("a58205000000000022")
    assert motor_speed(600) == bytes.fromhex("a5a802580255")


@pytest.mark.parametrize("kind", STREAMS)
def test_a_byte_that_was_lost_or_turned_costs_its_packets_and_is_told(kind: Answer) -> None:
    device, stream = scanning(kind)
    data = device.run(0.5)
    rng = np.random.default_rng(3)
    broken = bytearray(data)
    for at in sorted(rng.integers(1000, len(data) - 1000, 6).tolist(), reverse=True):
        if at % 2:
            del broken[at]
        else:
            broken[at] ^= 0x55
    rays = stream.feed(bytes(broken))
    distance, angle = np.concatenate([r.distance for r in rays]), np.concatenate([r.angle for r in rays])
    truth = room(-np.degrees(angle))
    wrong = (distance > 0.0) & (np.abs(distance - truth) > 0.2)
    assert np.mean(wrong) < 0.01  # the standard answer has two check bits and no checksum
    assert len(distance) > 0.6 * 0.5 * 8000
    assert stream.refused[Refused.BAD_PACKET] > 0


def test_noise_is_counted_and_the_stream_found_behind_it() -> None:
    """As of a port that is open at another speed."""
    noise = np.random.default_rng(5).integers(0, 256, 5000, dtype=np.uint8).tobytes()
    device, stream = RplidarDevice(room, Answer.EXPRESS), RplidarStream()
    assert not stream.feed(noise)
    assert stream.refused[Refused.NO_ANSWER] > 4900
    stream.feed(device.receive(request(Command.SCAN)))
    assert len(turns(device, stream, 0.4)) >= 1


def test_a_sensor_that_is_stopped_and_asked_answers_in_between() -> None:
    device, stream = scanning(Answer.DENSE)
    assert len(turns(device, stream, 0.3)) >= 1
    stream.feed(device.run(0.02)[:-30])
    device.receive(request(Command.STOP))
    stream.feed(device.receive(request(Command.GET_HEALTH)))
    assert stream.health is not None
    assert stream.kind is None
    device.faulty = True
    assert device.receive(request(Command.SCAN)) == b""
    stream.feed(device.receive(request(Command.GET_HEALTH)))
    assert stream.health.words == "LiDAR health: error: stop the robot and restart the LiDAR, code 32769"


def test_no_bytes_at_all_make_the_parser_fail() -> None:
    rng = np.random.default_rng(11)
    for kind in STREAMS:
        device, stream = scanning(kind)
        data = bytearray(device.run(0.1))
        for _ in range(40):
            data[int(rng.integers(len(data)))] = int(rng.integers(256))
        for at in range(0, len(data), 7):
            stream.feed(bytes(data[at : at + 7]))

"""Pictures and scans are paired by time, ten times a second, or it is said why not."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from navcore.errors import ConfigError
from navcore.perception.scan.ring_buffer import RingBuffer, SensorPair, SensorPairing, SensorPairingParams

MS = 1_000_000


@dataclass(frozen=True)
class Taken:
    stamp_ns: int


def pairing(frames_ms: list[int], scans_ms: list[int]) -> SensorPairing[Taken, Taken]:
    made: SensorPairing[Taken, Taken] = SensorPairing(SensorPairingParams())
    for ms in frames_ms:
        made.frames.push(Taken(ms * MS))
    for ms in scans_ms:
        made.scans.push(Taken(ms * MS))
    return made


def test_the_newest_picture_gets_the_scan_nearest_in_time() -> None:
    pair = pairing([0, 33, 66], [10, 80, 200]).trigger(210 * MS)
    assert pair == SensorPair(Taken(66 * MS), Taken(80 * MS))
    assert isinstance(pair, SensorPair)
    assert pair.apart_s == pytest.approx(0.014)


def test_sensors_that_are_out_of_step_are_refused_with_words() -> None:
    assert pairing([2000], [1100]).trigger(2000 * MS) == "camera and LiDAR are out of step by 0.9 s"


def test_a_missing_sensor_is_named() -> None:
    assert "camera" in str(pairing([], [0]).trigger(0))
    assert "LiDAR" in str(pairing([0], []).trigger(0))


def test_what_is_older_than_the_window_is_dropped() -> None:
    made = pairing([0], [0, 100, 4900, 5050])
    assert len(made.scans) == 3
    assert "no picture for 5 s" in str(made.trigger(5101 * MS))
    assert len(made.scans) == 2


def test_it_triggers_ten_times_a_second_and_pairs_no_picture_twice() -> None:
    made, pairs = pairing([], []), 0
    for ms in range(0, 1000, 5):
        if ms % 33 == 0 or ms % 100 == 0:
            made.frames.push(Taken(ms * MS))
            made.scans.push(Taken(ms * MS))
        pairs += isinstance(made.trigger(ms * MS), SensorPair)
    assert pairs == 10
    made.trigger(2000 * MS)
    assert made.trigger(2500 * MS) is None


def test_late_arrivals_are_put_in_their_place() -> None:
    buffer: RingBuffer[Taken] = RingBuffer(5.0)
    for ms in (100, 300, 200, 300):
        buffer.push(Taken(ms * MS))
    assert len(buffer) == 3
    assert buffer.newest() == Taken(300 * MS)
    assert buffer.nearest(210 * MS) == Taken(200 * MS)


def test_a_limit_that_is_none_is_refused() -> None:
    with pytest.raises(ConfigError, match="above 0 s"):
        SensorPairingParams(most_apart_s=0.0)

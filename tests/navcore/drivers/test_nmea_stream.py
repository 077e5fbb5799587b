"""Bytes of a receiver become fixes."""

from __future__ import annotations

import math
import sys
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from types import FrameType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.drivers.epoch import BaselineMount
from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams
from navcore.drivers.sentence import Refused
from navcore.messages import FixQuality, GnssFix
from tests.navcore.drivers.nmea_text import gga, hdt, rmc, sentence

MS = 1_000_000
PERIOD = 200 * MS
MOST_CALLS_PER_BYTE = 100  # calls and returns; the worst of the inputs below, line ends one by one, needs 38


def clock_text(i: int) -> str:
    """Time of day of the i-th epoch at 5 Hz."""
    return f"1036{i // 5:02d}.{i % 5 * 20:02d}"


def read_all(data: bytes, params: NmeaStreamParams | None = None) -> tuple[NmeaStream, list[GnssFix]]:
    stream = NmeaStream(params or NmeaStreamParams(close_early=False))
    return stream, stream.feed(data, 10**9) + stream.flush(10**9)


def calls_in(work: Callable[[], object]) -> int:
    """Calls and returns of functions, Python's and C's: a measure of work that no other process disturbs."""
    counted: Counter[str] = Counter()

    def count(frame: FrameType, event: str, argument: Any) -> None:
        counted[event] += 1

    sys.setprofile(count)
    try:
        work()
    finally:
        sys.setprofile(None)
    return counted.total()


def test_epoch_is_put_together_from_its_sentences() -> None:
    _, [fix] = read_all(gga("103607.00") + rmc("103607.00") + hdt(90.0))
    assert fix.utc_s == 1615026967.0
    assert fix.quality is FixQuality.RTK_FIXED
    assert fix.lat_deg == pytest.approx(53 + 27.03942 / 60, abs=1e-12)
    assert fix.lon_deg == pytest.approx(-(2 + 14.42462 / 60), abs=1e-12)
    assert fix.height_m == pytest.approx(104.5)
    assert fix.heading_rad == pytest.approx(0.0)
    assert fix.speed == pytest.approx(1852 / 3600)
    assert fix.course_rad == pytest.approx(0.0)


@pytest.mark.parametrize(("bearing", "yaw_deg"), [(0.0, 90.0), (90.0, 0.0), (180.0, -90.0), (270.0, 180.0)])
def test_heading_turns_from_clockwise_from_north_to_counter_clockwise_from_east(
    bearing: float, yaw_deg: float
) -> None:
    _, [fix] = read_all(gga("103607.00") + hdt(bearing))
    assert fix.heading_rad is not None
    assert math.remainder(fix.heading_rad - math.radians(yaw_deg), 2 * math.pi) == pytest.approx(0.0, abs=1e-12)


def test_baseline_across_the_robot_is_taken_off_the_heading() -> None:
    """Slave antenna on the left, master on the right: the baseline points north while the robot looks east."""
    across = NmeaStreamParams(mount=BaselineMount(yaw_rad=math.pi / 2), close_early=False)
    _, [fix] = read_all(gga("103607.00") + hdt(0.0), across)
    assert fix.heading_rad == pytest.approx(0.0, abs=1e-12)


def test_heading_that_comes_before_the_position_belongs_to_its_own_epoch() -> None:
    data = b"".join(hdt(10.0 * i) + gga(clock_text(i)) for i in range(1, 9))
    _, fixes = read_all(data)
    bearings = [round(90.0 - math.degrees(f.heading_rad or 0.0)) for f in fixes]
    assert bearings == [10 * i for i in range(1, 9)]


def test_fix_is_handed_out_without_waiting_for_the_next_epoch() -> None:
    stream = NmeaStream()
    counts = [len(stream.feed(gga(clock_text(i)) + rmc(clock_text(i)), 10**9 + i * PERIOD)) for i in range(12)]
    assert counts[4:] == [1] * 8


def test_silence_completes_an_epoch() -> None:
    stream = NmeaStream()
    assert stream.feed(gga("103607.00"), 0) == []
    assert stream.feed(b"", 20 * MS) == []
    assert len(stream.feed(b"", 40 * MS)) == 1


def test_sentence_that_comes_only_at_full_seconds_is_not_lost_for_good() -> None:
    """Heading after VTG once a second: only the first one may be lost to an epoch that was closed at VTG."""
    stream = NmeaStream()
    fixes: list[GnssFix] = []
    for i in range(60):
        data = gga(clock_text(i)) + sentence("GNVTG,90.0,T,,M,1.0,N,1.9,K,D")
        data += hdt(45.0) if i % 5 == 4 else b""
        fixes += stream.feed(data, 10**9 + i * PERIOD)
    fixes += stream.flush(10**11)
    assert len(fixes) == 60
    assert [i for i, fix in enumerate(fixes) if fix.heading_rad is not None] == list(range(9, 60, 5))


def test_any_portioning_of_the_bytes_gives_the_same_fixes() -> None:
    data = b"".join(gga(clock_text(i)) + rmc(clock_text(i)) + hdt(i) for i in range(10))
    _, expected = read_all(data)
    for size in (1, 2, 7, 100):
        stream = NmeaStream(NmeaStreamParams(close_early=False))
        fixes = [f for k in range(0, len(data), size) for f in stream.feed(data[k : k + size], 10**9)]
        assert fixes + stream.flush(10**9) == expected


def test_midnight_and_a_date_that_comes_once() -> None:
    data = rmc("235959.80", "311224") + gga("235959.80") + gga("000000.00") + gga("000000.20")
    _, fixes = read_all(data)
    assert [f.utc_s for f in fixes] == pytest.approx([1735689599.8, 1735689600.0, 1735689600.2], abs=1e-6)


def test_receiver_without_a_date_still_gets_stamps_free_of_jitter() -> None:
    stream = NmeaStream(NmeaStreamParams(close_early=False))
    fixes = []
    for i in range(30):
        late = 120 * MS if i == 20 else 0
        fixes += stream.feed(gga(clock_text(i)), 10**9 + i * PERIOD + late)
    steps = {b.stamp_ns - a.stamp_ns for a, b in pairwise(fixes)}
    assert all(fix.utc_s is None for fix in fixes)
    assert all(abs(step - PERIOD) < 1 * MS for step in steps)


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (gga("103607.00").replace(b",4,12,", b",5,12,"), Refused.CHECKSUM),
        (gga("103607.00")[:-7] + b"\r\n", Refused.TRUNCATED),
        (gga("103607.00")[:-3] + b"\r\n", Refused.MALFORMED),
        (gga("103607.00", "0000.00000", "00000.00000"), Refused.ZERO_POSITION),
        (gga("103607.00", "5360.00000"), Refused.MALFORMED),
        (gga("103607.00", "9127.00000"), Refused.MALFORMED),
        (gga("103607.00", "nan"), Refused.MALFORMED),
        (gga("103607.00", "5327.0x942"), Refused.MALFORMED),
        (gga("103607.00", quality=8), Refused.NOT_MEASURED),
        (gga("103607.00", quality=9), Refused.MALFORMED),
        (gga("253607.00"), Refused.TIME),
        (rmc("103607.00", "310221"), Refused.TIME),
        (rmc("103607.00", "060305"), Refused.TIME),
        (sentence("GNGST,103607.00,inf,60,38,89,NaN,24,31"), Refused.MALFORMED),
        (sentence("GNHDT,1e2,T"), Refused.MALFORMED),
        (sentence("GNHDT,400.0,T"), Refused.MALFORMED),
        (gga("103607.00").replace(b"$GNGGA", b"$INGGA").replace(b"*", b"*"), Refused.CHECKSUM),
        (sentence("INGGA,103607.00,5327.03942,N,00214.42462,W,1,06,5.88,56.0,M,48.5,M,,"), Refused.TALKER),
        (sentence("GNGGA," + "1" * 5000), Refused.TOO_LONG),
        (bytes(range(128, 256)), Refused.NOT_TEXT),
    ],
)
def test_garbage_is_dropped_counted_and_never_a_position(data: bytes, reason: Refused) -> None:
    stream, fixes = read_all(data)
    assert stream.refused_counts == {reason: 1}
    assert all(fix.lat_deg is None for fix in fixes)


def test_frozen_receiver_gives_no_second_fix() -> None:
    stream = NmeaStream()
    fixes = [f for i in range(10) for f in stream.feed(gga("103607.00"), 10**9 + i * PERIOD)]
    assert len(fixes) == 1
    assert stream.refused_counts[Refused.DUPLICATE] >= 8


def test_old_epoch_after_a_newer_one_is_refused() -> None:
    stream = NmeaStream(NmeaStreamParams(close_early=False))
    fixes = stream.feed(gga("103607.00") + gga("103607.40") + gga("103607.20") + gga("103607.60"), 10**9)
    fixes += stream.flush(10**9)
    assert stream.refused_counts == {Refused.TIME: 1}
    assert len(fixes) == 3


def test_receiver_that_warns_of_its_navigation_gives_no_position() -> None:
    _, [fix] = read_all(gga("103607.00", quality=1) + rmc("103607.00", status="V"))
    assert fix.quality is FixQuality.NONE
    assert fix.lat_deg is None


def test_spliced_sentence_loses_only_itself() -> None:
    data = gga("103607.00")[:30] + gga("103607.20") + b"\xb5\x62\x01\x07" + gga("103607.40")
    stream, fixes = read_all(data)
    assert len(fixes) == 2
    assert stream.refused_counts == {Refused.TRUNCATED: 1, Refused.NOT_TEXT: 1}


@given(st.binary(max_size=3000))
def test_arbitrary_bytes_never_crash_and_never_make_a_position(data: bytes) -> None:
    stream, fixes = read_all(data)
    assert stream.sentences == 0
    assert fixes == []


VALID = [gga(clock_text(i), lat=f"53{20 + i}.{i}0000") + rmc(clock_text(i)) + hdt(i) for i in range(8)]
PLACES = {53 + (20 + i + i / 10) / 60 for i in range(8)} | {53 + 27.03942 / 60}


@given(st.data())
def test_cut_and_spliced_streams_never_yield_a_position_that_no_sentence_carried(data: st.DataObject) -> None:
    whole = b"".join(VALID)
    cuts = data.draw(st.lists(st.integers(0, len(whole)), min_size=2, max_size=12))
    dirt = data.draw(st.lists(st.binary(max_size=20), min_size=len(cuts), max_size=len(cuts)))
    pieces = [whole[min(a, b) : max(a, b)] + d for a, b, d in zip(cuts, cuts[1:], dirt, strict=False)]
    _, fixes = read_all(b"".join(pieces))
    for fix in fixes:
        assert fix.lat_deg is None or any(abs(fix.lat_deg - lat) < 1e-9 for lat in PLACES)


@given(st.integers(0, len(b"".join(VALID)) - 1), st.integers(1, 255))
def test_one_wrong_byte_costs_at_most_its_own_sentence(position: int, flip: int) -> None:
    whole = bytearray(b"".join(VALID))
    whole[position] ^= flip
    _, fixes = read_all(bytes(whole))
    assert len(fixes) >= 7
    for fix in fixes:
        assert fix.lat_deg is None or any(abs(fix.lat_deg - lat) < 1e-9 for lat in PLACES)


@pytest.mark.parametrize(
    "kilobyte",
    [
        b"$" * 1024,
        b"$GPGGA" * 171,
        b"#BESTPOSA," * 103,
        b"\xff$" * 512,
        b"\r\n" * 512,
        gga("103607.00") * 12,
        b"$GPGGA" + b"1" * 1018,
    ],
)
def test_work_grows_with_the_length_of_the_input_and_with_nothing_else(kilobyte: bytes) -> None:
    stream = NmeaStream(NmeaStreamParams(close_early=False))
    byte_by_byte = calls_in(lambda: [stream.feed(bytes([byte]), 0) for byte in kilobyte])
    at_once = [calls_in(lambda: stream.feed(kilobyte, 0)) for _ in range(63)]
    assert byte_by_byte <= MOST_CALLS_PER_BYTE * len(kilobyte)
    assert max(at_once) <= byte_by_byte
    assert at_once[-1] <= at_once[0]

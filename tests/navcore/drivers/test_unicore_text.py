"""Unicore and NovAtel text: its times, its kinds of solution, and what stands around it."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest

from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams
from navcore.drivers.sentence import Refused
from navcore.messages import FixQuality, GnssFix
from tests.navcore.drivers.nmea_text import gga, hash_log

FILE = NmeaStreamParams(live=False, close_early=False, earliest_year=1980)
SOLUTION = '-33.45123456,-70.66123456,523.0,31.5,WGS84,0.010,0.012,0.030,"999",1.0,0.0,30,28,28,20,0,01,3,f3'


def bestnav(reference: str, week: int, ms: int, kind: str = "NARROW_INT") -> bytes:
    """Unicore's header."""
    moving = "SOL_COMPUTED,DOPPLER_VELOCITY,0.0,0.0,1.0,90.0,0.01,0.01,0.05"
    return hash_log(f"BESTNAVA,97,{reference},FINE,{week},{ms},0,0,18,12;SOL_COMPUTED,{kind},{SOLUTION},{moving}")


def bestpos(week: int, seconds: float) -> bytes:
    """NovAtel's header."""
    return hash_log(f"BESTPOSA,COM1,0,55.0,FINE,{week},{seconds:.3f},0,cdba,32768;SOL_COMPUTED,L1_INT,{SOLUTION}")


def read(data: bytes) -> tuple[NmeaStream, list[GnssFix]]:
    stream = NmeaStream(FILE)
    return stream, stream.feed(data, 0) + stream.flush(0)


@pytest.mark.parametrize(
    ("data", "utc"),
    [
        (bestnav("GPS", 2300, 292_528_000), datetime(2024, 2, 7, 9, 15, 10, tzinfo=UTC)),
        (bestnav("BDS", 944, 292_528_000), datetime(2024, 2, 7, 9, 15, 24, tzinfo=UTC)),
        (bestnav("GPS", 2300, 17_000), datetime(2024, 2, 3, 23, 59, 59, tzinfo=UTC)),
        (bestpos(1481, 418557.0), datetime(2008, 5, 29, 20, 15, 43, tzinfo=UTC)),
        (bestpos(1930, 17.0), datetime(2017, 1, 1, 0, 0, 0, tzinfo=UTC)),
        (bestpos(1930, 18.0), datetime(2017, 1, 1, 0, 0, 0, tzinfo=UTC)),
        (bestpos(1930, 16.0), datetime(2016, 12, 31, 23, 59, 59, tzinfo=UTC)),
    ],
)  # fmt: skip
def test_weeks_of_gps_and_of_beidou_become_utc_with_the_leap_seconds_of_their_day(data: bytes, utc: datetime) -> None:
    """The leap second itself, 17 s into GPS week 1930, has no name in Unix time: it counts as the 0 h after it."""
    _, [fix] = read(data)
    assert fix.utc_s == utc.timestamp()


def test_southern_and_western_positions_keep_their_signs_and_heights_are_above_the_ellipsoid() -> None:
    _, [fix] = read(bestnav("GPS", 2300, 292_528_000))
    assert (fix.lat_deg, fix.lon_deg, fix.height_m) == (-33.45123456, -70.66123456, 554.5)
    assert (fix.std_north_m, fix.std_east_m, fix.speed, fix.quality) == (0.010, 0.012, 1.0, FixQuality.RTK_FIXED)


@pytest.mark.parametrize("before", [b"[COM1]", b"2026-01-01 10:00:00.123 ", b"\xef\xbb\xbf"])
def test_what_a_logger_writes_before_a_sentence_does_no_harm(before: bytes) -> None:
    for data in (bestnav("GPS", 2300, 292_528_000), gga("103607.00")):
        stream, fixes = read(before + data)
        assert len(fixes) == 1
        assert not stream.refused_counts


@pytest.mark.parametrize(
    ("kind", "quality"),
    [
        ("INS_RTKFIXED", FixQuality.DEAD_RECKONING), ("INS", FixQuality.DEAD_RECKONING),
        ("PROPAGATED", FixQuality.DEAD_RECKONING), ("PPP", FixQuality.DIFFERENTIAL),
        ("NARROW_FLOAT", FixQuality.RTK_FLOAT), ("NONE", FixQuality.NONE),
    ],
)  # fmt: skip
def test_kinds_of_solution(kind: str, quality: FixQuality) -> None:
    _, [fix] = read(bestnav("GPS", 2300, 292_528_000, kind))
    assert fix.quality is quality


def test_a_base_stations_own_position_is_not_measured_and_an_unknown_kind_is_refused() -> None:
    for kind, reason in (("FIXEDPOS", Refused.NOT_MEASURED), ("NEW_KIND", Refused.MALFORMED)):
        stream, fixes = read(bestnav("GPS", 2300, 292_528_000, kind))
        assert (stream.refused_counts, fixes) == ({reason: 1}, [])

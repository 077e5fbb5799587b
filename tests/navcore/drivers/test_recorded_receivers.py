"""Logs of real receivers against what gpsd made of them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import pytest
from pynmeagps import NMEAReader

from navcore.drivers.epoch import bearing_of_yaw
from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams
from navcore.drivers.sentence import Refused
from navcore.messages import FixQuality, GnssFix

FILE = NmeaStreamParams(live=False, close_early=False, earliest_year=1980)
TEXT_LOGS = {
    "furuno_gl_ga": 16, "hemi": 215, "isync": 12, "mt3339": 30, "nmea-rtk": 122, "quectelLC79D": 30,
    "skytraq-PX1172RH_DS": 9, "ublox-8": 72, "ublox-f9p-hpnmea": 9, "ublox-zed-f9p-nmea": 29,
}  # fmt: skip
BINARY_LOGS = (
    "bu303-moving", "bu303-nofix", "naujoks-ntrip", "navcom", "ntrip_sourcetable", "rtcm3", "trimble-smt-360",
    "ublox-neo-m8p", "ublox-zed-f9p-rtk",
)  # fmt: skip
WITHOUT_GEOID = ("quectelLC79D",)
"""GGA without a geoid separation: gpsd takes one from its own model, we report no ellipsoidal height."""
GPSD_STATUS = {2: FixQuality.DIFFERENTIAL, 3: FixQuality.RTK_FIXED, 4: FixQuality.RTK_FLOAT}


@dataclass(frozen=True)
class Expected:
    """What gpsd reported: objects by UTC second, and headings in the order they came."""

    by_time: dict[float, list[dict[str, float]]]
    headings_deg: list[float]


def read_log(path: Path) -> tuple[NmeaStream, list[GnssFix]]:
    stream = NmeaStream(FILE)
    return stream, stream.feed(path.read_bytes(), 0) + stream.flush(0)


def read_expected(path: Path) -> Expected:
    by_time: dict[float, list[dict[str, float]]] = {}
    headings: list[float] = []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if not line.startswith('{"class"'):
            continue
        found = json.loads(line)
        if found["class"] == "TPV" and "time" in found and "lat" in found:
            by_time.setdefault(datetime.fromisoformat(found["time"]).timestamp(), []).append(found)
        if found["class"] == "ATT" and "heading" in found:
            headings.append(found["heading"])
    return Expected(by_time, headings)


def pairs(folder: Path, name: str) -> list[tuple[GnssFix, list[dict[str, float]]]]:
    _, fixes = read_log(folder / f"{name}.log")
    expected = read_expected(folder / f"{name}.log.chk")
    timed = ((fix, round(fix.utc_s, 3)) for fix in fixes if fix.utc_s is not None)
    return [(fix, expected.by_time[t]) for fix, t in timed if t in expected.by_time]


@pytest.mark.parametrize(("name", "epochs"), TEXT_LOGS.items())
def test_log_gives_one_fix_for_each_epoch_of_the_receiver(shared_data: Path, name: str, epochs: int) -> None:
    _, fixes = read_log(shared_data / "gnss/gpsd" / f"{name}.log")
    assert len(fixes) == epochs
    times = [fix.utc_s for fix in fixes if fix.lat_deg is not None and fix.utc_s is not None]
    assert len(times) == len(set(times))


@pytest.mark.parametrize("name", TEXT_LOGS)
def test_position_height_and_quality_are_what_gpsd_says(shared_data: Path, name: str) -> None:
    """1e-7 deg (11 mm) and 1 mm of height; gpsd omits the status of a plain fix."""
    found = pairs(shared_data / "gnss/gpsd", name)
    assert found
    for fix, reports in found:
        assert any(fix.lat_deg == pytest.approx(r["lat"], abs=1e-7) for r in reports)
        assert any(fix.lon_deg == pytest.approx(r["lon"], abs=1e-7) for r in reports)
        heights = [r["altHAE"] for r in reports if "altHAE" in r and name not in WITHOUT_GEOID]
        assert not heights or fix.height_m == pytest.approx(heights[-1], abs=1e-3)
        statuses = [int(r["status"]) for r in reports if "status" in r]
        assert fix.quality == (GPSD_STATUS[statuses[-1]] if statuses else FixQuality.SINGLE)


@pytest.mark.parametrize("name", ["nmea-rtk", "mt3339", "hemi", "skytraq-PX1172RH_DS"])
def test_speed_and_course_are_what_gpsd_says(shared_data: Path, name: str) -> None:
    """gpsd rounds speed to 1 mm/s."""
    checked = 0
    for fix, reports in pairs(shared_data / "gnss/gpsd", name):
        speeds = [r["speed"] for r in reports if "speed" in r]
        tracks = [r["track"] for r in reports if "track" in r]
        assert not speeds or min(abs(s - (fix.speed or 0.0)) for s in speeds) < 2e-3
        if tracks and fix.course_rad is not None:
            turns = [abs((t - bearing_of_yaw(fix.course_rad) + 180) % 360 - 180) for t in tracks]
            assert min(turns) < 1e-3
            checked += 1
    assert checked


@pytest.mark.parametrize(("name", "count"), [("skytraq-PX1172RH_DS", 9), ("hemi", 4)])
def test_heading_of_two_antennas_is_what_gpsd_says(shared_data: Path, name: str, count: int) -> None:
    """Within 1e-3 deg, in order, also where the heading appears only late in the log."""
    folder = shared_data / "gnss/gpsd"
    _, fixes = read_log(folder / f"{name}.log")
    told = [bearing_of_yaw(f.heading_rad) for f in fixes if f.heading_rad is not None]
    expected = list(dict.fromkeys(read_expected(folder / f"{name}.log.chk").headings_deg))
    assert len(told) == count
    assert list(dict.fromkeys(round(h, 3) for h in told)) == pytest.approx(expected, abs=1e-3)


def test_height_without_geoid_separation_is_not_guessed(shared_data: Path) -> None:
    for name in WITHOUT_GEOID:
        _, fixes = read_log(shared_data / "gnss/gpsd" / f"{name}.log")
        assert all(fix.height_m is None and fix.lat_deg is not None for fix in fixes)


def test_every_quality_change_of_the_rtk_log_is_seen(shared_data: Path) -> None:
    _, fixes = read_log(shared_data / "gnss/gpsd/nmea-rtk.log")
    qualities = [fix.quality for fix in fixes]
    assert qualities.count(FixQuality.DIFFERENTIAL) == 104
    assert qualities.count(FixQuality.RTK_FIXED) == 18


def test_receivers_own_accuracy_is_taken_from_gst(shared_data: Path) -> None:
    raw = (shared_data / "gnss/gpsd/ublox-zed-f9p-nmea.log").read_bytes()
    told = [NMEAReader.parse(line + b"\r\n") for line in raw.splitlines() if line.startswith(b"$GNGST")]
    _, fixes = read_log(shared_data / "gnss/gpsd/ublox-zed-f9p-nmea.log")
    assert [f.std_north_m for f in fixes] == [m.stdLat for m in told]
    assert [f.std_east_m for f in fixes] == [m.stdLong for m in told]


@pytest.mark.parametrize("name", BINARY_LOGS)
def test_binary_log_yields_no_fix(shared_data: Path, name: str) -> None:
    stream, fixes = read_log(shared_data / "gnss/gpsd" / f"{name}.log")
    assert fixes == []
    assert stream.sentences == 0


def test_text_between_binary_messages_is_kept(shared_data: Path) -> None:
    stream, fixes = read_log(shared_data / "gnss/semuconsulting/pygpsdata-mixed.log")
    assert [f.lat_deg for f in fixes] == pytest.approx([53 + 27.03557 / 60, 53 + 27.03556 / 60], abs=1e-9)
    assert stream.refused_counts[Refused.NOT_TEXT] == 2


def test_wrong_checksums_are_refused_and_counted(shared_data: Path) -> None:
    stream, fixes = read_log(shared_data / "gnss/semuconsulting/pygpsdata-nmeabadck.log")
    assert stream.refused_counts[Refused.CHECKSUM] == 2
    assert len(fixes) == 1
    stream, fixes = read_log(shared_data / "gnss/unicore/unicore_bad_checksum.txt")
    assert (stream.refused_counts[Refused.CHECKSUM], fixes) == (2, [])


def test_sentence_that_contradicts_its_epoch_is_refused(shared_data: Path) -> None:
    """The RMC of this log lies 100 deg east of the GGA, GNS and GLL of the same second."""
    stream, fixes = read_log(shared_data / "gnss/semuconsulting/pygpsdata-nmea4.log")
    assert [r.text for r in stream.refusals if r.reason is Refused.DISAGREES] == ["RMC"]
    assert [f.lon_deg for f in fixes] == pytest.approx([-(2 + 14.42462 / 60)], abs=1e-9)


def test_unicore_text_agrees_with_the_nmea_of_the_same_epoch(shared_data: Path) -> None:
    """AGRICA, GGA and RMC of one second: AGRICA's own rank wins, and GGA's position lies within 1e-9 deg."""
    stream, fixes = read_log(shared_data / "gnss/unicore/unicore_valid.txt")
    agric = next(f for f in fixes if f.utc_s == 1691572510.0)
    assert agric.lat_deg == pytest.approx(50 + 57.25505246 / 60, abs=1e-9)
    assert agric.lon_deg == pytest.approx(6 + 53.73013267 / 60, abs=1e-9)
    assert agric.height_m == pytest.approx(48.3615 + 46.9156, abs=1e-3)
    assert agric.quality is FixQuality.RTK_FLOAT
    assert sum(stream.refused_counts.values()) == 0


def test_headings_of_unicore_text_carry_their_accuracy(shared_data: Path) -> None:
    _, fixes = read_log(shared_data / "gnss/unicore/unicore_valid.txt")
    told = {round(bearing_of_yaw(f.heading_rad), 3): f.heading_std_rad for f in fixes if f.heading_rad is not None}
    expected_deg = {219.978: 16.4390, 179.028: 0.8259, 90.0: 0.1, 82.026: 0.3030, 75.566: 0.104981117}
    for bearing, std_deg in expected_deg.items():
        std = told[bearing]
        assert std is not None
        assert std * 57.29577951 == pytest.approx(std_deg, rel=1e-6)


def test_second_antennas_own_position_is_never_taken_for_the_robots(shared_data: Path) -> None:
    stream, fixes = read_log(shared_data / "gnss/semuconsulting/unicore_nmea.log")
    assert stream.unused["GGAH"] == 1
    assert all(f.lat_deg is None for f in fixes)

"""Healthy drives that are watched: what counts as a false alarm, and what an hour of them says."""

from __future__ import annotations

import pytest

from navcore.bench.lidar3d.false_alarm_figures import false_alarm_figures
from navcore.bench.lidar3d.ndt_scans import NdtScanParams, ndt_scans
from navcore.bench.lidar3d.watched_drives import Watched, WatchedCase, WatchParams, watch, watched_cases
from navcore.localization.lidar3d.map_watch import MapWatch, WatchedMatch
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, tuning_block

SIZE = BlockSize(alleys=1, length=12.0)
BLOCK = tuning_block(0, SIZE)


def watched(hours: float, *alarms: str, season: Season = Season.DORMANT) -> Watched:
    return Watched(season=season, hours=hours, alarms=alarms, deserved=0, turns=100, believed=99)


def test_three_hours_without_an_alarm_bound_the_rate_at_one_an_hour() -> None:
    figures = {f.figure: f for f in false_alarm_figures([watched(1.6), watched(1.5, season=Season.GROWING)])}
    rate = figures["false alarms an hour"]
    assert (rate.value, rate.low, rate.ok) == (0.0, 0.0, True)
    assert rate.high is not None
    assert rate.high <= 1.0  # an hour
    assert figures["winter: false alarms an hour"].ok is None
    assert figures["spring: false alarms an hour"].value is None
    assert figures["matches believed on these drives"].value == pytest.approx(0.99)


def test_four_alarms_in_three_hours_are_too_many_and_none_in_one_hour_says_too_little() -> None:
    rates = [false_alarm_figures(drives)[1] for drives in ([watched(3.1, "a", "b", "c", "d")], [watched(1.0)])]
    assert rates[0].value == pytest.approx(1.29, abs=0.01)
    assert [rate.ok for rate in rates] == [False, None]


def test_no_two_drives_of_the_bench_are_the_same() -> None:
    empty = ndt_scans(NdtScanParams(block=0, tuning=True, size=SIZE, scans=0)).ndt_map
    cases = [case for number in range(2) for case in watched_cases(BLOCK, number, empty, (0, 1), WatchParams())]
    assert len({case.drive.seed for case in cases}) == len(cases) == 18
    assert {case.drive.rows[0] for case in cases} == {0, 1}


def test_trust_that_is_taken_from_a_right_place_is_an_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    ndt_map = ndt_scans(NdtScanParams(block=0, tuning=True, size=SIZE, scans=0)).ndt_map
    case = WatchedCase(block=BLOCK, drive=BlockDriveParams(seed=3, rows=(0,), speed=1.5), ndt_map=ndt_map)
    healthy = watch(case)
    assert (healthy.alarms, healthy.deserved) == ((), 0)
    assert healthy.believed > 0.9 * healthy.turns
    assert healthy.hours == pytest.approx((healthy.turns - 1) / 36_000)

    def jumpy(self: MapWatch, before: WatchedMatch, now: WatchedMatch) -> str:
        return "jumped" if now.match.stamp_ns % 5_000_000_000 < 500_000_000 else ""

    monkeypatch.setattr(MapWatch, "_jumped", jumpy)
    assert set(watch(case).alarms) == {"jumped"}


def test_trust_that_is_taken_from_a_wrong_place_is_no_false_alarm() -> None:
    elsewhere = ndt_scans(NdtScanParams(block=0, size=SIZE, scans=0)).ndt_map
    found = watch(WatchedCase(block=BLOCK, drive=BlockDriveParams(seed=3, rows=(0,), speed=1.5), ndt_map=elsewhere))
    assert found.alarms == ()
    assert found.deserved > 0

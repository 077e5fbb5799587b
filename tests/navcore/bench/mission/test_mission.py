"""The bench drives what it says, goes on where it was broken off, and counts honestly."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from navcore.bench.evaluate.evaluate import Deviation, Evaluation
from navcore.bench.evaluate.switches import SwitchScore
from navcore.bench.mission.cases import CaseKind, CaseParams, EyeKind, Farms, MissionCase, Track, mission_cases
from navcore.bench.mission.drive import DriveLimits, drive_case, on_gnss_alone
from navcore.bench.mission.figures import mission_figures
from navcore.bench.mission.result import MissionResult, append_result, missing, read_results
from navcore.bench.mission.tracks import track_plan, track_points
from navcore.config import RobotConfig
from navcore.maps.mission import RowExit
from navcore.messages import SegmentKind
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.sim.layouts import tuning_layout
from navcore.vehicle import PAPER_A

WHOLE = (CaseKind.MISSION, CaseKind.ROW_CHANGE)


def test_the_full_bench_has_a_hundred_missions_on_five_farms_in_three_seasons_and_lights() -> None:
    missions = [c for c in mission_cases(CaseParams()) if c.kind in WHOLE]
    assert len(missions) >= 100
    assert len({c.farm for c in missions}) >= 5
    assert len({c.season for c in missions}) == len({c.light for c in missions}) == 3
    assert {c.eye for c in missions} == {EyeKind.PIXELS}
    assert {c.farms for c in missions} == {Farms.SCORING}
    for name in ("row_exit", "speed"):
        assert len({(getattr(c, name), c.season) for c in missions}) >= 6


def test_every_mission_has_its_ablation_in_the_very_same_world() -> None:
    cases = mission_cases(CaseParams())
    missions = {replace(c, kind=CaseKind.GNSS_ONLY).id for c in cases if c.kind in WHOLE}
    assert missions == {c.id for c in cases if c.kind is CaseKind.GNSS_ONLY}


@pytest.mark.parametrize("quick", [True, False])
def test_no_two_cases_share_a_name(quick: bool) -> None:
    cases = mission_cases(CaseParams(quick=quick))
    assert len({c.id for c in cases}) == len(cases)


def test_quick_is_a_small_subset_of_the_full_bench() -> None:
    quick, full = mission_cases(CaseParams(quick=True)), mission_cases(CaseParams())
    assert {c.id for c in quick} <= {c.id for c in full}
    assert len(quick) < 0.2 * len(full)
    assert {c.kind for c in quick} == {CaseKind.TRACK, CaseKind.MISSION, CaseKind.GNSS_ONLY}


def test_gnss_alone_follows_the_same_path_and_need_not_see_a_row() -> None:
    site = tuning_layout(0)
    plan = plan_mission(site, mission_for_row(site, site.rows[0].id, RowExit.REVERSE), PAPER_A)
    alone = on_gnss_alone(plan)
    assert [s.points for s in alone.segments] == [s.points for s in plan.segments]
    assert [s.reverse for s in alone.segments] == [s.reverse for s in plan.segments]
    assert {s.kind for s in alone.segments} == {SegmentKind.ROAD}


@pytest.mark.parametrize("track", list(Track))
def test_tracks_are_a_hundred_metres_long(track: Track) -> None:
    points = track_points(track)
    lengths = np.hypot(*np.diff(points, axis=0).T)
    assert lengths.sum() == pytest.approx(100.0, abs=0.2)
    assert lengths.max() < 0.11
    assert len(track_plan(track).segments[0].points) == len(points)


def test_the_curve_is_a_half_circle_and_the_z_turns_twice() -> None:
    curve, z = track_points(Track.CURVE), track_points(Track.Z)
    assert math.hypot(*curve[-1]) == pytest.approx(2 * 100.0 / math.pi, abs=0.3)
    headings = np.unwrap(np.arctan2(*np.diff(z, axis=0).T[::-1]))
    assert np.degrees(headings.max()) == pytest.approx(120.0, abs=4.0)
    assert abs(np.degrees(headings[-1])) < 4.0


TRACK = MissionCase(kind=CaseKind.TRACK, farms=Farms.TUNING, farm=0, seed=5, track=Track.STRAIGHT, speed=0.8)


def test_a_track_is_started_beside_its_line_and_driven_in_lockstep() -> None:
    outcome = drive_case(TRACK, RobotConfig(), DriveLimits(drive_s=4.0))
    assert outcome.state == "driving"
    assert outcome.record is not None
    assert outcome.record.truth[0, 2] == pytest.approx(1.1, abs=0.02)
    assert outcome.record.truth[-1, 1] > 0.5


def evaluation(*, finished: bool = True, lateral: float = 0.05, seconds: float | None = 0.2) -> Evaluation:
    deviation = Deviation(mean=lateral, p95=2 * lateral, largest=3 * lateral, samples=100)
    switch = SwitchScore(
        stamp_s=1.0, before="gnss_path", after="row", reason="seen", lateral_m=lateral, seconds=seconds
    )
    return Evaluation(
        finished=finished, clean=finished, state="finished" if finished else "stopped", duration_s=100.0,
        driven_m=60.0, rows_are_true=True, gnss_whole=deviation, gnss_steady=deviation, row_lateral=deviation,
        row_heading_deg=deviation, image_heading_deg=None, entry_errors=(lateral,), switches=(switch,),
        wrong_rows=(), contacts=(),
    )  # fmt: skip


def result(number: int, kind: CaseKind = CaseKind.MISSION, **more: object) -> MissionResult:
    case = MissionCase(kind=kind, farms=Farms.SCORING, farm=0, seed=number)
    return MissionResult(case=case, state="finished", why="", evaluation=evaluation(**more))  # type: ignore[arg-type]


def value_of(results: list[MissionResult], name: str) -> float | None:
    return next(f.value for f in mission_figures(results) if f.figure.startswith(name))


def test_finished_missions_are_a_share_with_its_interval_and_the_ablation_beside_it() -> None:
    missions = [result(i, finished=i != 0) for i in range(10)]
    alone = [result(i, CaseKind.GNSS_ONLY, finished=i == 0) for i in range(10)]
    figure = mission_figures([*missions, *alone])[0]
    assert figure.value == pytest.approx(0.9)
    assert figure.baseline == pytest.approx(0.1)
    assert figure.n == 10
    assert figure.low is not None
    assert figure.high is not None
    assert 0.55 < figure.low < 0.65
    assert 0.97 < figure.high < 0.99
    assert figure.ok is False


def test_a_mission_that_never_drove_counts_as_failed() -> None:
    refused = replace(result(1), evaluation=None, state="refused")
    assert value_of([result(0), refused], "missions finished") == pytest.approx(0.5)


def test_a_switch_without_a_command_counts_against_the_switches() -> None:
    assert value_of([result(0), result(1, seconds=None)], "mode switches") == pytest.approx(0.5)


def test_the_worst_switch_counts() -> None:
    assert value_of([result(0), result(1, lateral=0.4)], "largest lateral error") == pytest.approx(0.4)


def test_without_results_there_are_figures_without_values() -> None:
    assert all(f.value is None and f.ok is None for f in mission_figures([]))


def test_results_survive_being_written_and_a_torn_last_line_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "missions.jsonl"
    for number in range(3):
        append_result(path, result(number))
    path.write_bytes(path.read_bytes()[:-20])
    found = read_results(path)
    assert list(found.values()) == [result(0), result(1)]
    cases = [result(number).case for number in range(3)]
    assert missing(cases, found) == [cases[2]]

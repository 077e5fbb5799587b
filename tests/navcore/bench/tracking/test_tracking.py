"""The bench of path tracking: its ways, its arithmetic, and one short drive of each kind."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from navcore.bench.tracking.alone import Chassis, Footprint, drive_alone
from navcore.bench.tracking.cases import (
    QUICK,
    SCORING_SEEDS,
    SHIPPED,
    TUNING_SEEDS,
    Localization,
    Rival,
    TrackingCase,
    TrackingCaseParams,
    tracking_cases,
)
from navcore.bench.tracking.courses import Course, Track, track, track_plan
from navcore.bench.tracking.drive import TrackingResult, drive_track, measured
from navcore.bench.tracking.figures import LARGEST_TABLE, MEAN_TABLE, largest_cm, mean_cm, tracking_figures
from navcore.bench.tracking.plot import tracking_plot
from navcore.bench.tracking.tracking import DRIVES, drive_all, read_drives
from navcore.config import RobotConfig
from navcore.control.tracking import TrackingParams
from navcore.vehicle import SCOUT_2

CASE = TrackingCase(rival=SHIPPED, localization=Localization.RTK, course=Course.STRAIGHT, speed=1.0, seed=1)


def result(mean: float | None, largest: float | None, *, why: str = "", **changed: Any) -> TrackingResult:
    return TrackingResult(
        case=replace(CASE, **changed), mean=mean, largest=largest, pose_error=0.005, trace=((0.0, 0.0), (5.0, 0.02)),
        why=why,
    )  # fmt: skip


@pytest.mark.parametrize("course", list(Course))
def test_a_way_is_smooth_and_what_counts_lies_on_it(course: Course) -> None:
    way = track(course)
    assert 0.0 < way.first < way.last < way.line.length
    assert np.abs(way.line.curvatures).max() < 1.0 / 0.85  # 1/m: no turn of the planner's is tighter than 0.9 m
    steps = np.hypot(*np.diff(way.points, axis=0).T)
    assert 1e-6 < steps.min() <= steps.max() < 0.15


def test_the_straight_row_is_forty_metres_and_the_bent_one_bends_both_ways() -> None:
    assert track(Course.STRAIGHT).line.length == pytest.approx(40.0, abs=0.1)
    bends = track(Course.CURVE).line.curvatures
    assert (bends.min(), bends.max()) == (pytest.approx(-1 / 15, abs=0.002), pytest.approx(1 / 15, abs=0.002))


def test_the_headland_turn_leads_into_the_neighbouring_row_on_the_planner_s_tightest_arcs() -> None:
    way = track(Course.TURN)
    start, end = way.points[0], way.points[-1]
    assert end - start == pytest.approx((0.0, 3.0), abs=1e-6)
    turned = np.unwrap(way.line.headings)
    assert abs(turned[-1] - turned[0]) == pytest.approx(math.pi, abs=0.02)
    assert np.abs(way.line.curvatures).max() == pytest.approx(1 / 0.9, abs=0.02)


def test_no_way_is_planned_faster_than_the_chassis_can_turn() -> None:
    speeds = track_plan(track(Course.TURN), 1.5, SCOUT_2).segments[0].speeds
    assert min(speeds) == pytest.approx(0.75 * 0.75 / 1.6 * 0.9, abs=0.02)  # m/s on 0.9 m radius
    assert max(track_plan(track(Course.STRAIGHT), 1.5, SCOUT_2).segments[0].speeds) == 1.5


def test_ground_that_was_tuned_on_is_not_scored_on() -> None:
    assert not set(TUNING_SEEDS) & set(SCORING_SEEDS)
    assert len(SCORING_SEEDS) >= 20
    assert {case.seed for case in tracking_cases(TrackingCaseParams())} == set(SCORING_SEEDS)
    assert {case.seed for case in tracking_cases(QUICK)} <= set(SCORING_SEEDS)


def test_every_controller_drives_the_same_ways_on_the_same_ground() -> None:
    cases = [c for c in tracking_cases(TrackingCaseParams()) if c.localization is Localization.TRUE]
    driven = [{(c.course, c.speed, c.seed) for c in cases if c.rival is rival} for rival in Rival]
    assert all(one == driven[0] for one in driven)
    assert len(driven[0]) == 3 * 3 * 20


def test_the_one_that_is_judged_is_the_one_that_is_shipped() -> None:
    case = replace(CASE, rival=SHIPPED)
    assert case.config().navigator.driver.tracking == TrackingParams() == RobotConfig().navigator.driver.tracking
    assert len({replace(CASE, rival=rival).config().navigator.driver.tracking for rival in Rival}) == len(Rival)


def test_only_what_counts_is_measured() -> None:
    way = Track(np.array(((0.0, 0.0), (10.0, 0.0))), 2.0, 8.0)
    prints = tuple(Footprint(s, lateral, 1.0) for s, lateral in ((1.0, 9.0), (2.0, -0.1), (5.0, 0.2), (9.0, 9.0)))
    found = measured(CASE, way, prints)
    assert (found.mean, found.largest) == pytest.approx((0.15, 0.2))
    assert measured(CASE, way, prints[:1], why="stopped").mean is None


def test_means_are_of_drives_and_the_largest_is_of_all() -> None:
    drives = [result(0.01, 0.03), result(0.03, 0.05), result(None, None, why="stopped")]
    assert (mean_cm(drives), largest_cm(drives)) == pytest.approx((2.0, 5.0))
    assert (mean_cm(drives[2:]), largest_cm(drives[2:])) == (None, None)


def test_ours_is_judged_with_the_pose_s_error_counted_in_and_stands_beside_the_paper_and_the_published_law() -> None:
    drives = [
        result(0.02, 0.03), result(0.03, 0.04, course=Course.CURVE), result(0.01, 0.16, course=Course.TURN),
        result(0.05, 0.09, rival=Rival.PUBLISHED), result(0.01, 0.02, localization=Localization.TRUE),
    ]  # fmt: skip
    figures = tracking_figures(drives)
    mean, alone = (
        next(f for f in figures if f.table == MEAN_TABLE and f.figure == f"{SHIPPED}, {where}, rows at 1.0 m/s: mean")
        for where in (Localization.RTK, Localization.TRUE)
    )
    assert (mean.value, mean.paper, mean.target, mean.baseline) == pytest.approx((2.5, 3.5, 2.0, 5.0))
    assert mean.ok is False
    assert alone.value == pytest.approx(1.0)
    assert alone.ok is None
    largest = next(
        f for f in figures if f.table == LARGEST_TABLE and f.target is None and f.value == pytest.approx(4)
    )
    assert largest.paper == 6.0
    turn = next(f for f in figures if "headland turn" in f.figure and f.target is not None)
    assert (turn.value, turn.target) == pytest.approx((16.0, 15.0))
    assert turn.ok is False


def test_a_drive_that_did_not_get_through_is_counted_and_told() -> None:
    figures = tracking_figures([result(0.01, 0.02), result(None, None, why="off the path", seed=2)])
    through = next(f for f in figures if "got to the end" in f.figure)
    assert (through.value, through.n, through.ok) == (0.5, 2, False)


def test_the_plot_has_a_panel_a_course_and_speed_and_a_line_a_drive() -> None:
    drives = [result(0.01, 0.02), result(0.2, 0.3, rival=Rival.PUBLISHED), result(0.1, 0.1, speed=1.5)]
    page = ElementTree.fromstring(tracking_plot(drives, Localization.RTK))
    assert len(page.findall(".//{*}polyline")) == 3
    assert len(page.findall("{*}g")) == 2 * len(Course)
    assert not ElementTree.fromstring(tracking_plot([], Localization.RTK)).findall(".//{*}polyline")


def test_the_same_seed_gives_the_same_drive_and_another_one_another() -> None:
    way = replace(track(Course.STRAIGHT), points=track(Course.STRAIGHT).points[:60])
    config = CASE.config()
    first, again, other = (drive_alone(way, 1.0, config, seed) for seed in (1001, 1001, 1002))
    assert first == again
    assert first != other
    assert first[-1].s > way.line.length - 0.5
    assert max(abs(p.lateral) for p in first if p.s > 3.0) < 0.10  # m


def test_the_chassis_answers_late_and_turns_less_than_its_wheels_say() -> None:
    chassis = Chassis(track(Course.STRAIGHT), CASE.config(), 1001)
    for _ in range(4):
        chassis.tick(1.0, 0.5)
    assert chassis.motion.v == pytest.approx(0.0, abs=1e-3)
    for _ in range(100):
        chassis.tick(1.0, 0.5)
    motion = chassis.motion
    assert motion.wheel_omega == pytest.approx(0.5, abs=0.01)
    assert 0.4 < motion.omega / 0.5 < 0.85


def test_a_bench_that_was_broken_off_goes_on(tmp_path: Path) -> None:
    case = replace(CASE, localization=Localization.TRUE, course=Course.TURN, speed=1.5, seed=1001)
    told: list[str] = []
    first = drive_all([case], tmp_path, 1, told.append)
    (tmp_path / DRIVES).write_bytes((tmp_path / DRIVES).read_bytes() + b'{"case": {"torn')
    assert drive_all([case], tmp_path, 1, told.append) == first == (read_drives(tmp_path / DRIVES)[case],)
    assert len(told) == 1
    assert first[0].largest is not None
    assert first[0].largest < 0.15  # m


def test_the_whole_robot_keeps_to_its_row_on_rtk() -> None:
    found = drive_track(replace(CASE, speed=1.5, seed=1001))
    assert found.why == ""
    assert found.mean is not None
    assert found.mean < 0.03  # m
    assert 0.0 < found.pose_error < 0.03
    assert found.trace[-1][0] > 38.0

"""The pose that the operator is told is the one that the robot drives by, in rows and on the way out of them."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.maps.mission import RowExit
from navcore.messages import FixQuality, LinkLossPolicy, NavMode, PoseEstimate, RequestKind, RunState
from navcore.mission.driven_pose import driven_pose
from navcore.mission.driver import Driving
from navcore.mission.situation import Situation
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.lockstep import Tick
from navcore.sim.world import WorldParams
from tests.missions.conftest import Drive, assert_driven_in_and_out, new_drive, off_line, small_farm

FARM = small_farm()
ROWS = {row.id: row for row in FARM.rows}


@pytest.fixture(scope="module")
def driven() -> Drive:
    """Into a row, back out of it and home."""
    drive = new_drive(FARM, WorldParams(seed=2))
    drive.start(FARM, mission_for_row(FARM, "r1", RowExit.REVERSE))
    drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=600)
    return drive


def told(tick: Tick) -> PoseEstimate:
    pose = tick.decision.status.pose
    assert pose is not None
    return pose


def beside_row(pose: PoseEstimate, row_id: str) -> tuple[float, float]:
    """Distance from the drawn row, m, positive on its left, and its 1-sigma."""
    (x0, y0), (x1, y1) = ROWS[row_id].start, ROWS[row_id].end
    length = math.dist((x0, y0), (x1, y1))
    left = np.array((-(y1 - y0), x1 - x0)) / length
    std = math.sqrt(left @ np.reshape(pose.covariance, (3, 3))[:2, :2] @ left)
    return float(left @ (pose.x - x0, pose.y - y0)), std


def in_row(drive: Drive) -> list[tuple[Tick, str]]:
    found = [(tick, tick.decision.status.row_id) for tick in drive.ticks if tick.decision.status.mode is NavMode.ROW]
    return [(tick, row_id) for tick, row_id in found if row_id is not None]


def true_rows(drive: Drive) -> dict[str, tuple[tuple[float, float], tuple[float, float]]]:
    return {row.id: (row.start, row.end) for row in drive.lockstep.world.site.rows}


def errors_beside_row(drive: Drive) -> list[tuple[float, float]]:
    """At every tick in the row: told less true distance beside it, and the told 1-sigma, m."""
    true = true_rows(drive)
    found = []
    for tick, row_id in in_row(drive):
        lateral, std = beside_row(told(tick), row_id)
        found.append((lateral - off_line(tick, *true[row_id]), std))
    return found


def test_the_robot_drives_into_a_row_and_back_out_in_reverse(driven: Drive) -> None:
    assert_driven_in_and_out(driven)


def test_in_a_row_the_robot_is_shown_as_far_beside_the_drawn_row_as_it_is_beside_the_true_one(driven: Drive) -> None:
    assert max(abs(error) for error, _ in errors_beside_row(driven)) < 0.20  # m


def test_the_told_doubt_across_the_row_covers_the_error(driven: Drive) -> None:
    shares = [error / std for error, std in errors_beside_row(driven)]
    assert math.sqrt(np.mean(np.square(shares))) < 1.5
    assert np.mean([std for _, std in errors_beside_row(driven)]) < 0.10  # m


def test_along_the_row_the_doubt_is_that_of_its_ends_until_one_is_seen(driven: Drive) -> None:
    pose, row_id = told(in_row(driven)[0][0]), in_row(driven)[0][1]
    along = np.array(ROWS[row_id].end) - np.array(ROWS[row_id].start)
    along = along / np.hypot(*along)
    variance = along @ np.reshape(pose.covariance, (3, 3))[:2, :2] @ along
    assert 0.5 < math.sqrt(variance) < 2.0  # m


def test_the_driven_line_has_no_jump_from_the_warehouse_into_the_row_and_home(driven: Drive) -> None:
    poses = [told(tick) for tick in driven.ticks if tick.decision.status.state is RunState.DRIVING]
    steps = [math.hypot(b.x - a.x, b.y - a.y) for a, b in pairwise(poses)]
    assert max(steps) < 0.06  # m in 20 ms


def test_what_the_path_has_still_to_slide_is_told_as_doubt(driven: Drive) -> None:
    """Back on the road the followed pose slides to that of GNSS, which an RTK fix knows to centimetres."""
    sliding = [
        tick.decision.status
        for tick in driven.ticks
        if tick.decision.status.mode is NavMode.GNSS_PATH and tick.decision.status.state is RunState.DRIVING
    ]
    for status in sliding:
        assert status.pose is not None
        assert status.gnss_pose is not None
        gap = math.hypot(status.pose.x - status.gnss_pose.x, status.pose.y - status.gnss_pose.y)
        assert gap**2 <= status.pose.covariance[0] + status.pose.covariance[4]
    last = sliding[-1]
    assert last.gnss_quality is FixQuality.RTK_FIXED
    assert last.pose is not None
    assert last.gnss_pose is not None
    assert math.hypot(last.pose.x - last.gnss_pose.x, last.pose.y - last.gnss_pose.y) < 0.05  # m


def test_the_pose_by_gnss_alone_stays_beside_it(driven: Drive) -> None:
    """So that its wandering under leaves can be looked at, and no mode is chosen by what rows tell."""
    by_gnss = [tick.decision.status.gnss_pose for tick, _ in in_row(driven)]
    assert all(pose is not None and "row" not in pose.source for pose in by_gnss)
    assert all("row" in told(tick).source for tick, _ in in_row(driven))


def test_a_stop_in_a_row_leaves_the_robot_where_it_is_shown_until_it_is_driven_away_by_hand() -> None:
    drive = new_drive(FARM, WorldParams(seed=2))
    drive.start(FARM, mission_for_row(FARM, "r1", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=15)
    before = told(drive.ask(RequestKind.STOP))
    after = told(drive.until(lambda _: False, seconds=3))
    assert math.hypot(after.x - before.x, after.y - before.y) < 0.5  # m, its way to standstill
    assert after.source == "row+gyro"
    navigator = drive.lockstep.navigator
    stopped = Situation(
        state=navigator.state, since_ns=0, run_id=None, link_loss=LinkLossPolicy.CONTINUE, heard_ns=0,
        senses=navigator.senses, pilot=navigator.pilot, driving=Driving.standing(), body_width=0.7,
    )  # fmt: skip
    navigator.senses.T_odom_base = navigator.senses.T_odom_base @ SE2(3.0, 0.0, 0.0)
    assert driven_pose(stopped) == navigator.senses.pose
    assert driven_pose(replace(stopped, pilot=None)) == navigator.senses.pose

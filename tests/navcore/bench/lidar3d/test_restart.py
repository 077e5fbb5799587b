"""The arithmetic of the restarts, and robots that are put where the bench says."""

from __future__ import annotations

import math

import pytest

from navcore.bench.lidar3d.restart_figures import Restarts, restart_figures
from navcore.bench.lidar3d.restart_trial import (
    ROUGHLY_M,
    ROUGHLY_RAD,
    Restarted,
    RestartParams,
    a_row_off,
    robots,
    roughly,
)
from navcore.geometry.se2 import SE2
from navcore.sim.pear_block import ROW_M, BlockSize, scoring_block

BLOCK = scoring_block(0, BlockSize(alleys=2, length=24.0))
SOON, LATE = (Restarted(found_s=s, wrong=False, ambiguous=False) for s in (2.0, 10.5))
WRONG = Restarted(found_s=2.0, wrong=True, ambiguous=False)
UNSURE = Restarted(found_s=math.inf, wrong=False, ambiguous=True)


def test_only_what_is_right_in_time_counts_as_right() -> None:
    found = [Restarts(roughly=r, nothing=UNSURE, row_off=UNSURE) for r in (SOON, SOON, LATE, WRONG)]
    figures = {f.figure.removeprefix("winter: restarted, "): f for f in restart_figures("winter", found)}
    assert (figures["told roughly: right within 10 s"].value, figures["told roughly: right within 10 s"].ok) == (
        0.5,
        False,
    )
    assert (figures["told roughly: wrong"].value, figures["told roughly: wrong"].ok) == (0.25, False)
    assert figures["told nothing: ambiguous"].value == 1.0
    assert (figures["told nothing: wrong"].value, figures["told nothing: wrong"].ok) == (0.0, True)
    assert figures["told roughly: median time"].value == 2.0  # s, of those that are right


def test_without_a_robot_nothing_is_claimed() -> None:
    assert all(figure.value is None and figure.ok is None for figure in restart_figures("winter", []))


def test_robots_stand_in_the_block_and_every_second_one_creeps() -> None:
    put = list(robots(BLOCK, 40, 7, RestartParams()))
    assert [robot.creep > 0.0 for robot in put[:4]] == [False, True, False, True]
    assert put == list(robots(BLOCK, 40, 7, RestartParams()))
    for robot in put:
        across = min(_away(robot.at, row.start, row.end) for row in BLOCK.site.rows)
        assert across < 1.0  # m from the middle of a row


@pytest.mark.parametrize("seed", range(50))
def test_roughly_is_within_what_a_person_is_sure_of(seed: int) -> None:
    at = SE2(3.0, -2.0, 0.4)
    told = roughly(at, seed)
    assert math.dist((told.x, told.y), (at.x, at.y)) <= ROUGHLY_M
    assert abs(told.yaw - at.yaw) <= ROUGHLY_RAD
    off = a_row_off(told, 0.4, seed)
    assert math.dist((off.x, off.y), (told.x, told.y)) == pytest.approx(ROW_M)


def _away(at: SE2, start: tuple[float, float], end: tuple[float, float]) -> float:
    """Across the line through both, m."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    return abs((at.x - start[0]) * dy - (at.y - start[1]) * dx) / math.hypot(dx, dy)

"""Where along its row the robot is, while its wheels slip by a tenth."""

from __future__ import annotations

from dataclasses import replace

import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.row_line import RowLine
from navcore.messages import CameraName, RowObservation
from navcore.mission.along_row import AlongRow, AlongRowParams

ROW, LENGTH = RowLine(0.0, 0.0, 0.0), 60.0
SEEN = RowObservation(
    stamp_ns=1, camera=CameraName.FRONT, valid=True, reason="", offset=0.0, heading=0.0, width=3.0, quality=0.9,
    driven=0.0, driven_since_ns=1,
)  # fmt: skip


def place(*seen: RowObservation, start: float, at_end: bool = False) -> float:
    """Where the robot is after it has driven from `start` by what plants told, and a tenth more by its wheels, m."""
    anchor = PathAnchor(SE2(), PathAnchorParams())
    along = AlongRow(anchor, AlongRowParams())
    for observation in seen:
        odom = SE2(start + 1.1 * (observation.driven or 0.0), 0.0, 0.0)
        along.see(observation, ROW, odom, LENGTH, at_end=at_end)
    return (anchor.T_map_odom @ odom).x


def test_far_from_the_end_wheels_are_believed() -> None:
    assert place(SEEN, replace(SEEN, driven=2.0), start=20.0) == pytest.approx(22.2, abs=1e-9)  # m


def test_near_the_end_its_last_plants_are() -> None:
    ends = (replace(SEEN, end_distance=5.0), replace(SEEN, driven=2.0, end_distance=3.0))
    assert place(*ends, start=55.0) == pytest.approx(57.0, abs=0.02)  # m
    assert place(SEEN, replace(SEEN, driven=2.0), start=55.0, at_end=True) == pytest.approx(57.0, abs=1e-9)  # m


def test_the_way_to_the_first_sight_of_the_end_is_not_taken_back() -> None:
    ends = (replace(SEEN, driven=10.0), replace(SEEN, driven=11.0, end_distance=3.0))
    assert place(*ends, start=45.0) == pytest.approx(57.0, abs=0.05)  # m; 56 by plants all the way, 57.1 by wheels


@pytest.mark.parametrize(("end", "past"), [(2.5, True), (4.0, False), (None, False)])
def test_of_a_row_that_ends_before_the_picture_begins_nothing_more_comes(end: float | None, past: bool) -> None:
    along = AlongRow(PathAnchor(SE2(), PathAnchorParams()), AlongRowParams())
    assert along.past_last_plants(replace(SEEN, end_distance=end)) is past
    assert not along.past_last_plants(None)

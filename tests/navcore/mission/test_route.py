"""A plan cut into legs: what comes next is told by the segments."""

from __future__ import annotations

import math

import pytest

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.maps.mission import RowExit
from navcore.messages import CameraName, SegmentKind
from navcore.mission.route import Leg, Route
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.sim.layouts import tuning_layout
from navcore.vehicle import PAPER_A


def exits(row_exit: RowExit) -> list[tuple[Leg, float]]:
    """Each leg with the arc length at which it leaves a row."""
    site = tuning_layout(0)
    route = Route(plan_mission(site, mission_for_row(site, site.rows[1].id, row_exit), PAPER_A))
    return [
        (leg, end - 0.1)
        for leg in route.legs
        for segment, end in zip(leg.segments, leg.segment_ends, strict=True)
        if segment.kind is SegmentKind.EXIT
    ]


def test_after_the_first_row_of_a_row_change_another_row_follows_and_after_the_second_the_road() -> None:
    assert [leg.row_follows(s) for leg, s in exits(RowExit.NEXT_ROW)] == [True, False]


def test_after_backing_out_of_a_row_no_row_follows() -> None:
    assert [leg.row_follows(s) for leg, s in exits(RowExit.REVERSE)] == [False]


def test_on_the_leg_out_in_reverse_the_robot_looks_back_and_drives_the_way_its_tail_points() -> None:
    site = tuning_layout(0)
    legs = Route(plan_mission(site, mission_for_row(site, site.rows[1].id, RowExit.REVERSE), PAPER_A)).legs
    assert CameraName.REAR in [leg.camera for leg in legs]
    for leg in legs:
        back = leg.camera is CameraName.REAR
        at = leg.driving_pose(SE2(1.0, 2.0, 0.5))
        assert (at.x, at.y, abs(wrap(at.yaw - 0.5))) == pytest.approx((1.0, 2.0, math.pi if back else 0.0))
        assert back is leg.segments[0].reverse

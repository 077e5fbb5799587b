"""What is planned can be driven: by a robot that lags and turns less than its wheels say."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.control.line_tracker import LineTracker
from navcore.control.lqr_tracker import LqrTracker
from navcore.geometry.polyline import Polyline
from navcore.maps.mission import RowExit
from navcore.messages import SegmentKind
from navcore.planning.mission_planner import mission_for_row, plan_mission
from navcore.vehicle import PAPER_A
from tests.navcore.control.closed_loop import Unkind, drive
from tests.navcore.planning.farms import farm


@pytest.mark.parametrize("tracker", [LineTracker, LqrTracker])
def test_the_robot_stays_within_ten_centimetres_over_the_headland_and_into_the_next_row(
    tracker: type[LineTracker | LqrTracker],
) -> None:
    site = farm(length=12.0, headland=6.0)
    plan = plan_mission(site, mission_for_row(site, "R2", RowExit.NEXT_ROW), PAPER_A)
    kinds = [segment.kind for segment in plan.segments]
    turn = kinds.index(SegmentKind.HEADLAND)
    points = [p for segment in plan.segments[turn - 2 : turn + 3] for p in segment.points]
    driven = drive(Polyline(np.array(points)), tracker(), seed=201, start_offset=0.0, unkind=Unkind(turn_ratio=1.8))
    assert driven.s[-1] > Polyline(np.array(points)).length - 0.5
    assert np.abs(driven.lateral).max() < 0.10

"""A row of which nothing is in sight counts as seen for a metre, is carried on and told so, and then is gone."""

from __future__ import annotations

from itertools import pairwise

import pytest

from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView
from navcore.perception.detector import Told
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import FRONT, boxes_at, corridor_feet, drive, picture


def blind(metres: float, *, reach: float = 12.0) -> list[CameraView]:
    """The same row, and then nothing in sight, in pictures 0.1 m apart; plants up to `reach` m ahead of there."""
    told = Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    drive(perception, told, [SE2(0.1 * i, 0.0, 0.0) for i in range(101)], end=10.0 + reach, spacing=1.25)
    told.objects = ()
    count = round(metres / 0.1)
    return [perception.process(picture(FRONT), i, CameraName.FRONT, motion=SE2(0.1, 0.0, 0.0)) for i in range(count)]


def test_a_row_counts_as_seen_for_a_metre_without_evidence_and_is_carried_on_as_such() -> None:
    views = blind(2.0)
    seen = [view.row.carried == 0.0 for view in views]
    assert 5 <= sum(seen) <= 10  # pictures, 0.1 m apart
    assert not any(seen[sum(seen) :])
    assert views[-1].row.carried == pytest.approx(2.0, abs=0.01)  # m
    assert not any(view.row.left_seen or view.row.right_seen for view in views)
    stds = [view.row.offset_std or 0.0 for view in views]
    assert all(a < b for a, b in pairwise(stds))


def test_a_row_is_carried_on_to_the_last_plants_that_were_seen_and_no_further() -> None:
    views = blind(5.0, reach=3.5)
    carried = sum(view.row.valid for view in views)
    assert 25 <= carried <= 35  # pictures, 0.1 m apart
    assert not any(view.row.valid for view in views[carried:])
    assert views[-1].row.reason == "no trunk or post in sight"


def test_between_plants_it_is_carried_on_for_four_metres_at_most() -> None:
    assert 38 <= sum(view.row.valid for view in blind(8.0)) <= 40  # pictures, 0.1 m apart


def test_a_robot_that_stands_does_not_see_a_row_by_remembering_it() -> None:
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert perception.process(picture(FRONT), 0, CameraName.FRONT, motion=SE2()).row.valid
    told.objects = ()
    views = [perception.process(picture(FRONT), i, CameraName.FRONT, motion=SE2()) for i in range(1, 80)]
    assert views[10].row.valid
    assert not any(view.row.valid for view in views[51:])


def test_without_motion_nothing_is_carried() -> None:
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert perception.process(picture(FRONT), 0, CameraName.FRONT).row.valid
    told.objects = ()
    assert not perception.process(picture(FRONT), 1, CameraName.FRONT).row.valid

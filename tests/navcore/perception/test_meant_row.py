"""Of all rows in the picture, the one that is meant is seen."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.messages import CameraName
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import FRONT, boxes_at, corridor_feet, look, picture


@pytest.mark.parametrize(("std", "seen"), [(0.15, True), (0.4, False)])
def test_two_trunks_are_a_row_where_it_is_known_well_already(std: float, seen: bool) -> None:
    """The last plants of a row that was followed until a gap."""
    told = Told(boxes_at(FRONT, np.array([[5.0, 1.4], [4.0, -1.6]])))
    prior = RowPrior(offset=-0.1, heading=0.0, std=std, width=3.0)
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    row = perception.process(picture(FRONT), 0, CameraName.FRONT, prior=prior).row
    assert row.valid is seen
    assert row.offset is None or row.offset == pytest.approx(-0.1, abs=0.1)  # m


def test_two_trunks_off_a_well_known_row_are_none() -> None:
    told = Told(boxes_at(FRONT, np.array([[5.0, 0.5], [4.0, 0.2]])))
    prior = RowPrior(offset=0.0, heading=0.0, std=0.15, width=3.0)
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert not perception.process(picture(FRONT), 0, CameraName.FRONT, prior=prior).row.valid


def test_from_outside_the_row_that_is_meant_is_seen_and_not_its_neighbour() -> None:
    """The robot stands 5 m before the entrances of several rows, between two of them; the prior is 0.4 m off."""
    pose = SE2(-5.0, 0.6, math.radians(4.0))
    for number in (-1, 0, 1):
        centre = 3.0 * number
        true_offset = centre - pose.y
        prior = RowPrior(offset=true_offset + 0.4, heading=-pose.yaw, std=0.4, width=3.0)
        row = look(pose, prior=prior, start=0.0, lines=4).row
        assert row.valid, row.reason
        assert row.offset == pytest.approx(true_offset, abs=0.15)  # m


def test_before_an_entrance_two_plants_out_of_line_do_not_tell_the_direction() -> None:
    """The first ones on either side stand 0.15 m to the right; the robot follows the row for a second."""
    told, off = Told(), []
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    for k in range(10):
        pose = SE2(-3.0 + 0.05 * k, 0.0, 0.0)
        feet = corridor_feet(SE2(), start=0.0, lines=1)
        feet[feet[:, 0] < 1.0, 1] -= 0.15
        told.objects = boxes_at(FRONT, pose.inverse().apply(feet), reach=24.0)
        prior = RowPrior(offset=0.0, heading=0.0, std=0.15, width=3.0)
        motion = SE2(0.05, 0.0, 0.0) if k else None
        row = perception.process(picture(FRONT), k, CameraName.FRONT, prior=prior, motion=motion).row
        off.append(math.degrees(row.heading or math.inf))
    assert abs(off[-1]) < 0.35  # deg


def test_a_line_across_the_lattice_is_no_row() -> None:
    """Plants stand in line crosswise too; where the row runs is known well enough to tell."""
    pose = SE2(-5.0, 0.5, math.radians(12.0))
    for askew_deg in (-14.0, 14.0):
        prior = RowPrior(offset=-0.5, heading=-pose.yaw + math.radians(askew_deg), std=0.45, width=3.0)
        row = look(pose, prior=prior, start=0.0, lines=4).row
        assert row.heading is None or abs(row.heading - prior.heading) <= math.radians(9.0)


def test_a_prior_too_vague_to_tell_rows_apart_is_refused() -> None:
    prior = RowPrior(offset=0.0, heading=0.0, std=1.5, width=3.0)
    row = look(SE2(-5.0, 0.0, 0.0), prior=prior, start=0.0, lines=4).row
    assert (row.valid, row.reason) == (False, "the row's expected place is too vague to tell it from its neighbours")


def test_one_hidden_side_is_carried_by_the_width() -> None:
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0)
    row = look(SE2(0.0, 0.15, 0.0), prior=prior, keep_left=False).row
    assert row.valid, row.reason
    assert row.offset == pytest.approx(-0.15, abs=0.1)  # m
    assert not row.left_seen
    assert row.right_seen


def test_a_prior_that_contradicts_the_track_drops_it() -> None:
    told = Told(boxes_at(FRONT, corridor_feet(SE2())))
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    assert perception.process(picture(FRONT), 0, CameraName.FRONT).row.valid
    prior = RowPrior(offset=3.0, heading=0.0, std=0.3, width=3.0)
    row = perception.process(picture(FRONT), 1, CameraName.FRONT, prior=prior, motion=SE2()).row
    assert not row.valid or row.offset == pytest.approx(3.0, abs=0.4)  # m


@pytest.mark.parametrize(("width", "taken"), [(2.6, True), (3.5, True), (4.2, False)])
def test_a_corridor_is_the_row_that_is_meant_only_if_it_is_about_as_wide(width: float, taken: bool) -> None:
    """A fit that follows plants further and further to one side ends up holding two rows."""
    told = Told()
    perception = RowPerception(FRONT, told, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0)
    rows = []
    for i in range(60):
        told.objects = boxes_at(FRONT, corridor_feet(SE2(0.05 * i, 0.0, 0.0), width=width, lines=1))
        view = perception.process(picture(FRONT), i, CameraName.FRONT, prior=prior, motion=SE2(0.05, 0.0, 0.0))
        rows.append(view.row)
    assert all(row.valid for row in rows) is taken
    assert max(row.width for row in rows if row.width is not None) < 3.7  # m
    assert taken or any("is not the row of 3.0 m" in row.reason for row in rows)


def test_where_no_width_is_told_a_wide_row_is_a_row() -> None:
    row = look(SE2(0.0, 0.1, 0.0), width=3.9, lines=1).row
    assert row.valid, row.reason
    assert row.width == pytest.approx(3.9, abs=0.2)  # m

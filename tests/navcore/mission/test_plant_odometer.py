"""Wheels slip along a row; the plants that stand there tell by how much."""

from __future__ import annotations

import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.row_line import RowLine
from navcore.mission.plant_odometer import PlantOdometer

ROW = RowLine(0.0, 0.0, 0.0)


@pytest.fixture
def anchor() -> PathAnchor:
    return PathAnchor(SE2(), PathAnchorParams())


def drive(odometer: PlantOdometer, anchor: PathAnchor, told: float, driven: float) -> float:
    """See plants at both ends of a way; the place along the row at its end, m."""
    odometer.take(ROW, anchor.T_map_odom @ SE2(56.0, 0.0, 0.0), 0.0, 7)
    odometer.take(ROW, anchor.T_map_odom @ SE2(56.0 + told, 0.0, 0.0), driven, 7)
    return (anchor.T_map_odom @ SE2(56.0 + told, 0.0, 0.0)).x


def test_the_robot_stands_where_the_plants_say_and_not_the_wheels(anchor: PathAnchor) -> None:
    assert drive(PlantOdometer(anchor), anchor, told=2.4, driven=2.0) == pytest.approx(58.0, abs=1e-9)  # m


def test_an_end_that_was_seen_meanwhile_still_counts(anchor: PathAnchor) -> None:
    odometer = PlantOdometer(anchor)
    drive(odometer, anchor, told=2.4, driven=2.0)
    odom = SE2(58.4, 0.0, 0.0)
    anchor.see_along(ROW, odom, 57.5, 1e-6)
    odometer.take(ROW, anchor.T_map_odom @ odom, 2.0, 7)
    assert (anchor.T_map_odom @ odom).x == pytest.approx(57.5, abs=1e-6)  # m


def test_a_new_beginning_takes_nothing_from_the_way_before_it(anchor: PathAnchor) -> None:
    odometer = PlantOdometer(anchor)
    drive(odometer, anchor, told=0.0, driven=0.0)
    odometer.begin()
    odometer.take(ROW, anchor.T_map_odom @ SE2(58.4, 0.0, 0.0), 2.0, 7)
    assert (anchor.T_map_odom @ SE2(58.4, 0.0, 0.0)).x == pytest.approx(58.4, abs=1e-9)  # m


def test_what_was_not_driven_is_learned_as_slip_once_the_end_is_seen(anchor: PathAnchor) -> None:
    anchor.slip.drive(60.0, 0.0)
    drive(PlantOdometer(anchor), anchor, told=4.0, driven=1.0)
    anchor.slip.see_end()
    assert anchor.slip.share > 0.04

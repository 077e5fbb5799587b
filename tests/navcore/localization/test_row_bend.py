"""A row that is drawn straight and seen to bend: the path goes along, and no sensor is blamed for it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.row_bend import RowBend
from navcore.localization.row_filter import look_noise
from navcore.localization.row_line import RowLine

ROW = RowLine(10.0, 5.0, 0.3)
NOISE = look_noise(0.005, 0.003, 0.0)
STEP, RADIUS = 0.1, 12.0


def along_arc(curvature_told: bool) -> PathAnchor:
    """The robot keeps to the middle of a row that bends with 12 m radius, by perfect wheels and gyro."""
    start = ROW.pose(SE2(1.0, 0.0, 0.0))
    anchor, odom = PathAnchor(SE2(), PathAnchorParams()), start
    for _ in range(60):
        odom = odom @ SE2.arc(STEP, STEP / RADIUS)
        anchor.drive(STEP, STEP / 0.6, odom)
        curvature = 1.0 / RADIUS if curvature_told else 0.0
        anchor.see_row(ROW, odom, offset=0.0, heading=0.0, noise=NOISE, curvature=curvature)
        anchor.slide(odom, STEP / 0.6, STEP, ROW.heading)
    return anchor


def test_a_bend_that_was_told_is_no_error_of_the_gyro() -> None:
    told, not_told = along_arc(True), along_arc(False)
    assert abs(told.row.turn_rate) < 1e-5  # rad/s
    assert abs(not_told.row.turn_rate) > 1e-4


def test_the_path_bends_along_without_lagging_behind() -> None:
    anchor = along_arc(True)
    apart = anchor.followed.inverse() @ anchor.T_map_odom
    assert (apart.x, apart.y, apart.yaw) == pytest.approx((0.0, 0.0, 0.0), abs=0.004)  # m, rad


@given(st.floats(-0.1, 0.1), st.floats(-0.5, 1.5), st.floats(-0.3, 0.3), st.floats(-0.2, 0.2))
def test_a_place_on_the_bend_comes_to_lie_on_the_drawn_row(
    curvature: float, driven: float, aside: float, yaw: float
) -> None:
    """Whoever is `aside` of the bend, by the direction there, is that much aside of the drawn row afterwards."""
    bend = RowBend(ROW, 4.0, curvature)
    there = SE2(4.0 + driven, 0.5 * curvature * driven**2, curvature * driven)
    robot = ROW.pose(there @ SE2(0.0, aside, yaw))
    at = ROW.coordinates(bend.step(robot) @ robot)
    assert at.y == pytest.approx(aside, abs=0.004)  # m; the arc turns a little between robot and row
    assert at.yaw == pytest.approx(yaw, abs=0.01)  # rad


def test_a_row_that_is_straight_from_here_on_leaves_the_path_where_the_robot_is() -> None:
    anchor, odom = PathAnchor(SE2(), PathAnchorParams()), ROW.pose(SE2(3.0, 0.0, 0.0))
    anchor.see_row(ROW, odom, offset=0.0, heading=0.0, noise=NOISE, curvature=0.08)
    further = odom @ SE2.arc(0.4, 0.032)
    anchor.straighten(further)
    at = ROW.coordinates(anchor.T_map_odom @ further)
    assert anchor.bend is None
    assert (at.y, at.yaw) == pytest.approx((0.0, 0.0), abs=0.001)  # m, rad
    before = anchor.T_map_odom
    anchor.straighten(further)
    assert anchor.T_map_odom == before


def test_a_camera_alone_tells_no_bend() -> None:
    anchor, odom = PathAnchor(SE2(), PathAnchorParams()), ROW.pose(SE2(3.0, 0.0, 0.0))
    anchor.see_row(ROW, odom, offset=0.0, heading=0.0, noise=NOISE)
    assert anchor.bend is None
    assert math.isfinite(anchor.T_map_odom.x)

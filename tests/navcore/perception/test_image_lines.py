"""Lines in the image, and the published reading of their bisector."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import robot_camera
from navcore.perception.image_lines import driving_camera, image_bisector, image_line, published_reading

CAMERA = robot_camera()


def test_the_bisector_of_a_centred_robot_is_the_vertical_through_the_middle() -> None:
    """The published formula divides by k1 + k2, which is zero here."""
    left, right = (image_line(CAMERA, offset=y, heading=0.0) for y in (1.5, -1.5))
    bisector = image_bisector(left, right)
    assert bisector is not None
    assert bisector.x_at(300.0) == pytest.approx(320.0, abs=1e-6)  # px
    assert published_reading(bisector, CAMERA, 1.0) == pytest.approx((0.0, 0.0), abs=1e-9)


@given(y=st.floats(-0.8, 0.8), heading_deg=st.floats(-15.0, 15.0))
def test_the_bisector_passes_through_the_intersection_with_equal_angles(y: float, heading_deg: float) -> None:
    heading = math.radians(heading_deg)
    left, right = (image_line(CAMERA, offset=y + s * 1.5, heading=heading) for s in (1, -1))
    bisector = image_bisector(left, right)
    meet = left.intersection(right)
    assert bisector is not None
    assert meet is not None
    assert bisector.distance(*meet) == pytest.approx(0.0, abs=1e-6)  # px
    to_left = math.remainder(bisector.heading - left.heading, math.tau)
    to_right = math.remainder(right.heading - bisector.heading, math.tau)
    assert to_left == pytest.approx(to_right, abs=1e-9)


def test_the_published_slope_formula_agrees_where_it_is_defined() -> None:
    left, right = image_line(CAMERA, offset=1.2, heading=0.02), image_line(CAMERA, offset=-1.8, heading=0.02)
    k1, k2 = (-line.nx / line.ny for line in (left, right))
    root = math.hypot(k1 * k2 - 1, k1 + k2)
    bisector = image_bisector(left, right)
    assert bisector is not None
    k3 = -bisector.nx / bisector.ny
    published = [(k1 * k2 - 1 + sign * root) / (k1 + k2) for sign in (1, -1)]
    assert min(abs(k3 - k) for k in published) < 1e-6 * abs(k3)


def test_vertical_lines_have_a_bisector() -> None:
    left, right = (Line2.through((u, 300.0), (u, 200.0)) for u in (100.0, 200.0))
    bisector = image_bisector(left, right)
    assert bisector is not None
    assert bisector.x_at(50.0) == pytest.approx(150.0)  # px


def test_the_bisector_reads_far_less_than_the_offset_on_the_ground() -> None:
    """0.30 m off in a corridor of 3 m reads about 0.07 m at the published look-ahead: the trap of the method."""
    left, right = (image_line(CAMERA, offset=0.3 + s * 1.5, heading=0.0) for s in (1, -1))
    bisector = image_bisector(left, right)
    assert bisector is not None
    reading = published_reading(bisector, CAMERA, 1.0)
    assert reading is not None
    assert 0.03 < reading[0] < 0.12  # m, positive to the left as the line is


@given(offset=st.floats(-3.0, 3.0), heading=st.floats(-0.3, 0.3))
def test_image_lines_lie_on_the_ground_line_they_come_from(offset: float, heading: float) -> None:
    line = image_line(CAMERA, offset=offset, heading=heading)
    pixel = np.array([[line.x_at(200.0), 200.0]])
    (x, y), *_ = CAMERA.ground(pixel)
    assert -math.sin(heading) * x + math.cos(heading) * y == pytest.approx(offset, abs=1e-6)  # m


def test_a_rear_camera_looks_ahead_in_its_driving_frame() -> None:
    rear = driving_camera(robot_camera(rear=True))
    assert (rear.x, rear.yaw) == pytest.approx((CAMERA.x, 0.0))
    assert rear.project(np.array([[5.0, 1.0, 0.0]])) == pytest.approx(CAMERA.project(np.array([[5.0, 1.0, 0.0]])))

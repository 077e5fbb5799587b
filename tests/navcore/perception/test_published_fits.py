"""Paper A's three fits of a side, as published."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.errors import ConfigError
from navcore.geometry.pinhole import robot_camera
from navcore.perception.corner_points import CornerPoints, corner_points
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.image_lines import image_line
from navcore.perception.least_squares import LeastSquares, fit_side
from navcore.perception.row_lines import RowCue
from navcore.perception.row_ransac import Ransac, RansacParams, best_inliers
from navcore.perception.temporal_ransac import SlopeCheckParams, TemporalRansac, reference_lines
from tests.navcore.perception.corridor_views import boxes_at

CAMERA = robot_camera()


def side_points(*extra: tuple[float, float]) -> CornerPoints:
    """Points on both sides of a corridor, and more on the left."""
    feet = np.array([(x, s * 1.5) for x in (3.0, 4.0, 5.0, 6.5, 8.0) for s in (1, -1)])
    pixels = CAMERA.project(np.column_stack((feet, np.zeros(len(feet)))))
    points = np.concatenate((pixels, np.array(extra).reshape(-1, 2)))
    return CornerPoints(points=points, feet=points, left=points[:, 0] < 320)


def angle_deg(a: float, b: float) -> float:
    return abs(math.degrees(math.remainder(a - b, math.tau)))


def test_corner_points_face_the_corridor() -> None:
    objects = boxes_at(CAMERA, np.array([[5.0, 1.5], [5.0, -1.5]]))
    corners = corner_points(objects, CAMERA.width_px, CAMERA.height_px)
    left = next(o for o in objects if o.x1 < 320)
    right = next(o for o in objects if o.x1 > 320)
    assert corners.points[corners.left].tolist() == [[left.x2, left.y2]]
    assert corners.points[~corners.left].tolist() == [[right.x1, right.y2]]


def test_the_filter_is_narrow_far_away_and_wide_nearby() -> None:
    params = GeometricFilterParams(k1=0.3, k2=0.7, k3=0.1, k4=0.9, k5=0.6)
    points = np.array([[100.0, 150.0], [320.0, 150.0], [100.0, 300.0], [30.0, 300.0]])
    mask = geometric_filter(points, width_px=640, height_px=360, params=params)
    assert mask.tolist() == [False, True, True, False]


def test_a_filter_without_room_is_refused() -> None:
    with pytest.raises(ConfigError, match="k1 < k2"):
        GeometricFilterParams(k1=0.7, k2=0.3)


def test_least_squares_finds_clean_lines_and_one_outlier_bends_it() -> None:
    reference = reference_lines(CAMERA, 3.0)[0]
    clean = LeastSquares().fit(side_points(), RowCue())
    bent = LeastSquares().fit(side_points((60.0, 160.0)), RowCue())
    assert clean.left is not None
    assert bent.left is not None
    assert angle_deg(clean.left.heading, reference.heading) < 0.1
    assert angle_deg(bent.left.heading, reference.heading) > 5.0


def test_ransac_ignores_the_outlier_that_bends_least_squares() -> None:
    lines = Ransac(RansacParams(), width_px=640).fit(side_points((60.0, 160.0)), RowCue())
    assert lines.left is not None
    assert angle_deg(lines.left.heading, reference_lines(CAMERA, 3.0)[0].heading) < 0.5
    assert lines.kept.tolist() == [True] * 10 + [False]


def test_ransac_needs_the_iterations_that_the_paper_gives() -> None:
    assert RansacParams().theoretical_iterations == 49


def test_ransac_refuses_a_line_that_too_few_points_support() -> None:
    rng = np.random.default_rng(3)
    points = rng.uniform(0, 300, (30, 2))
    assert not best_inliers(points, 0.5, RansacParams(), np.random.default_rng(2024)).any()


def test_ransac_of_the_same_points_is_the_same_whatever_came_before() -> None:
    rng = np.random.default_rng(3)
    points = rng.uniform(0, 320, (20, 2))
    noisy = CornerPoints(points=points, feet=points, left=np.ones(20, bool))
    ransac = Ransac(RansacParams(), width_px=640)
    first = ransac.fit(noisy, RowCue())
    ransac.fit(side_points(), RowCue())
    assert ransac.fit(noisy, RowCue()).left == first.left


def test_a_side_with_one_point_has_no_line() -> None:
    assert fit_side(np.array([[1.0, 2.0]])) is None


def test_a_line_that_fails_the_slope_check_is_replaced_by_the_previous_frames() -> None:
    fitter = TemporalRansac(LeastSquares(), CAMERA, SlopeCheckParams())
    before = fitter.fit(side_points(), RowCue())
    after = fitter.fit(side_points((60.0, 160.0)), RowCue())
    assert after.left == before.left
    assert (after.left_seen, after.right_seen) == (False, True)


def test_as_published_the_memory_has_no_age() -> None:
    fitter = TemporalRansac(LeastSquares(), CAMERA, SlopeCheckParams())
    before = fitter.fit(side_points(), RowCue())
    none = CornerPoints(points=np.zeros((0, 2)), feet=np.zeros((0, 2)), left=np.zeros(0, bool))
    for _ in range(50):
        lines = fitter.fit(none, RowCue())
    assert (lines.left, lines.right) == (before.left, before.right)
    fitter.forget()
    assert fitter.fit(none, RowCue()).reason == "no line of plants on either side"


def test_reference_lines_are_the_sides_of_a_centred_corridor() -> None:
    left, right = reference_lines(CAMERA, 3.0)
    assert left == image_line(CAMERA, offset=1.5, heading=0.0)
    assert left.nx == pytest.approx(right.nx)
    assert left.ny == pytest.approx(-right.ny)

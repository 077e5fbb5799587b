"""What is drawn, by compiled arithmetic, is what the camera itself would show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.perception.drawing_kernels import ahead, band, image_line, pixel, scan

seeds = st.integers(0, 10_000)


def camera_of(rng: np.random.Generator) -> PinholeCamera:
    """Of any mount that looks ahead."""
    roll, pitch, yaw = rng.uniform(-0.2, 0.2, 3)
    return replace(robot_camera(), y=0.1, roll=roll, pitch=0.1 + pitch, yaw=yaw)


@settings(deadline=None)
@given(seeds)
def test_a_point_is_seen_where_the_camera_projects_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    camera, (x, y, z) = camera_of(rng), rng.uniform(-5.0, 5.0, 3)
    told = pixel(x, y, z, camera.compiled())
    assert told == pytest.approx(camera.project(np.array(((x, y, z),)))[0], rel=1e-9, nan_ok=True)


@settings(deadline=None)
@given(seeds, st.floats(-3.0, 3.0), st.floats(-0.5, 0.5))
def test_a_lines_image_goes_through_the_images_of_its_points(seed: int, offset: float, heading: float) -> None:
    camera = camera_of(np.random.default_rng(seed))
    nx, ny, far = image_line(offset, heading, camera.compiled())
    at = SE2(0.0, 0.0, heading)
    points = np.array([(*at.apply_point(x, offset), 0.0) for x in (3.0, 5.0, 9.0)])
    pixels = camera.project(points)
    seen = np.isfinite(pixels[:, 0])
    assert nx**2 + ny**2 == pytest.approx(1.0)
    assert pixels[seen] @ (nx, ny) == pytest.approx(np.full(np.count_nonzero(seen), far), abs=1e-6)  # pixels


@settings(deadline=None)
@given(seeds, st.integers(0, 30))
def test_a_scans_ends_are_drawn_where_they_lie_now_and_only_within_the_picture(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    camera, ends, pose = camera_of(rng), rng.uniform(-6.0, 6.0, (n, 3)), SE2(*rng.uniform(-0.5, 0.5, 3))
    ends[:, 2] = 0.55
    pixels, above = scan(ends, (pose.x, pose.y, pose.yaw), camera.compiled(), camera.width_px, camera.height_px)
    now = pose.apply(ends[:, :2])
    seen = camera.project(np.column_stack((now, ends[:, 2])))
    inside = np.all((seen >= 0.0) & (seen < (camera.width_px, camera.height_px)), axis=1)
    assert above == pytest.approx(now, abs=0.005 + 1e-9)  # m
    assert pixels == pytest.approx(seen[inside], abs=0.05 + 1e-9)  # pixels
    assert np.round(pixels, 1) == pytest.approx(pixels, abs=1e-12)


def test_of_a_wall_close_by_no_two_ends_are_drawn_on_one_another_and_none_is_missed() -> None:
    camera = camera_of(np.random.default_rng(1))
    wall = np.column_stack((np.full(1601, 2.0), np.linspace(-1.0, 1.0, 1601), np.full(1601, 0.55)))
    pixels, above = scan(wall, (0.0, 0.0, 0.0), camera.compiled(), camera.width_px, camera.height_px)
    assert 55 <= len(above) <= 67  # 2 m
    assert np.abs(wall[:, 1, None] - above[:, 1]).min(axis=1).max() < 0.03 + 0.005  # m
    assert len(pixels) > 100
    assert np.hypot(*np.diff(pixels, axis=0).T).min() > 1.0 - 0.15  # pixels, told in tenths


@settings(deadline=None)
@given(seeds)
def test_image_rows_show_ground_as_far_ahead_as_the_camera_says(seed: int) -> None:
    camera = camera_of(np.random.default_rng(seed))
    rows = np.linspace(360.0, -200.0, 9)
    told = camera.ground(np.column_stack((np.full(9, camera.cx), rows)))[:, 0]
    assert ahead(camera.compiled(), rows) == pytest.approx(told[np.isfinite(told)], rel=1e-9)


@settings(deadline=None)
@given(seeds, st.floats(-2.0, 2.0), st.floats(-0.2, 0.2))
def test_a_band_goes_out_along_one_edge_and_back_along_the_other(seed: int, offset: float, heading: float) -> None:
    camera, x = camera_of(np.random.default_rng(seed)), np.array((2.0, 4.0, 9.0))
    variances = (0.05**2, -0.3 * 0.05 * 0.01, 0.01**2)
    wide = 2.0 * np.sqrt(variances[0] + 2.0 * x * variances[1] + x**2 * variances[2])
    y = (offset + x * np.sin(heading)) / np.cos(heading)
    there, back = np.column_stack((x, y + wide)), np.column_stack((x, y - wide))[::-1]
    seen = camera.project(np.column_stack((np.vstack((there, back)), np.zeros(6))))
    told = band(camera.compiled(), x, (offset, heading), variances, 2.0)
    assert told == pytest.approx(seen[np.isfinite(seen[:, 0])], abs=0.05 + 1e-9)  # pixels

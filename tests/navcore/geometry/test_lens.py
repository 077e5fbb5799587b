"""A lens bends pixels, and what it bent can be told back, or is refused."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.intrinsics import Intrinsics, intrinsics_of
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import robot_camera

CAMERA = Intrinsics(width_px=1280, height_px=720, fx=639.3, fy=635.2, cx=660.3, cy=363.3)
BARREL = Lens(k1=-0.055, k2=0.032, p1=0.0006, p2=-0.0004, k3=-0.011)

pixels_inside = st.lists(
    st.tuples(st.floats(0.0, 1279.0), st.floats(0.0, 719.0)), min_size=1, max_size=8
).map(np.array)  # fmt: skip
lenses = st.builds(
    Lens, k1=st.floats(-0.09, 0.12), k2=st.floats(-0.002, 0.03), p1=st.floats(-0.002, 0.002),
    p2=st.floats(-0.002, 0.002), k3=st.floats(-0.002, 0.01),
)  # fmt: skip
wild_lenses = st.builds(Lens, k1=st.floats(-2.0, 2.0), k2=st.floats(-2.0, 2.0), k3=st.floats(-2.0, 2.0))


@given(lenses, pixels_inside)
def test_what_is_bent_is_straightened_back(lens: Lens, pixels: np.ndarray) -> None:
    bent = lens.distort(pixels, CAMERA)
    assert lens.undistort(bent, CAMERA) == pytest.approx(pixels, abs=1e-6)  # px


@given(lenses, pixels_inside)
def test_what_is_straightened_is_bent_back(lens: Lens, pixels: np.ndarray) -> None:
    assert lens.distort(lens.undistort(pixels, CAMERA), CAMERA) == pytest.approx(pixels, abs=1e-6)  # px


@given(wild_lenses, pixels_inside)
def test_any_lens_is_undone_or_refused(lens: Lens, pixels: np.ndarray) -> None:
    try:
        straight = lens.undistort(pixels, CAMERA)
    except InputError:
        return
    assert lens.distort(straight, CAMERA) == pytest.approx(pixels, abs=1e-6)  # px


def test_a_lens_bends_as_opencv_does() -> None:
    pixels = np.random.default_rng(1).uniform((0, 0), CAMERA.size, (200, 2))
    rays = np.column_stack((CAMERA.rays(pixels), np.ones(200)))
    theirs, _ = cv2.projectPoints(rays, np.zeros(3), np.zeros(3), CAMERA.K, np.array(BARREL.coefficients))
    assert BARREL.distort(pixels, CAMERA) == pytest.approx(theirs.reshape(-1, 2), abs=1e-9)  # px


def test_a_pixel_that_the_lens_never_shows_is_refused() -> None:
    folding = Lens(k1=-0.4)  # r (1 - 0.4 r^2) is nowhere above 0.61; the corner asks for 1.17
    with pytest.raises(InputError, match=r"no straight ray at 1 of 2 pixels.*Calibrate again"):
        folding.undistort(np.array([[640.0, 360.0], [0.0, 0.0]]), CAMERA)


def test_no_lens_bends_nothing() -> None:
    pixels = np.array([[3.0, 4.0]])
    assert not Lens().bends
    assert Lens().undistort(pixels, CAMERA) == pytest.approx(pixels, abs=1e-12)  # px


@pytest.mark.parametrize("wrong", [float("nan"), float("inf")])
def test_nan_is_refused(wrong: float) -> None:
    with pytest.raises(NotFiniteError):
        Lens(k1=wrong)
    with pytest.raises(NotFiniteError):
        BARREL.undistort(np.array([[wrong, 0.0]]), CAMERA)
    with pytest.raises(NotFiniteError):
        Intrinsics(width_px=640, height_px=360, fx=wrong, fy=1.0, cx=0.0, cy=0.0)


def test_a_focal_length_of_zero_is_refused() -> None:
    with pytest.raises(InputError, match="above 0"):
        Intrinsics(width_px=640, height_px=360, fx=0.0, fy=1.0, cx=0.0, cy=0.0)


def test_the_robots_camera_has_these_intrinsics_too() -> None:
    camera = robot_camera()
    point = np.array([[5.0, 0.4, 0.2]])
    seen = (point - (camera.x, camera.y, camera.z)) @ camera.R_base_camera()
    assert intrinsics_of(camera).pixels(seen[:, :2] / seen[:, 2:]) == pytest.approx(camera.project(point), abs=1e-9)

"""Intrinsics come back with honest errors, and pictures that tell none are refused with what to do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from navcore.calibration.board import BoardSighting
from navcore.calibration.coverage import CoverageParams, missing_poses
from navcore.calibration.intrinsics import CameraIntrinsics, IntrinsicsParams, calibrate_intrinsics
from navcore.calibration.intrinsics_fit import board_pose, pose_residuals, rms_px
from navcore.errors import CalibrationError, NotFiniteError
from navcore.sim.board_poses import BoardPoseParams, board_rotation
from tests.navcore.calibration.boards import CAMERA, LENS, Floats, corners_seen, facing, sightings

PARAMS = IntrinsicsParams()
TRUE = {
    "fx": CAMERA.fx, "fy": CAMERA.fy, "cx": CAMERA.cx, "cy": CAMERA.cy, "k1": LENS.k1, "k2": LENS.k2, "p1": LENS.p1,
    "p2": LENS.p2, "k3": LENS.k3,
}  # fmt: skip


@pytest.fixture(scope="module")
def good() -> CameraIntrinsics:
    return calibrate_intrinsics(sightings(20, 5), PARAMS)


def upside_down(sighting: BoardSighting) -> BoardSighting:
    return replace(sighting, name="upside down", pixels=np.array(sighting.size) - 1.0 - sighting.pixels)


def tilted(depth: float, about_width_deg: float, about_height_deg: float) -> BoardSighting:
    a, b = np.radians((about_width_deg, about_height_deg))
    Rx = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    Ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    T = facing(depth)
    T[:3, :3] = Ry @ Rx
    return corners_seen(T, np.random.default_rng(1))


def test_the_camera_comes_back_within_its_stated_errors(good: CameraIntrinsics) -> None:
    found = {"fx": good.camera.fx, "fy": good.camera.fy, "cx": good.camera.cx, "cy": good.camera.cy}
    found |= dict(zip(("k1", "k2", "p1", "p2", "k3"), good.lens.coefficients, strict=True))
    off = [(found[name] - TRUE[name]) / good.std[name] for name in TRUE]
    assert np.abs(off).max() < 4.0  # sigmas
    assert found["fx"] == pytest.approx(CAMERA.fx, rel=0.002)
    assert good.thrown_out == ()


def test_pictures_left_out_are_explained_almost_as_by_the_true_camera(good: CameraIntrinsics) -> None:
    floor = rms_px([pose_residuals(s, CAMERA, LENS) for s in good.sightings])
    assert good.left_out_px == pytest.approx(floor, rel=0.05)
    assert good.rms_px < good.left_out_px
    assert [p.name for p in good.pictures] == [f"pose {k}" for k in range(20)]


def test_stated_errors_are_those_of_many_calibrations() -> None:
    fits = [calibrate_intrinsics(sightings(16, seed), replace(PARAMS, folds=2)) for seed in range(20, 32)]
    off = [(f.camera.fx - CAMERA.fx) / f.std["fx"] for f in fits] + [
        (f.camera.cy - CAMERA.cy) / f.std["cy"] for f in fits
    ]
    assert 0.6 < np.sqrt(np.mean(np.square(off))) < 1.5  # sigmas


def test_an_upside_down_picture_is_thrown_out_and_named() -> None:
    boards = sightings(20, 6)
    boards[4] = upside_down(boards[4])
    found = calibrate_intrinsics(boards, PARAMS)
    assert [name for name, _ in found.thrown_out] == ["upside down"]
    assert "stands out" in found.thrown_out[0][1]
    assert found.camera.fx == pytest.approx(CAMERA.fx, rel=0.003)


def test_pictures_of_two_cameras_contradict_each_other() -> None:
    boards = sightings(20, 7)
    half = np.array(CAMERA.size) / 2
    boards[::2] = [replace(s, pixels=half + 1.25 * (s.pixels - half)) for s in boards[::2]]
    with pytest.raises(CalibrationError, match=r"contradict each other.*flat"):
        calibrate_intrinsics(boards, PARAMS)


def test_many_wrong_pictures_are_refused_by_name() -> None:
    boards = sightings(20, 7)
    boards[:9] = [replace(s, pixels=s.pixels + np.arange(80).reshape(40, 2) % 7) for s in boards[:9]]
    with pytest.raises(CalibrationError, match=r"contradict each other.*pose \d"):
        calibrate_intrinsics(boards, replace(PARAMS, most_thrown_out=0.1))


@pytest.mark.parametrize(("count", "words"), [(0, "0 pictures show"), (1, "1 picture shows"), (5, "5 pictures show")])
def test_too_few_poses_are_refused(count: int, words: str) -> None:
    with pytest.raises(CalibrationError, match=words):
        calibrate_intrinsics(sightings(count, 1), PARAMS)


def test_identical_poses_count_once() -> None:
    T, rng = facing(0.3), np.random.default_rng(1)
    with pytest.raises(CalibrationError, match=r"1 picture shows the board in a place of its own, 19 more"):
        calibrate_intrinsics([corners_seen(T, rng) for _ in range(20)], PARAMS)


def test_parallel_boards_tell_no_focal_length() -> None:
    flat = BoardPoseParams(nearest=0.3, furthest=0.6, tilt_deg=0.5)
    with pytest.raises(CalibrationError, match=r"Tilt the board"):
        calibrate_intrinsics(sightings(20, 1, flat), PARAMS)


def test_pictures_of_two_sizes_are_refused() -> None:
    boards = sightings(12, 1)
    boards[3] = replace(boards[3], width_px=1280, height_px=720)
    with pytest.raises(CalibrationError, match="1280x720, 640x360"):
        calibrate_intrinsics(boards, PARAMS)


def test_nan_is_refused() -> None:
    boards = sightings(12, 1)
    boards[3].pixels[2, 0] = np.nan
    with pytest.raises(NotFiniteError):
        calibrate_intrinsics(boards, PARAMS)


@pytest.mark.parametrize("seed", range(5))
def test_a_boards_pose_comes_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    T: Floats = facing(0.4, x=0.05, y=-0.03)
    T[:3, :3] = board_rotation(rng, 40.0, 180.0)
    assert board_pose(corners_seen(T, rng, std_px=1e-6), CAMERA, LENS) == pytest.approx(T, abs=1e-5)  # m, -


def test_nothing_seen_misses_everything_and_a_good_set_nothing() -> None:
    nothing = missing_poses([], CAMERA.size, CoverageParams())
    assert nothing.share == 0.0
    assert len(nothing.missing) == 19
    near = BoardPoseParams(nearest=0.18, furthest=0.6, spread=1.0, edge_px=2.0, turn_deg=180.0)
    full = missing_poses(sightings(120, 3, near), CAMERA.size, CoverageParams())
    assert full.missing == ()
    assert full.share == 1.0


@pytest.mark.parametrize(
    ("about_width_deg", "about_height_deg", "edge"),
    [(-30, 0, "lower"), (30, 0, "upper"), (0, 30, "right"), (0, -30, "left")],
)
def test_the_tilt_that_is_there_is_not_asked_for(about_width_deg: float, about_height_deg: float, edge: str) -> None:
    seen = tilted(0.35, about_width_deg, about_height_deg)
    T = board_pose(seen, CAMERA, LENS)
    outline = np.array([[0, -0.1, 0], [0, 0.1, 0], [-0.1, 0, 0], [0.1, 0, 0]]) @ T[:3, :3].T
    nearest = ("upper", "lower", "left", "right")[int(np.argmin(outline[:, 2]))]
    assert nearest == edge
    wishes = missing_poses([seen, seen], CAMERA.size, CoverageParams()).missing
    asked = [e for e in ("upper", "lower", "left", "right") if any(f"bring its {e} edge" in w for w in wishes)]
    assert asked == [e for e in ("upper", "lower", "left", "right") if e != edge]


def test_an_empty_part_of_the_picture_is_named() -> None:
    wishes = missing_poses(
        [corners_seen(facing(0.4, x=-0.1), np.random.default_rng(1))], CAMERA.size, CoverageParams()
    ).missing
    assert "Show the board in the upper left of the picture." in wishes
    assert "Show the board in the middle left middle of the picture." not in wishes

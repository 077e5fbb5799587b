"""The mount of camera and LiDAR comes back with honest errors, and poses that tell none are refused."""

from __future__ import annotations

import math
from dataclasses import replace

import cv2
import numpy as np
import pytest

from navcore.calibration.board_on_scan import moved, outside
from navcore.calibration.board_run import BoardRunParams, find_board, plain_scan, plane_cut
from navcore.calibration.centre_pnp import centre_pnp
from navcore.calibration.extrinsics import (
    BoardPair,
    ExtrinsicsParams,
    LidarCamera,
    calibrate_extrinsics,
    rough_mount,
)
from navcore.calibration.intrinsics_fit import board_pose
from navcore.errors import CalibrationError, InputError, NotFiniteError
from navcore.sim.board_poses import BoardPoseParams, BoardPoses
from navcore.sim.board_scans import BoardScanParams, BoardScans
from tests.navcore.calibration.boards import BOARD, CAMERA, LENS, Floats, corners_seen

# Paper B's mount, and a camera that looks 2 deg down and 3 deg to the left.
TRUE = moved(rough_mount(0.075, 0.029, -0.096), np.array([0, 0, 0, 0.0, math.radians(2), math.radians(3)]))
HELD = BoardPoseParams(nearest=0.5, furthest=1.2, tilt_deg=45.0, turn_deg=60.0)
TRUE_INVERSE: Floats = np.asarray(np.linalg.inv(TRUE), dtype=np.float64)
PARAMS = ExtrinsicsParams()


def pairs(n: int, seed: int, held: BoardPoseParams = HELD, scan: BoardScanParams | None = None) -> list[BoardPair]:
    rng = np.random.default_rng(seed)
    poses = BoardPoses(CAMERA, LENS, BOARD, held)
    drawn = [poses.draw_before_lidar(rng, TRUE_INVERSE, 0.05) for _ in range(n)]
    return [pair(T, rng, f"pose {k}", scan) for k, T in enumerate(drawn)]


def pair(T: Floats, rng: np.random.Generator, name: str, scan: BoardScanParams | None = None) -> BoardPair:
    rays = BoardScans(BOARD, scan or BoardScanParams()).scan(TRUE @ T, rng)
    return BoardPair(sighting=corners_seen(T, rng, name=name), scan=plain_scan(*rays))


def calibrated(seen: list[BoardPair], params: ExtrinsicsParams = PARAMS) -> LidarCamera:
    return calibrate_extrinsics(seen, BOARD, CAMERA, LENS, rough_mount(), params)


def off(found: Floats) -> Floats:
    """(6,) m and rad, about the LiDAR's axes."""
    turn, _ = cv2.Rodrigues(found[:3, :3] @ TRUE[:3, :3].T)
    return np.concatenate((found[:3, 3] - TRUE[:3, 3], turn.ravel()))


@pytest.fixture(scope="module")
def good() -> list[BoardPair]:
    return pairs(25, 3)


def test_the_mount_comes_back_from_a_rough_start(good: list[BoardPair]) -> None:
    found = calibrated(good)
    error = off(found.T_lidar_camera)
    assert np.linalg.norm(error[:3]) < 0.005  # m
    assert np.linalg.norm(error[3:]) < math.radians(0.3)  # rad
    assert np.abs(error / np.sqrt(np.diag(found.covariance))).max() < 4.0  # sigmas
    assert len(found.poses) + len(found.thrown_out) == 25
    assert len(found.poses) >= 22


def test_stated_errors_are_those_of_many_calibrations() -> None:
    ratios = []
    for seed in range(30, 40):
        found = calibrated(pairs(15, seed), replace(PARAMS, worst_position=0.05, worst_angle_deg=5.0))
        ratios.append(off(found.T_lidar_camera) / np.sqrt(np.diag(found.covariance)))
    assert 0.5 < np.sqrt(np.mean(np.square(ratios))) < 1.5  # sigmas


def test_the_plates_edges_tell_the_height_where_boards_are_hardly_tilted() -> None:
    any_std = replace(PARAMS, worst_position=1.0, worst_angle_deg=90.0)
    no_edges = replace(any_std, residuals=replace(PARAMS.residuals, edge_std=10.0))
    heights = []
    for seed in range(1, 5):
        seen = pairs(20, seed, replace(HELD, tilt_deg=20.0))
        heights.append([off(calibrated(seen, params).T_lidar_camera)[2] for params in (any_std, no_edges)])
    with_edges, without = np.sqrt(np.mean(np.square(heights), axis=0))
    assert with_edges < 0.004  # m
    assert with_edges < 0.7 * without


def test_the_published_pnp_finds_the_mount_where_nothing_is_noisy() -> None:
    rng = np.random.default_rng(1)
    points = rng.uniform((0.5, -0.4), (2.0, 0.4), (20, 2))
    at = np.column_stack((points, np.zeros(20), np.ones(20))) @ TRUE_INVERSE.T
    pixels = CAMERA.pixels(LENS.bend(at[:, :2] / at[:, 2:3]))
    assert np.abs(off(centre_pnp(pixels, points, CAMERA, LENS))).max() < 1e-4  # m, rad


@pytest.mark.parametrize(
    ("points", "words"),
    [(np.zeros((3, 2)), "too few"), (np.column_stack((np.arange(8), np.arange(8))) * 0.1, "on one line")],
)
def test_the_published_pnp_refuses_what_tells_no_mount(points: Floats, words: str) -> None:
    with pytest.raises(CalibrationError, match=words):
        centre_pnp(np.zeros_like(points), points, CAMERA, LENS)


def test_an_upside_down_picture_is_thrown_out_and_named(good: list[BoardPair]) -> None:
    seen = list(good)
    turned = np.array(CAMERA.size) - 1.0 - seen[7].sighting.pixels
    seen[7] = replace(seen[7], sighting=replace(seen[7].sighting, pixels=turned))
    found = calibrated(seen)
    assert "pose 7" in dict(found.thrown_out)
    assert np.linalg.norm(off(found.T_lidar_camera)[:3]) < 0.006  # m


def test_scans_swapped_between_poses_are_thrown_out(good: list[BoardPair]) -> None:
    seen = list(good)
    seen[1], seen[2] = replace(seen[1], scan=good[2].scan), replace(seen[2], scan=good[1].scan)
    found = calibrated(seen)
    assert {"pose 1", "pose 2"} <= set(dict(found.thrown_out))


def test_a_single_pose_is_refused(good: list[BoardPair]) -> None:
    with pytest.raises(CalibrationError, match="1 pose of the board together; 6 are needed"):
        calibrated(good[:1])
    with pytest.raises(CalibrationError, match="0 different poses"):
        calibrated([])


def test_identical_poses_count_once() -> None:
    rng = np.random.default_rng(2)
    T = BoardPoses(CAMERA, LENS, BOARD, HELD).draw_before_lidar(rng, TRUE_INVERSE, 0.0)
    with pytest.raises(CalibrationError, match="1 pose of the board"):
        calibrated([pair(T, rng, f"pose {k}") for k in range(20)])


def test_parallel_boards_are_refused_with_what_to_do() -> None:
    rng = np.random.default_rng(2)
    T = BoardPoses(CAMERA, LENS, BOARD, HELD).draw_before_lidar(rng, TRUE_INVERSE, 0.0)
    T[:3, :3] = np.eye(3)
    shifted = []
    for k in range(12):
        moved_board = T.copy()
        moved_board[:3, 3] = 0.05 * (k % 4), -0.096, 0.6 + 0.1 * (k // 4)
        shifted.append(pair(moved_board, rng, f"pose {k}"))
    with pytest.raises(CalibrationError, match="All boards stand parallel: tilt it"):
        calibrated(shifted)


def test_a_mount_that_is_hardly_seen_is_refused(good: list[BoardPair]) -> None:
    with pytest.raises(CalibrationError, match=r"is known to .* only\. Take more poses"):
        calibrated(good[:12], replace(PARAMS, worst_position=1e-4))


def test_scans_without_the_board_are_refused_with_where_it_was_expected(good: list[BoardPair]) -> None:
    angles = np.radians(np.arange(0.0, 360.0, 0.5))
    empty = plain_scan(angles, np.full(len(angles), 5.0))
    with pytest.raises(CalibrationError, match=r"pose 3: the scan has no straight run .* m away at -?\d+ deg"):
        calibrated([replace(p, scan=empty) for p in good])


def test_another_picture_size_is_refused(good: list[BoardPair]) -> None:
    wrong = replace(good[0], sighting=replace(good[0].sighting, width_px=1280, height_px=720))
    with pytest.raises(CalibrationError, match="is 1280x720, the camera was calibrated at 640x360"):
        calibrated([wrong, *good[1:]])


def test_nan_is_refused(good: list[BoardPair]) -> None:
    with pytest.raises(NotFiniteError):
        plain_scan(np.array([0.0, math.nan]), np.ones(2))
    with pytest.raises(NotFiniteError):
        calibrate_extrinsics(good, BOARD, CAMERA, LENS, np.full((4, 4), math.nan), PARAMS)
    with pytest.raises(InputError, match="fewer than 10 rays"):
        plain_scan(np.arange(20.0), np.zeros(20))


def test_the_run_on_a_board_is_found_among_walls_and_a_person(good: list[BoardPair]) -> None:
    for p in good:
        T = TRUE @ board_pose(p.sighting, CAMERA, LENS)
        outline = BOARD.outline() @ T[:3, :3].T + T[:3, 3]
        run = find_board(p.scan, outline, BoardRunParams(), rough=False)
        if isinstance(run, str):
            continue
        cut = plane_cut(outline)
        assert cut is not None
        nearer = min(np.abs(run.ends - cut).max(), np.abs(run.ends - cut[::-1]).max())
        assert nearer < 0.02  # m


def test_several_turns_are_one_scan_with_more_rays() -> None:
    one, five = (calibrated(pairs(12, 4, scan=BoardScanParams(turns=turns))) for turns in (1, 5))
    assert sum(len(p.run.points) for p in five.poses) > 3 * sum(len(p.run.points) for p in one.poses)
    assert np.linalg.norm(five.position_std) < np.linalg.norm(one.position_std)


def test_distance_from_a_plates_edge_is_negative_inside() -> None:
    points = np.array([[0.0, 0.0], [0.1, 0.0], [0.13, 0.09], [0.0, 0.04]])
    assert outside(points, np.array([0.1, 0.05])) == pytest.approx([-0.05, 0.0, 0.05, -0.01])  # m

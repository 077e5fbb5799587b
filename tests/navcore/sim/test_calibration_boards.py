"""Rendered boards and their scans: the same by seed, and true where the truth is simple."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.calibration.board import Board
from navcore.errors import InputError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from navcore.sim.board_poses import BoardPoseParams, BoardPoses
from navcore.sim.board_scans import BoardScanParams, BoardScans

CAMERA = Intrinsics(width_px=320, height_px=180, fx=160.0, fy=160.0, cx=160.0, cy=90.0)
BOARD = Board()
FACING = np.eye(4)
FACING[2, 3] = 0.3
# Before a LiDAR that looks along x, 1 m away.
BEFORE_LIDAR = np.array([[0.0, 0, 1, 1], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
QUIET = BoardScanParams(range_std=0.0, resolution=0.0, lost=0.0, person=0.0)


def test_a_picture_is_the_same_by_seed_and_another_by_another() -> None:
    pictures = BoardPictures(CAMERA, Lens(k1=-0.05), BOARD, BoardPictureParams())
    one, again, other = (pictures.render(FACING, np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)


def test_noise_is_as_told() -> None:
    pictures = BoardPictures(CAMERA, Lens(), BOARD, BoardPictureParams(noise=4.0, gradient=0.0))
    wall = pictures.render(FACING, np.random.default_rng(1))[:40, :40, 0]
    assert wall.astype(float).std() == pytest.approx(4.0, rel=0.1)  # grey values


def test_the_first_square_is_black_and_its_neighbour_white() -> None:
    calm = BoardPictureParams(noise=0.0, gradient=0.0, blur_px=0.3)
    grey = BoardPictures(CAMERA, Lens(), BOARD, calm).render(FACING, np.random.default_rng(1))[:, :, 0]
    (u, v), step = CAMERA.pixels(BOARD.corners()[:1, :2] / 0.3)[0], 0.027 / 0.3 * 160.0
    assert grey[round(v - step / 2), round(u - step / 2)] < 40
    assert grey[round(v - step / 2), round(u + step / 2)] > 160


def test_rays_end_on_the_board_or_on_the_walls() -> None:
    scans = BoardScans(BOARD, QUIET)
    half = math.atan2(BOARD.plate[0] / 2, 1.0)
    distances = scans.true_distances(BEFORE_LIDAR, np.array([0.0, half - 1e-3, half + 1e-3, math.pi]))
    assert distances == pytest.approx([1.0, 1.0 / math.cos(half - 1e-3), 3.0 / math.cos(half + 1e-3), 3.0])  # m


def test_a_person_stands_behind_the_board() -> None:
    scans = BoardScans(BOARD, BoardScanParams(range_std=0.0, person=0.3))
    beside = scans.true_distances(BEFORE_LIDAR, np.array([math.atan2(BOARD.plate[0] / 2, 1.0) + 0.01]))
    assert 1.2 < beside[0] < 1.7  # m


def test_range_noise_and_lost_rays_are_as_told() -> None:
    far = BEFORE_LIDAR.copy()
    far[:3, 3] = 0.0, 0.0, 9.0  # above the LiDAR's plane
    angles, distances = BoardScans(BOARD, BoardScanParams(turns=4, lost=0.1, person=0.0)).scan(
        far, np.random.default_rng(1)
    )  # fmt: skip
    hit = distances > 0.0
    assert len(angles) == 4 * 1600
    assert np.mean(~hit) == pytest.approx(0.1, abs=0.02)  # share
    true = 3.0 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    assert np.std(distances[hit] - true[hit]) == pytest.approx(0.01, rel=0.1)  # m


def test_poses_are_seen_whole_and_impossible_ones_refused() -> None:
    poses = BoardPoses(CAMERA, Lens(), BOARD, BoardPoseParams())
    rng = np.random.default_rng(1)
    assert all(poses.seen_whole(poses.draw(rng)) for _ in range(20))
    with pytest.raises(InputError, match="Hold it further away"):
        BoardPoses(CAMERA, Lens(), BOARD, BoardPoseParams(nearest=0.05, furthest=0.06)).draw(rng)

"""Rendered boards that the calibration tests share. Seeds below 1000."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.sim.board_poses import BoardPoseParams, BoardPoses

Floats = NDArray[np.float64]

CAMERA = Intrinsics(width_px=640, height_px=360, fx=319.7, fy=317.6, cx=330.1, cy=171.6)
LENS = Lens(k1=-0.055, k2=0.032, p1=0.0006, p2=-0.0004, k3=-0.011)
BOARD = Board()
CORNER_PX = 0.05


def facing(depth: float, *, x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> Floats:
    """T_camera_board of a board that faces the camera, turned in its plane, rad."""
    c, s = math.cos(turn), math.sin(turn)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, depth], [0, 0, 0, 1]])


def corners_seen(
    T_camera_board: Floats, rng: np.random.Generator, *, name: str = "", camera: Intrinsics = CAMERA,
    lens: Lens = LENS, board: Board = BOARD, std_px: float = CORNER_PX,
) -> BoardSighting:  # fmt: skip
    """The board's corners at that pose with noise, as a detector would give them."""
    points = board.corners()
    at = points @ T_camera_board[:3, :3].T + T_camera_board[:3, 3]
    pixels = camera.pixels(lens.bend(at[:, :2] / at[:, 2:])) + std_px * rng.standard_normal((len(points), 2))
    return BoardSighting(
        name=name, width_px=camera.width_px, height_px=camera.height_px, ids=np.arange(len(points)), points=points,
        pixels=pixels, edge_px=2.0,
    )  # fmt: skip


def sightings(n: int, seed: int, params: BoardPoseParams | None = None) -> list[BoardSighting]:
    """Of `n` random poses, named pose 0, pose 1 ..."""
    rng = np.random.default_rng(seed)
    poses = BoardPoses(CAMERA, LENS, BOARD, params or BoardPoseParams(nearest=0.2, furthest=0.6))
    return [corners_seen(poses.draw(rng), rng, name=f"pose {k}") for k in range(n)]

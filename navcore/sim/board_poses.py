"""How a person holds a calibration board before a camera: random poses that the camera sees whole."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board
from navcore.errors import InputError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy

Floats = NDArray[np.float64]
TRIES = 2000


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardPoseParams:
    """Where boards are held.

    Attributes:
        nearest, furthest: distance of the board's middle from the camera, m; 0 < nearest <= furthest.
        tilt_deg: largest tilt about the board's width and about its height each; 0 to 60.
        turn_deg: largest turn in its own plane; 0 to 180.
        edge_px: the pattern stays so far from the picture's edges; >= 0.
        spread: how much of the picture the middles of the boards reach, share from the middle; 0 to 1.
    """

    nearest: float = 0.25
    furthest: float = 0.9
    tilt_deg: float = 40.0
    turn_deg: float = 25.0
    edge_px: float = 8.0
    spread: float = 0.9


class BoardPoses:
    """Poses before one camera."""

    def __init__(self, camera: Intrinsics, lens: Lens, board: Board, params: BoardPoseParams) -> None:
        self._camera, self._lens, self._board, self._params = camera, lens, board, params
        wide, high = board.pattern
        self._extent = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * (wide / 2, high / 2, 0.0)

    def draw(self, rng: np.random.Generator) -> Floats:
        """One T_camera_board (4, 4). Raises InputError if the board never fits into the picture."""
        for _ in range(TRIES):
            T_camera_board = self._propose(rng)
            if self.seen_whole(T_camera_board):
                return T_camera_board
        raise InputError("The board does not fit into the picture from there. Hold it further away.")

    def draw_before_lidar(self, rng: np.random.Generator, T_camera_lidar: Floats, height: float) -> Floats:
        """One T_camera_board (4, 4) whose middle is within `height` (m) of the LiDAR's plane, `nearest` to `furthest`
        away from the LiDAR and within 30 deg of its x axis. Raises InputError if the camera never sees it whole.
        """
        p = self._params
        for _ in range(TRIES):
            bearing, away = math.radians(30.0) * rng.uniform(-1.0, 1.0), rng.uniform(p.nearest, p.furthest)
            T_lidar_board = np.eye(4)
            R_facing = rotation_from_rpy(0.0, 0.0, bearing) @ R_BASE_OPTICAL
            T_lidar_board[:3, :3] = R_facing @ board_rotation(rng, p.tilt_deg, p.turn_deg)
            T_lidar_board[:3, 3] = away * math.cos(bearing), away * math.sin(bearing), height * rng.uniform(-1.0, 1.0)
            if self.seen_whole(T_camera_lidar @ T_lidar_board):
                return np.asarray(T_camera_lidar @ T_lidar_board)
        raise InputError("The camera does not see a board in the LiDAR's plane. Look at their mounts.")

    def seen_whole(self, T_camera_board: Floats) -> bool:
        """Whether the pattern lies within the picture."""
        points = self._extent @ T_camera_board[:3, :3].T + T_camera_board[:3, 3]
        if np.any(points[:, 2] < 0.05):
            return False
        pixels = self._camera.pixels(self._lens.bend(points[:, :2] / points[:, 2:]))
        edge = self._params.edge_px
        return bool(np.all(pixels >= edge) and np.all(pixels <= np.array(self._camera.size) - 1.0 - edge))

    def _propose(self, rng: np.random.Generator) -> Floats:
        p, c = self._params, self._camera
        depth = rng.uniform(p.nearest, p.furthest)
        pixel = (0.5 + p.spread * rng.uniform(-0.5, 0.5, 2)) * c.size
        x, y = c.rays(pixel[None])[0]
        T = np.eye(4)
        T[:3, :3] = board_rotation(rng, p.tilt_deg, p.turn_deg)
        T[:3, 3] = depth * x, depth * y, depth
        return T


def board_rotation(rng: np.random.Generator, tilt_deg: float, turn_deg: float) -> Floats:
    """R_camera_board (3, 3) of a board tilted about its width and its height, then turned in its plane."""
    about_x, about_y = np.radians(tilt_deg) * rng.uniform(-1.0, 1.0, 2)
    turn = math.radians(turn_deg) * rng.uniform(-1.0, 1.0)
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(a), math.sin(a)) for a in (about_x, about_y, turn))
    Rx = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    Ry = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    Rz = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1.0]])
    return np.asarray(Ry @ Rx @ Rz)

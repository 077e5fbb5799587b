"""A person who follows the guidance: of a few ideas where to hold the board, the one that is missing most."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.coverage import CoverageParams, missing_poses
from navcore.calibration.lidar_coverage import LidarCoverageParams, missing_lidar_poses
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.sim.board_poses import BoardPoseParams, BoardPoses

Floats = NDArray[np.float64]
IDEAS = 12


class BoardPerson:
    """Before one camera."""

    def __init__(self, camera: Intrinsics, lens: Lens, board: Board, params: BoardPoseParams) -> None:
        self._camera, self._lens, self._board = camera, lens, board
        self._poses = BoardPoses(camera, lens, board, params)

    def for_camera(self, seen: Sequence[BoardSighting], rng: np.random.Generator) -> Floats:
        """T_camera_board (4, 4) of the next pose after those seen."""
        ideas = [self._poses.draw(rng) for _ in range(IDEAS)]
        return max(ideas, key=lambda idea: self._worth(seen, idea))

    def for_lidar(
        self, seen: Sequence[Floats], T_camera_lidar: Floats, height: float, rng: np.random.Generator
    ) -> Floats:
        """The same within `height` (m) of the LiDAR's plane, after the poses T_camera_board (4, 4) held before."""
        ideas = [self._poses.draw_before_lidar(rng, T_camera_lidar, height) for _ in range(IDEAS)]
        return max(ideas, key=lambda idea: missing_lidar_poses([*seen, idea], LidarCoverageParams()).share)

    def _worth(self, seen: Sequence[BoardSighting], T_camera_board: Floats) -> float:
        """How much of what is asked for is there with that pose too; of equals, how even the picture is covered."""
        added = corners_at(T_camera_board, self._board, self._camera, self._lens)
        coverage = missing_poses([*seen, added], self._camera.size, CoverageParams())
        return coverage.share - 1e-3 * float(np.std(coverage.grid) / max(coverage.grid.mean(), 1.0))


def corners_at(T_camera_board: Floats, board: Board, camera: Intrinsics, lens: Lens, name: str = "") -> BoardSighting:
    """The corners of a board at that pose (4, 4) without any error."""
    at = board.corners() @ T_camera_board[:3, :3].T + T_camera_board[:3, 3]
    return BoardSighting(
        name=name, width_px=camera.width_px, height_px=camera.height_px, ids=np.arange(len(at)),
        points=board.corners(), pixels=camera.pixels(lens.bend(at[:, :2] / at[:, 2:])), edge_px=2.0,
    )  # fmt: skip

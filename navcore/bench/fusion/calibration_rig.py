"""The camera, LiDAR and boards that calibration is measured on: paper B's camera with a lens, 1 cm of range noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.board_on_scan import BoardOnScan
from navcore.calibration.board_run import plain_scan
from navcore.calibration.extrinsics import BoardPair
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy
from navcore.sim.board_person import BoardPerson, corners_at
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from navcore.sim.board_poses import BoardPoseParams, BoardPoses
from navcore.sim.board_scans import BoardScanParams, BoardScans

Floats = NDArray[np.float64]

# Paper B, equation (32); the lens is of the kind of its camera, whose coefficients the paper does not give.
CAMERA = Intrinsics(width_px=1280, height_px=720, fx=639.3178, fy=635.1858, cx=660.2825, cy=363.30748)
LENS = Lens(k1=-0.055, k2=0.032, p1=0.0006, p2=-0.0004, k3=-0.011)
# How well corners are found in rendered pictures with the fixed noise, px along each axis: 0.043 measured.
CORNER_PX = 0.05
# Before the camera, and before the LiDAR. A person who follows the guidance turns the board too.
NEAR = BoardPoseParams(nearest=0.18, furthest=0.8, tilt_deg=40.0, turn_deg=180.0, edge_px=4.0, spread=1.0)
HELD = BoardPoseParams(nearest=0.5, furthest=1.3, tilt_deg=45.0, turn_deg=60.0)
# Of the LiDAR at 10 Hz in the second for which a board is held still.
TURNS = 10


def guided_pictures(rng: np.random.Generator, count: int) -> list[BoardSighting]:
    """Boards found in rendered pictures whose poses fill what was missing before."""
    board = Board()
    person, finder = BoardPerson(CAMERA, LENS, board, NEAR), BoardFinder(board, BoardFinderParams())
    camera = BoardPictures(CAMERA, LENS, board, BoardPictureParams())
    seen: list[BoardSighting] = []
    while len(seen) < count:
        T = person.for_camera(seen, rng)
        found = finder.find(camera.render(T, rng), f"pose {len(seen)}")
        if isinstance(found, BoardSighting):
            seen.append(found)
    return seen


def seen_corners(T: Floats, board: Board, name: str, rng: np.random.Generator) -> BoardSighting:
    """The corners at that pose, with noise."""
    sighting = corners_at(T, board, CAMERA, LENS, name)
    return replace(sighting, pixels=sighting.pixels + CORNER_PX * rng.standard_normal(sighting.pixels.shape))


def true_mount(rng: np.random.Generator) -> Floats:
    """T_lidar_camera (4, 4): paper B's place within 3 cm, and turned by up to 4 deg about each axis."""
    T = np.eye(4)
    roll, pitch, yaw = np.radians(rng.uniform(-4.0, 4.0, 3))
    T[:3, :3] = rotation_from_rpy(roll, pitch, yaw) @ R_BASE_OPTICAL
    T[:3, 3] = np.array([0.075, 0.029, -0.096]) + rng.uniform(-0.03, 0.03, 3)
    return T


def drawn_pairs(
    rng: np.random.Generator, T_lidar_camera: Floats, count: int, *, height: float, turn_deg: float = HELD.turn_deg
) -> list[BoardPair]:
    """Boards that both see, their middles within `height` (m) of the LiDAR's plane; a second of its turns each."""
    board, T_camera_lidar = Board(), np.asarray(np.linalg.inv(T_lidar_camera), dtype=np.float64)
    held = BoardPoseParams(
        nearest=HELD.nearest, furthest=HELD.furthest, tilt_deg=HELD.tilt_deg, turn_deg=turn_deg
    )  # fmt: skip
    poses, lidar = BoardPoses(CAMERA, LENS, board, held), BoardScans(board, BoardScanParams(turns=TURNS))
    pairs = []
    for k in range(count):
        T = poses.draw_before_lidar(rng, T_camera_lidar, height)
        sighting = seen_corners(T, board, f"pose {k}", rng)
        pairs.append(BoardPair(sighting=sighting, scan=plain_scan(*lidar.scan(T_lidar_camera @ T, rng))))
    return pairs


def midpoints(poses: Sequence[BoardOnScan]) -> tuple[Floats, Floats]:
    """The board's middle in the picture (N, 2), px, and in the scan (N, 2), m: what the published method takes."""
    middles = np.array([pose.T_camera_board[:3, 3] for pose in poses])
    pixels = CAMERA.pixels(LENS.bend(middles[:, :2] / middles[:, 2:]))
    return pixels, np.array([pose.run.ends.mean(axis=0) for pose in poses])

"""A camera, a LiDAR and a person with a board, all simulated and known: to rehearse a calibration on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting, Image
from navcore.calibration.found_values import PLACE as PLACE_NAMES
from navcore.calibration.intrinsics_fit import PARAMETERS
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy
from navcore.messages import CalibrationJob
from navcore.sim.board_person import BoardPerson, corners_at
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from navcore.sim.board_poses import BoardPoseParams
from navcore.sim.board_scans import BoardScanParams, BoardScans

Floats = NDArray[np.float64]

# Paper B, equation (32), in three quarters of its 1280 x 720; the paper does not give the coefficients of its lens.
CAMERA = Intrinsics(width_px=960, height_px=540, fx=479.488, fy=476.389, cx=495.212, cy=272.481)
LENS = Lens(k1=-0.055, k2=0.032, p1=0.0006, p2=-0.0004, k3=-0.011)
# Paper B's place, and a mount that is a little crooked; then where a ruler and the eye have it.
PLACE, RPY_DEG = (0.075, 0.029, -0.096), (1.2, -2.1, 2.6)
RULER_PLACE, RULER_RPY_DEG = (0.10, 0.0, -0.10), (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardRehearsalParams:
    """How the board is held.

    Attributes:
        poses: then it is put down. seed: of everything random; >= 0.
        held: pictures of each pose. moving: pictures between two.
        height: how far the board's middle is from the LiDAR's plane at most, m.
    """

    poses: int = 32
    seed: int = 1
    held: int = 6
    moving: int = 1
    height: float = 0.06


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RehearsalFrame:
    """A picture (H, W, 3), BGR, and a turn of the LiDAR: angles, rad, and distances, m, (N,) each."""

    image: Image
    angles: Floats
    distances: Floats


class BoardRehearsal:
    """One rehearsal."""

    def __init__(self, job: CalibrationJob, board: Board, params: BoardRehearsalParams) -> None:
        self._job, self._board, self._params = job, board, params
        size = board.pattern[0] / 0.243  # of paper B's board: a larger one is held further away
        near = job is CalibrationJob.CAMERA
        held = BoardPoseParams(
            nearest=(0.2 if near else 0.45) * size, furthest=(0.8 if near else 1.2) * size,
            tilt_deg=40.0 if near else 45.0, turn_deg=60.0, edge_px=6.0, spread=1.0,
        )  # fmt: skip
        self._person = BoardPerson(CAMERA, LENS, board, held)
        self._pictures = BoardPictures(CAMERA, LENS, board, BoardPictureParams())
        self._scans = BoardScans(board, BoardScanParams())
        self._rng = np.random.default_rng(params.seed)
        self._seen: list[BoardSighting] = []
        self._held: list[Floats] = []

    def frames(self) -> Iterator[RehearsalFrame]:
        """For ever, five a second: each pose is gone to and held, and at last the board is put down."""
        last = away()
        for _ in range(self._params.poses):
            pose = self._next_pose()
            for k in range(self._params.moving):
                yield from self._show(between(last, pose, (k + 1) / (self._params.moving + 1)), 1)
            yield from self._show(pose, self._params.held)
            last = pose
        while True:
            yield from self._show(away(), 100)

    def _next_pose(self) -> Floats:
        if self._job is CalibrationJob.CAMERA:
            pose = self._person.for_camera(self._seen, self._rng)
        else:
            T_camera_lidar = np.asarray(np.linalg.inv(true_mount()), dtype=np.float64)
            pose = self._person.for_lidar(self._held, T_camera_lidar, self._params.height, self._rng)
        self._seen.append(corners_at(pose, self._board, CAMERA, LENS))
        self._held.append(pose)
        return pose

    def _show(self, T_camera_board: Floats, count: int) -> Iterator[RehearsalFrame]:
        lit = self._pictures.lit(T_camera_board, self._rng)
        for _ in range(count):
            angles, distances = self._scans.scan(true_mount() @ T_camera_board, self._rng)
            yield RehearsalFrame(image=self._pictures.exposed(lit, self._rng), angles=angles, distances=distances)


def true_mount() -> Floats:
    """T_lidar_camera (4, 4), optical axes."""
    return _mount(PLACE, RPY_DEG)


def told_mount() -> Floats:
    """The same as somebody measured it with a ruler: 4 cm and 4 deg off."""
    return _mount(RULER_PLACE, RULER_RPY_DEG)


def truth(job: CalibrationJob) -> tuple[tuple[str, float], ...]:
    """What shall be found, by the names and in the units of `FoundValue`."""
    if job is CalibrationJob.LIDAR:
        return tuple(zip(PLACE_NAMES, (*PLACE, *RPY_DEG), strict=True))
    numbers = (CAMERA.fx, CAMERA.fy, CAMERA.cx, CAMERA.cy, *LENS.coefficients)
    return tuple(zip(PARAMETERS, numbers, strict=True))


def _mount(place: tuple[float, float, float], rpy_deg: tuple[float, float, float]) -> Floats:
    T = np.eye(4)
    T[:3, :3] = rotation_from_rpy(*(math.radians(angle) for angle in rpy_deg)) @ R_BASE_OPTICAL
    T[:3, 3] = place
    return T


def away() -> Floats:
    """A pose that nobody sees."""
    T = np.eye(4)
    T[:3, 3] = 100.0, 0.0, 1.0
    return T


def between(a: Floats, b: Floats, share: float) -> Floats:
    """On the way from one pose to another; it arrives turned as at the end."""
    T = b.copy()
    T[:3, 3] = (1.0 - share) * a[:3, 3] + share * b[:3, 3]
    return T

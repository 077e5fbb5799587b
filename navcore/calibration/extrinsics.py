"""Where the camera sits to the 2D LiDAR, from a board that both see, and whether that can be trusted."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_on_scan import BoardOnScan, BoardOnScanParams, MountFit, fit_mount
from navcore.calibration.board_run import BoardRun, BoardRunParams, PlainScan, find_board
from navcore.calibration.intrinsics import spread_deg
from navcore.calibration.intrinsics_fit import board_pose
from navcore.errors import CalibrationError, NotFiniteError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy

Floats = NDArray[np.float64]

AXES = ("forward", "sideways", "in height"), ("roll", "pitch", "yaw")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExtrinsicsParams:
    """What is asked of the poses. Ours; set on rendered boards.

    Attributes:
        run: how the board is found in a scan. residuals: what the fit weighs by.
        least_poses: 4 or more; 20 to 30 are good.
        least_spread_deg: root mean square angle of the boards to their mean; parallel boards leave the mount free.
        stands_out: a pose whose error is so many times the others' median is thrown out; > 1.
        most_thrown_out: share of the poses; with more the set is refused. 0 to 0.5.
        worst_position: largest 1-sigma of the camera's place along an axis, m. worst_angle_deg: of its turn.
        rounds: of finding the boards with the mount that was fitted before; 2 or more.
    """

    run: BoardRunParams = field(default_factory=BoardRunParams)
    residuals: BoardOnScanParams = field(default_factory=BoardOnScanParams)
    least_poses: int = 6
    least_spread_deg: float = 8.0
    stands_out: float = 2.0
    most_thrown_out: float = 0.34
    worst_position: float = 0.01
    worst_angle_deg: float = 0.5
    rounds: int = 3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoardPair:
    """One pose of the board: the picture's sighting and the scan taken with it."""

    sighting: BoardSighting
    scan: PlainScan


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LidarCamera:
    """What was found.

    Attributes:
        T_lidar_camera: (4, 4), from the camera's optical axes; its last column is the camera's place.
        covariance: (6, 6) of the place, m, and of small turns about the LiDAR's axes, rad.
        poses: those kept. errors: (N,) root mean square residual of each, in sigmas; 1 is as expected.
        thrown_out: name and reason of those that were not kept.
    """

    T_lidar_camera: Floats
    covariance: Floats
    poses: tuple[BoardOnScan, ...]
    errors: Floats
    thrown_out: tuple[tuple[str, str], ...]

    @property
    def position_std(self) -> Floats:
        """(3,) 1-sigma along the LiDAR's axes, m."""
        return np.asarray(np.sqrt(np.diag(self.covariance)[:3]))

    @property
    def angle_std_deg(self) -> Floats:
        """(3,) 1-sigma about the LiDAR's axes, deg."""
        return np.degrees(np.sqrt(np.diag(self.covariance)[3:]))


def rough_mount(x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw: float = 0.0) -> Floats:
    """T_lidar_camera (4, 4) of a level camera there, m, that looks along `yaw`, rad. 20 cm and 15 deg off will do."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation_from_rpy(0.0, 0.0, yaw) @ R_BASE_OPTICAL, (x, y, z)
    return T


def calibrate_extrinsics(
    pairs: Sequence[BoardPair], board: Board, camera: Intrinsics, lens: Lens, rough: Floats, params: ExtrinsicsParams
) -> LidarCamera:
    """The mount from the boards' planes and edges. Raises CalibrationError with what is missing.

    Args:
        rough: T_lidar_camera (4, 4) as measured with a ruler, see `rough_mount`.
    """
    _check(pairs, camera, rough)
    seen = [(pair, board_pose(pair.sighting, camera, lens)) for pair in pairs]
    T, bad = np.asarray(rough, dtype=np.float64), dict[str, str]()
    for number in range(params.rounds):
        good = [(pair, pose) for pair, pose in seen if pair.sighting.name not in bad]
        poses, missed = _match(good, board, T, params.run, rough=number == 0)
        _check_poses(poses, missed | bad, params)
        fit, poses, out = _without_outliers(poses, board, T, params, throws=number > 0)
        bad |= out
        T = fit.T_lidar_camera
    left_out = bad | missed
    if len(left_out) > params.most_thrown_out * len(pairs):
        raise CalibrationError((f"{len(left_out)} of {len(pairs)} poses do not fit the rest.", *_told(left_out)))
    _check_certain(fit, params)
    return LidarCamera(
        T_lidar_camera=T, covariance=fit.covariance, poses=tuple(poses), errors=fit.errors,
        thrown_out=tuple(left_out.items()),
    )  # fmt: skip


def _check(pairs: Sequence[BoardPair], camera: Intrinsics, rough: Floats) -> None:
    if np.shape(rough) != (4, 4) or not np.all(np.isfinite(rough)):
        raise NotFiniteError("The rough mount must be 4 x 4 finite numbers.")
    if not all(np.all(np.isfinite(pair.sighting.pixels)) for pair in pairs):
        raise NotFiniteError("A corner of a board is NaN or infinite.")
    for pair in pairs:
        if pair.sighting.size != camera.size:
            wide, high = pair.sighting.size
            raise CalibrationError(
                (
                    f"The picture {pair.sighting.name} is {wide}x{high}, the camera was calibrated at "
                    f"{camera.width_px}x{camera.height_px}. Take pictures of that size, or calibrate it at this one.",
                )
            )


def _match(
    seen: Sequence[tuple[BoardPair, Floats]], board: Board, T: Floats, params: BoardRunParams, *, rough: bool
) -> tuple[list[BoardOnScan], dict[str, str]]:
    """The boards found in their scans, and why the others were not."""
    poses, missed = list[BoardOnScan](), dict[str, str]()
    for pair, T_camera_board in seen:
        T_lidar_board, name = T @ T_camera_board, pair.sighting.name
        outline = board.outline() @ T_lidar_board[:3, :3].T + T_lidar_board[:3, 3]
        run = find_board(pair.scan, outline, params, rough=rough)
        if isinstance(run, BoardRun):
            poses.append(BoardOnScan(name=name, T_camera_board=T_camera_board, run=run))
        else:
            missed[name] = run
    return poses, missed


def _check_poses(poses: Sequence[BoardOnScan], left_out: dict[str, str], params: ExtrinsicsParams) -> None:
    """Whether these can tell a mount at all."""
    distinct = _distinct(poses)
    if distinct < params.least_poses:
        raise CalibrationError(
            (
                f"Camera and LiDAR have {distinct} {'pose' if distinct == 1 else 'different poses'} of the board "
                f"together; {params.least_poses} are needed and 25 are good. Hold it into the LiDAR's plane, at "
                "other places and tilts.",
                *_told(left_out),
            )
        )
    if spread_deg(np.array([pose.T_camera_board[:3, 2] for pose in poses])) < params.least_spread_deg:
        raise CalibrationError(
            (
                "All boards stand parallel: tilt it by 30 deg to the left and right, forward and back, and turn it "
                "in its plane.",
            )
        )


def _distinct(poses: Sequence[BoardOnScan]) -> int:
    """How many poses differ from all before by 1 cm or 2 deg."""
    kept: list[Floats] = []
    for T in (pose.T_camera_board for pose in poses):
        if all(np.linalg.norm(T[:3, 3] - o[:3, 3]) > 0.01 or _turn(T, o) > math.radians(2.0) for o in kept):
            kept.append(T)
    return len(kept)


def _turn(a: Floats, b: Floats) -> float:
    return math.acos(float(np.clip((np.trace(a[:3, :3].T @ b[:3, :3]) - 1.0) / 2.0, -1.0, 1.0)))


def _without_outliers(
    poses: list[BoardOnScan], board: Board, start: Floats, params: ExtrinsicsParams, *, throws: bool
) -> tuple[MountFit, list[BoardOnScan], dict[str, str]]:
    """The fit, what it rests on, and what was thrown out, the worst first."""
    kept, out = list(poses), dict[str, str]()
    while True:
        fit = fit_mount(kept, board, start, params.residuals)
        worst, usual = int(np.argmax(fit.errors)), float(np.median(fit.errors))
        if not throws or fit.errors[worst] <= params.stands_out * max(usual, 1.0) or len(kept) <= params.least_poses:
            return fit, kept, out
        reason = f"its rays are {fit.errors[worst]:.1f} sigmas off the board, the others' {usual:.1f}"
        out[kept.pop(worst).name] = reason


def _check_certain(fit: MountFit, params: ExtrinsicsParams) -> None:
    """Refuses a mount of which something was hardly seen, and says what shows it."""
    std = np.sqrt(np.diag(fit.covariance))
    shares = std / np.array([params.worst_position] * 3 + [math.radians(params.worst_angle_deg)] * 3)
    worst = int(np.argmax(shares))
    if shares[worst] <= 1.0:
        return
    if worst < 3:
        known = f"place {AXES[0][worst]} is known to {1000 * std[worst]:.0f} mm only"
    else:
        known = f"{AXES[1][worst - 3]} is known to {math.degrees(std[worst]):.1f} deg only"
    raise CalibrationError(
        (
            f"The camera's {known}. Take more poses: near and far, left and right, tilted to all sides, and turned "
            "in the board's plane so that the LiDAR cuts slanted edges.",
        )
    )


def _told(left_out: dict[str, str]) -> list[str]:
    return [f"{name}: {reason}." for name, reason in left_out.items()]

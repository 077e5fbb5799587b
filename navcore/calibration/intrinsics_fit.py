"""Zhang's method by OpenCV, and how well it tells pictures that it has not seen.

Zhang, "A flexible new technique for camera calibration", IEEE PAMI 22 (2000), 1330-1334.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import BoardSighting
from navcore.errors import CalibrationError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens

Floats = NDArray[np.float64]

PARAMETERS = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntrinsicsFit:
    """Camera and lens that explain the corners best.

    Attributes:
        std: (9,) 1-sigma of PARAMETERS: px, px, px, px, and without unit.
        residuals: for each sighting (N, 2) seen minus explained corners, px.
        normals: (M, 3) of the boards, optical axes of the camera.
    """

    camera: Intrinsics
    lens: Lens
    std: Floats
    residuals: tuple[Floats, ...]
    normals: Floats


def fit_intrinsics(sightings: Sequence[BoardSighting]) -> IntrinsicsFit:
    """The least-squares fit to all. Raises CalibrationError where the boards stand so that there is none."""
    points = [s.points.astype(np.float32) for s in sightings]
    pixels = [s.pixels.astype(np.float32) for s in sightings]
    size = sightings[0].size
    try:
        _, K, distortion, rvecs, tvecs, std, _, _ = cv2.calibrateCameraExtended(
            points, pixels, size, np.eye(3), np.zeros(5)
        )  # fmt: skip
    except cv2.error as error:
        raise CalibrationError((f"These boards do not tell a camera ({error.err}). Tilt the board more.",)) from error
    numbers = np.concatenate((np.asarray(K).ravel(), np.ravel(distortion)[:5], np.ravel(std)[:9]))
    if not np.all(np.isfinite(numbers)) or K[0, 0] <= 0.0 or K[1, 1] <= 0.0:
        raise CalibrationError(("These boards do not tell a focal length. Tilt the board more.",))
    k1, k2, p1, p2, k3 = (float(c) for c in np.ravel(distortion)[:5])
    fitted = [
        cv2.projectPoints(s.points, rvec, tvec, K, distortion)[0].reshape(-1, 2)
        for s, rvec, tvec in zip(sightings, rvecs, tvecs, strict=True)
    ]
    return IntrinsicsFit(
        camera=Intrinsics(
            width_px=size[0], height_px=size[1], fx=float(K[0, 0]), fy=float(K[1, 1]), cx=float(K[0, 2]),
            cy=float(K[1, 2]),
        ),
        lens=Lens(k1=k1, k2=k2, p1=p1, p2=p2, k3=k3),
        std=np.asarray(np.ravel(std)[:9], dtype=np.float64),
        residuals=tuple(s.pixels - f for s, f in zip(sightings, fitted, strict=True)),
        normals=np.array([cv2.Rodrigues(rvec)[0][:, 2] for rvec in rvecs]),
    )  # fmt: skip


def rms_px(residuals: Sequence[Floats]) -> float:
    """Root mean square of the corners' distances, px: OpenCV's reprojection error."""
    squares = np.concatenate([np.sum(r**2, axis=1) for r in residuals])
    return math.sqrt(float(np.mean(squares)))


def left_out_residuals(sightings: Sequence[BoardSighting], folds: int) -> tuple[Floats, ...]:
    """For each sighting (N, 2) seen minus explained, px, by a camera that was fitted without it: its pose alone is.

    Every `folds`-th sighting is left out in turn.
    """
    residuals: list[Floats] = [np.empty((0, 2))] * len(sightings)
    for fold in range(folds):
        fit = fit_intrinsics([s for k, s in enumerate(sightings) if k % folds != fold])
        for k in range(fold, len(sightings), folds):
            residuals[k] = pose_residuals(sightings[k], fit.camera, fit.lens)
    return tuple(residuals)


def pose_residuals(sighting: BoardSighting, camera: Intrinsics, lens: Lens) -> Floats:
    """(N, 2) seen minus explained, px, with that camera and the board's best pose."""
    T = board_pose(sighting, camera, lens)
    rvec, _ = cv2.Rodrigues(T[:3, :3])
    explained, _ = cv2.projectPoints(sighting.points, rvec, T[:3, 3], camera.K, np.array(lens.coefficients))
    return np.asarray(sighting.pixels - explained.reshape(-1, 2))


def board_pose(sighting: BoardSighting, camera: Intrinsics, lens: Lens) -> Floats:
    """T_camera_board (4, 4), the camera's optical axes. Raises CalibrationError where the corners have no pose.

    Of the two poses that a plane may have (Collins and Bartoli, "Infinitesimal plane-based pose estimation", IJCV 109
    (2014)) the better one, refined.
    """
    pixels, K, coefficients = sighting.pixels, camera.K, np.array(lens.coefficients)
    try:
        count, rvecs, tvecs, _ = cv2.solvePnPGeneric(
            sighting.points, pixels, K, coefficients, flags=cv2.SOLVEPNP_IPPE
        )  # fmt: skip
        if count < 1:
            raise CalibrationError((f"The board in {sighting.name} has no pose.",))
        rvec, tvec = cv2.solvePnPRefineLM(sighting.points, pixels, K, coefficients, rvecs[0], tvecs[0])
    except cv2.error as error:
        raise CalibrationError((f"The board in {sighting.name} has no pose ({error.err}).",)) from error
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = cv2.Rodrigues(rvec)[0], np.ravel(tvec)
    if not np.all(np.isfinite(T)) or T[2, 3] <= 0.0:
        raise CalibrationError((f"The board in {sighting.name} has no pose before the camera.",))
    return T

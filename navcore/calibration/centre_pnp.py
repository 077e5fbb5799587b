"""Camera to LiDAR as paper B publishes it: pairs of the board's middle in the picture and in the scan, by PnP.

Paper B, equations (2) to (6): min over R, t of the sum of ||p_i - pi(K, R, t, P_i)||^2, and C = -R^T t.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.errors import CalibrationError, NotFiniteError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens

Floats = NDArray[np.float64]


def centre_pnp(pixels: Floats, points: Floats, camera: Intrinsics, lens: Lens) -> Floats:
    """T_lidar_camera (4, 4) from the middles' pixels (N, 2) and LiDAR points (N, 2) in the sensor's plane, m.

    The points all lie in one plane that the camera sees almost edge on, which is this method's weakness. Raises
    CalibrationError with fewer than 6 pairs, or where they lie on one line.
    """
    if len(pixels) < 6 or len(points) != len(pixels):
        raise CalibrationError((f"{len(pixels)} pairs of a board's middle are too few for PnP; take 6 or more.",))
    if not (np.all(np.isfinite(pixels)) and np.all(np.isfinite(points))):
        raise NotFiniteError("A pair of a board's middle is NaN or infinite.")
    if np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[1] < 0.01:
        raise CalibrationError(("The board's middles lie on one line. Hold the board left and right, near and far.",))
    flat = np.column_stack((points, np.zeros(len(points))))
    K, coefficients = camera.K, np.array(lens.coefficients)
    try:
        _, rvecs, tvecs, _ = cv2.solvePnPGeneric(flat, pixels, K, coefficients, flags=cv2.SOLVEPNP_IPPE)
        rvec, tvec = cv2.solvePnPRefineLM(flat, pixels, K, coefficients, rvecs[0], tvecs[0])
    except (cv2.error, IndexError) as error:
        raise CalibrationError(("PnP finds no mount that explains these pairs.",)) from error
    R, _ = cv2.Rodrigues(rvec)
    T_lidar_camera = np.eye(4)
    T_lidar_camera[:3, :3], T_lidar_camera[:3, 3] = R.T, -R.T @ np.ravel(tvec)
    return T_lidar_camera

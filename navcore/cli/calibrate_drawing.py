"""Plots of a calibration: errors of the corners, coverage of the picture, and boards on their rays."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board
from navcore.calibration.board_run import plane_cut
from navcore.calibration.coverage import Coverage
from navcore.calibration.extrinsics import LidarCamera
from navcore.calibration.intrinsics import CameraIntrinsics
from navcore.errors import InputError

Image = NDArray[np.uint8]
PANEL_PX, EDGE_PX = 480, 28
INK, GRID, DOT, BAR, BAD = (40, 40, 40), (225, 225, 225), (190, 110, 30), (120, 170, 70), (60, 60, 220)


def draw_camera(path: Path, found: CameraIntrinsics, coverage: Coverage) -> None:
    """Where corners were seen, how far each is off, and each picture's error. Raises InputError if not written."""
    _write(path, np.hstack((_coverage(found, coverage), _residuals(found), _bars(found))))


def draw_lidar(path: Path, found: LidarCamera, board: Board) -> None:
    """From above, x up, each board as the camera tells it and the rays on it. Raises InputError if not written."""
    canvas = _panel("boards (green) and rays (blue) in the LiDAR's plane")
    points = np.concatenate([pose.run.points for pose in found.poses])
    scale = (PANEL_PX - 2 * EDGE_PX) / (1.1 * max(float(points[:, 0].max()), 2.0 * float(np.abs(points[:, 1]).max())))
    for pose in found.poses:
        T = found.T_lidar_camera @ pose.T_camera_board
        cut = plane_cut(board.outline() @ T[:3, :3].T + T[:3, 3])
        if cut is not None:
            cv2.line(canvas, _above(cut[0], scale), _above(cut[1], scale), BAR, 2, cv2.LINE_AA)
        for point in pose.run.points:
            cv2.circle(canvas, _above(point, scale), 1, DOT, -1, cv2.LINE_AA)
    cv2.circle(canvas, _above(np.zeros(2), scale), 4, BAD, -1, cv2.LINE_AA)
    _write(path, canvas)


def _coverage(found: CameraIntrinsics, coverage: Coverage) -> Image:
    """Corners in the picture's frame, and the count of each part."""
    canvas, (wide, high) = _panel("corners seen, and how many in each part"), found.camera.size
    scale = (PANEL_PX - 2 * EDGE_PX) / max(wide, high)
    rows, columns = coverage.grid.shape
    for r in range(rows):
        for c in range(columns):
            upper = _at(c * wide / columns * scale, r * high / rows * scale)
            lower = _at((c + 1) * wide / columns * scale, (r + 1) * high / rows * scale)
            cv2.rectangle(canvas, upper, lower, GRID, 1)
            _word(canvas, str(coverage.grid[r, c]), (upper[0] + 4, upper[1] + 16))
    for sighting in found.sightings:
        for u, v in sighting.pixels * scale:
            cv2.circle(canvas, _at(u, v), 1, DOT, -1, cv2.LINE_AA)
    return canvas


def _residuals(found: CameraIntrinsics) -> Image:
    """Each corner's error about the middle, on rings."""
    canvas, middle = _panel("error of each corner"), PANEL_PX // 2
    errors = np.concatenate(found.residuals)
    reach = max(float(np.percentile(np.abs(errors), 99.5)), 1e-3)
    scale = (middle - 2 * EDGE_PX) / reach
    for share in (0.5, 1.0):
        cv2.circle(canvas, (middle, middle), round(share * reach * scale), GRID, 1, cv2.LINE_AA)
        _word(canvas, f"{share * reach:.2g} px", (middle + 4, middle - round(share * reach * scale) - 4))
    for u, v in errors * scale:
        cv2.circle(canvas, (middle + round(u), middle + round(v)), 1, DOT, -1, cv2.LINE_AA)
    return canvas


def _bars(found: CameraIntrinsics) -> Image:
    """Error of each picture: in the fit, and behind it left out."""
    canvas = _panel("error of each picture; red: when left out")
    most = max(max(p.rms_px, p.left_out_px) for p in found.pictures)
    step, high = (PANEL_PX - 2 * EDGE_PX) / len(found.pictures), PANEL_PX - 3 * EDGE_PX
    floor = PANEL_PX - EDGE_PX
    for k, picture in enumerate(found.pictures):
        left, right = round(EDGE_PX + k * step), round(EDGE_PX + (k + 0.8) * step)
        cv2.rectangle(canvas, (left, floor - round(high * picture.left_out_px / most)), (right, floor), BAD, -1)
        cv2.rectangle(canvas, (left, floor - round(high * picture.rms_px / most)), (right, floor), BAR, -1)
    _word(canvas, f"{most:.2g} px", (EDGE_PX, 2 * EDGE_PX - 6))
    return canvas


def _panel(title: str) -> Image:
    canvas = np.full((PANEL_PX, PANEL_PX, 3), 255, dtype=np.uint8)
    _word(canvas, title, (EDGE_PX, EDGE_PX - 10))
    return canvas


def _at(u: float, v: float) -> tuple[int, int]:
    return EDGE_PX + round(float(u)), EDGE_PX + round(float(v))


def _above(point: NDArray[np.float64], scale: float) -> tuple[int, int]:
    """x up and y left from the middle of the lower edge."""
    return PANEL_PX // 2 - round(float(point[1]) * scale), PANEL_PX - EDGE_PX - round(float(point[0]) * scale)


def _word(canvas: Image, text: str, at: tuple[int, int]) -> None:
    cv2.putText(canvas, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.42, INK, 1, cv2.LINE_AA)


def _write(path: Path, picture: Image) -> None:
    try:
        written = cv2.imwrite(str(path), picture)
    except cv2.error:
        written = False
    if not written:
        raise InputError(f"The plot {path} cannot be written. Give a .png in a folder that is there.")

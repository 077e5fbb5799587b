"""Finds a calibration board in a picture, or says in words why not."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting, Image
from navcore.calibration.missing_board import why_missing

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Corners are refined within this share of the way to the next one, and not further than so many px.
WINDOW_SHARE, WINDOW_PX = 0.4, 7
REFINE = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 40, 1e-3)
LARGEST_PX = 10_000


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardFinderParams:
    """What counts as seen. Ours; set on rendered boards.

    Attributes:
        widest_edge_px: edges from black to white wider than this are blurred; 2 to 20.
        least_corners: of a ChArUco board; 6 or more.
        tries_hard: look a second time, with OpenCV's slower sector detector, and find out why there is no board. Off
            for a live picture: 50 instead of 500 ms where there is none.
    """

    widest_edge_px: float = 6.0
    least_corners: int = 8
    tries_hard: bool = True


class BoardFinder:
    """Looks for one board."""

    def __init__(self, board: Board, params: BoardFinderParams) -> None:
        self.board, self._params = board, params
        self._charuco = cv2.aruco.CharucoDetector(board.charuco_board()) if board.charuco else None

    def find(self, picture: Image, name: str = "") -> BoardSighting | str:
        """The board in a picture (H, W) or (H, W, 3), BGR, or a sentence that says why there is none."""
        if (wrong := _wrong_picture(picture)) is not None:
            return wrong
        grey = np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), np.uint8) if picture.ndim == 3 else picture
        found = self._charuco_corners(grey) if self.board.charuco else self._chess_corners(grey)
        if isinstance(found, str):
            return found
        ids, pixels = found
        edge_px = np.nan if self.board.charuco else self._edge_px(grey, pixels)
        if edge_px > self._params.widest_edge_px:
            return f"The board is blurred: its edges are {edge_px:.0f} px wide. Hold it still, or focus the lens."
        return BoardSighting(
            name=name, width_px=grey.shape[1], height_px=grey.shape[0], ids=ids, points=self.board.corners()[ids],
            pixels=pixels, edge_px=edge_px,
        )  # fmt: skip

    def _chess_corners(self, grey: Image) -> tuple[Ints, Floats] | str:
        size = (self.board.columns, self.board.rows)
        flags = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
        hard = self._params.tries_hard
        flags |= 0 if hard else cv2.CALIB_CB_FAST_CHECK
        found, corners = cv2.findChessboardCorners(grey, size, flags=flags)
        if not found and hard:
            found, corners = cv2.findChessboardCornersSB(grey, size, flags=cv2.CALIB_CB_NORMALIZE_IMAGE)
        if not found:
            return why_missing(grey, self.board, look=hard)
        grid = np.asarray(corners, dtype=np.float64).reshape(self.board.rows, self.board.columns, 2)
        pixels = _refined(grey, _in_order(grey, grid))
        return np.arange(len(pixels)), pixels

    def _charuco_corners(self, grey: Image) -> tuple[Ints, Floats] | str:
        assert self._charuco is not None
        corners, ids, _, markers = self._charuco.detectBoard(grey)
        seen = 0 if ids is None else len(ids)
        if seen < self._params.least_corners or _in_line(self.board.corners()[np.ravel(ids)]):
            return self._too_few(seen, 0 if markers is None else len(markers))
        return np.ravel(ids).astype(np.int64), np.asarray(corners, dtype=np.float64).reshape(-1, 2)

    def _too_few(self, corners: int, markers: int) -> str:
        if markers == 0:
            return "No marker of a ChArUco board is seen. Look at the light, the focus, and whether it is one (4X4)."
        if corners == 0:
            return (
                f"{markers} markers are seen, but not where a board of {self.board.columns} x {self.board.rows} "
                "inner corners has them. Give the board's size as printed."
            )
        return f"Only {corners} corners of the board are seen. Show more of it."

    def _edge_px(self, grey: Image, pixels: Floats) -> float:
        size = (self.board.columns, self.board.rows)
        told, _ = cv2.estimateChessboardSharpness(grey, size, pixels.astype(np.float32).reshape(-1, 1, 2))
        width = float(np.ravel(told)[0])
        return width if width > 0.0 else float("nan")


def _wrong_picture(picture: Image) -> str | None:
    if picture.ndim not in (2, 3) or picture.dtype != np.uint8 or min(picture.shape[:2]) < 32:
        return "This is no picture of 8 bits a channel, 32 px wide and high or more."
    if max(picture.shape[:2]) > LARGEST_PX:
        return f"The picture is wider or higher than {LARGEST_PX} px. Take it with the robot's camera."
    return None


def _in_order(grey: Image, grid: Floats) -> Floats:
    """Corners (rows, columns, 2) so that x runs right and y down as on the board, and its dark end square is first.

    A board whose squares are the same at both ends can be told from itself turned round by nothing.
    """
    along, down = grid[0, 1] - grid[0, 0], grid[1, 0] - grid[0, 0]
    if along[0] * down[1] - along[1] * down[0] < 0.0:
        grid = grid[::-1]
    turned = grid[::-1, ::-1]
    return np.asarray(turned if _end_square(grey, turned) < _end_square(grey, grid) else grid, dtype=np.float64)


def _end_square(grey: Image, grid: Floats) -> float:
    """Grey value of the square before the first corner; squares beside the picture are as bright as can be."""
    middle = grid[0, 0] - 0.5 * (grid[0, 1] - grid[0, 0]) - 0.5 * (grid[1, 0] - grid[0, 0])
    u, v = np.rint(middle).astype(int)
    inside = 1 <= u < grey.shape[1] - 1 and 1 <= v < grey.shape[0] - 1
    return float(grey[v - 1 : v + 2, u - 1 : u + 2].mean()) if inside else 255.0


def _refined(grey: Image, grid: Floats) -> Floats:
    """Corners (N, 2) to a part of a pixel, row by row."""
    steps = (np.diff(grid, axis=0).reshape(-1, 2), np.diff(grid, axis=1).reshape(-1, 2))
    nearest = min(float(np.hypot(s[:, 0], s[:, 1]).min()) for s in steps)
    half = max(2, min(WINDOW_PX, int(WINDOW_SHARE * nearest)))
    corners = grid.reshape(-1, 1, 2).astype(np.float32)
    refined = cv2.cornerSubPix(grey, corners, (half, half), (-1, -1), REFINE)
    return np.asarray(refined, dtype=np.float64).reshape(-1, 2)


def _in_line(points: Floats) -> bool:
    """Whether points (N, 3) lie on one line, or are too few to tell."""
    return len(points) < 4 or bool(np.linalg.matrix_rank(points - points.mean(axis=0), tol=1e-6) < 2)

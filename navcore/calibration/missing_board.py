"""Why a chessboard is not found in a picture."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, Image

Floats = NDArray[np.float64]

DARK, BRIGHT, FLAT = 25.0, 235.0, 4.0
# Of the Laplacian, grey values; a picture that is in focus has more, its noise alone smoothed away.
SOFT = 2.0


def why_missing(grey: Image, board: Board, *, look: bool) -> str:
    """A sentence. `look`: search for a part of the board, or another one, which takes half a second."""
    if (light := _light(grey)) is not None:
        return light
    grid = _any_grid(grey) if look else None
    if grid is not None and max(grid.shape[:2]) >= 4:  # noise has chance grids of 3 x 3
        return _other(grid, board, grey)
    if _soft(grey):
        return "No board is seen, and the picture is blurred. Focus the lens, and hold the board still."
    return (
        f"No board of {board.columns} x {board.rows} inner corners is seen. Show all of it, with its white edge, "
        "in even light."
    )


def _light(grey: Image) -> str | None:
    low, high = np.percentile(grey, (5, 95))
    if high < DARK:
        return "The picture is black. Take the cap off, or give it light."
    if low > BRIGHT:
        return "The picture is white all over. Take the light away, or shorten the exposure."
    if grey.std() < FLAT:
        return "The picture shows nothing. Look at the camera."
    return None


def _any_grid(grey: Image) -> Floats | None:
    """Corners (rows, columns, 2) of whatever chessboard there is, of 3 x 3 corners or more."""
    flags = cv2.CALIB_CB_LARGER | cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_NORMALIZE_IMAGE
    found, corners, meta = cv2.findChessboardCornersSBWithMeta(grey, (3, 3), flags)
    return np.asarray(corners, dtype=np.float64).reshape(*meta.shape[:2], 2) if found else None


def _other(grid: Floats, board: Board, grey: Image) -> str:
    """Sentence about a grid that is not the board's."""
    edges = _edges_reached(grid, grey)
    seen, wanted = sorted(grid.shape[:2]), sorted((board.columns, board.rows))
    if edges and seen[0] <= wanted[0] and seen[1] <= wanted[1]:
        return f"The board is cut off at the picture's {' and '.join(edges)}. Show all of it, with its white edge."
    if seen == wanted:
        return "The board is seen, but not sharply enough. Hold it still and nearer, in even light."
    return (
        f"A board of {seen[1]} x {seen[0]} inner corners is seen, not of {board.columns} x {board.rows}. Count where "
        "two black squares meet, and give that size; a hand over the board makes it smaller too."
    )


def _edges_reached(grid: Floats, grey: Image) -> list[str]:
    """At which edges of the picture two squares more would not fit."""
    beyond = np.concatenate(
        (
            3 * grid[0] - 2 * grid[1], 3 * grid[-1] - 2 * grid[-2],
            3 * grid[:, 0] - 2 * grid[:, 1], 3 * grid[:, -1] - 2 * grid[:, -2],
        )
    )  # fmt: skip
    high, wide = grey.shape
    (left, upper), (right, lower) = beyond.min(axis=0), beyond.max(axis=0)
    reached = {
        "left edge": left < 0, "right edge": right > wide - 1, "upper edge": upper < 0, "lower edge": lower > high - 1
    }  # fmt: skip
    return [edge for edge, is_reached in reached.items() if is_reached]


def _soft(grey: Image) -> bool:
    smooth = cv2.GaussianBlur(grey, (0, 0), 2.0).astype(np.float32)
    return float(np.percentile(np.abs(cv2.Laplacian(smooth, cv2.CV_32F)), 99.0)) < SOFT

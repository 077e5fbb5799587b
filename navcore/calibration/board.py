"""Calibration boards: a chessboard, or a ChArUco board whose squares tell their numbers."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Image = NDArray[np.uint8]

# The markers of a ChArUco board; of 4 x 4 bits, so that a marker of 3/4 of a square is 6 texels of 8.
DICTIONARY = cv2.aruco.DICT_4X4_100
MARKER_SHARE = 0.75
TEXELS = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class Board:
    """A board; paper B's by default. Its frame: origin in the middle, x right, y down, z away from a viewer.

    Attributes:
        columns, rows: inner corners, where two black squares meet; 3 to 20.
        square: side, m; > 0. Measure the print: printers scale.
        charuco: markers in the white squares (ArUco 4X4_100, 3/4 of a square wide), so that a part of it is enough.
        width, height: of the plate that carries the pattern in its middle, m; 0 for a white edge one square wide.
            The LiDAR sees the plate, so they count there.

    Raises InputError for a board that cannot be.
    """

    columns: int = 8
    rows: int = 5
    square: float = 0.027
    charuco: bool = False
    width: float = 0.0
    height: float = 0.0

    def __post_init__(self) -> None:
        if not (3 <= self.columns <= 20 and 3 <= self.rows <= 20):
            raise InputError("A board has 3 to 20 inner corners each way; count where two black squares meet.")
        if not 0.002 <= self.square <= 1.0:
            raise InputError("A board's squares are 2 mm to 1 m wide; give the side of one.")
        if self.charuco and self.markers > 100:
            raise InputError("A ChArUco board of that many squares has no 100 markers for them; take fewer squares.")
        if not all(size == 0.0 or least <= size <= 3.0 for size, least in zip(self.plate, self.pattern, strict=True)):
            raise InputError("The plate is smaller than its pattern, or larger than 3 m. Measure the whole plate.")

    @property
    def markers(self) -> int:
        """Of a ChArUco board: one in each white square."""
        return (self.columns + 1) * (self.rows + 1) // 2

    @property
    def pattern(self) -> tuple[float, float]:
        """Width and height of all squares, m."""
        return (self.columns + 1) * self.square, (self.rows + 1) * self.square

    @property
    def plate(self) -> tuple[float, float]:
        """Width and height of the plate, m."""
        wide, high = self.pattern
        return self.width or wide + 2.0 * self.square, self.height or high + 2.0 * self.square

    def corners(self) -> Floats:
        """The inner corners (columns * rows, 3) in the board's frame, m, row by row."""
        y, x = np.mgrid[0 : self.rows, 0 : self.columns].reshape(2, -1)
        flat = (np.column_stack((x, y)) - ((self.columns - 1) / 2, (self.rows - 1) / 2)) * self.square
        return np.column_stack((flat, np.zeros(len(flat))))

    def outline(self) -> Floats:
        """The plate's corners (4, 3) in the board's frame, m: upper left, upper right, lower right, lower left."""
        wide, high = self.plate
        return np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * (wide / 2, high / 2, 0.0)

    def texture(self) -> Image:
        """The pattern, TEXELS to a square, 0 or 255: to print it, or to render it."""
        if self.charuco:
            size = ((self.columns + 1) * TEXELS, (self.rows + 1) * TEXELS)
            return np.asarray(self.charuco_board().generateImage(size, marginSize=0), dtype=np.uint8)
        y, x = np.mgrid[0 : self.rows + 1, 0 : self.columns + 1]
        return np.asarray(np.kron((x + y) % 2 * 255, np.ones((TEXELS, TEXELS))), dtype=np.uint8)

    def charuco_board(self) -> cv2.aruco.CharucoBoard:
        """As OpenCV knows it; its first inner corner is ours."""
        size, marker = (self.columns + 1, self.rows + 1), MARKER_SHARE * self.square
        dictionary = cv2.aruco.getPredefinedDictionary(DICTIONARY)
        return cv2.aruco.CharucoBoard(size, self.square, marker, dictionary)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoardSighting:
    """A board in one picture.

    Attributes:
        name: of the picture, for people.
        width_px, height_px: of the picture.
        ids: (N,) which of the board's corners. points: (N, 3) where they are on the board, m.
        pixels: (N, 2) where they are in the picture, px; the lens' distortion is in them.
        edge_px: how wide the board's edges from black to white are; 1 to 3 is sharp. NaN where not measured.
    """

    name: str
    width_px: int
    height_px: int
    ids: Ints
    points: Floats
    pixels: Floats
    edge_px: float

    @property
    def size(self) -> tuple[int, int]:
        """Of the picture, width and height, px."""
        return self.width_px, self.height_px

"""A scan from above: its rays' ends, walls, and things of the size of a trunk or a post."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.cli.scan_files import RecordedScan
from navcore.errors import InputError
from navcore.perception.scan.scan_clusters import ScanTrunks
from navcore.perception.scan.walls import Wall

Image = NDArray[np.uint8]
SIDE_PX, EDGE_PX = 1000, 30
PAPER, RAY, WALL, THING, SENSOR, INK = (
    255,
    (120, 120, 120),
    (190, 110, 30),
    (60, 60, 220),
    (40, 160, 40),
    (40, 40, 40),
)


def draw_scan(path: Path, scan: RecordedScan, walls: Sequence[Wall], trunks: ScanTrunks) -> None:
    """x up, y to the left, as far as nine tenths of the rays reach. Raises InputError if not written."""
    reach = max(float(np.quantile(scan.distances, 0.9)), 1.0)
    scale = (SIDE_PX / 2 - EDGE_PX) / reach
    canvas = np.full((SIDE_PX, SIDE_PX, 3), PAPER, dtype=np.uint8)
    for angle, distance in zip(scan.angles.tolist(), scan.distances.tolist(), strict=True):
        cv2.circle(canvas, _above(distance * math.cos(angle), distance * math.sin(angle), scale), 1, RAY, -1)
    for wall in walls:
        cv2.line(canvas, _above(*wall.ends[0], scale), _above(*wall.ends[1], scale), WALL, 2, cv2.LINE_AA)
    for bearing, away, thick in zip(trunks.bearing, trunks.range, trunks.diameter, strict=True):
        middle = _above(away * math.cos(bearing), away * math.sin(bearing), scale)
        cv2.circle(canvas, middle, max(round(scale * thick / 2), 4), THING, 2, cv2.LINE_AA)
    cv2.drawMarker(canvas, _above(0.0, 0.0, scale), SENSOR, cv2.MARKER_TRIANGLE_UP, 14, 2)
    _measure(canvas, scale)
    if not cv2.imwrite(str(path), canvas):
        raise InputError(f"{path} cannot be written as a picture: end its name in .png, in a folder that there is.")


def _measure(canvas: Image, scale: float) -> None:
    """A metre, and what the colours are."""
    low = SIDE_PX - EDGE_PX
    cv2.line(canvas, (EDGE_PX, low), (EDGE_PX + round(scale), low), INK, 2)
    for text, ink, x in (("1 m", INK, 0), ("walls", WALL, 120), ("trunk or post size", THING, 220)):
        cv2.putText(canvas, text, (EDGE_PX + x, low - 8), cv2.FONT_HERSHEY_SIMPLEX, 0.5, ink, 1, cv2.LINE_AA)


def _above(x: float, y: float, scale: float) -> tuple[int, int]:
    """Clipped to what OpenCV can draw."""
    return tuple(max(min(round(SIDE_PX / 2 - scale * v), 30_000), -30_000) for v in (y, x))  # type: ignore[return-value]

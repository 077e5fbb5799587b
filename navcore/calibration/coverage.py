"""Which poses of the board are still missing: parts of the picture, tilts, distances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import BoardSighting
from navcore.calibration.intrinsics_fit import board_pose
from navcore.errors import CalibrationError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ROWS, COLUMNS = 3, 4
# Before a camera is calibrated its focal length is guessed: 70 deg wide.
GUESSED_FOCAL = 0.5 / math.tan(math.radians(35.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class CoverageParams:
    """What a good set of pictures has. Ours; such sets tell the focal length of rendered cameras to 0.1 %.

    Attributes:
        corners: in each of 3 x 4 parts of the picture; >= 1.
        tilt_deg: a board counts as tilted from here, its normal against the ray to it; 5 to 45.
        tilted: boards tilted to each of the four sides; >= 1.
        near, far: width or height of the board, whichever takes more of the picture: at least, and at most, share.
        poses: in all.
    """

    corners: int = 20
    tilt_deg: float = 15.0
    tilted: int = 2
    near: float = 0.5
    far: float = 0.35
    poses: int = 20


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Coverage:
    """What is there and what is not.

    Attributes:
        grid: (3, 4) corners seen in each part of the picture, upper left first.
        missing: sentences for the person with the board, the most useful first; empty when the set is good.
        share: of what is asked that is there, 0 to 1, for a progress bar.
    """

    grid: Ints
    missing: tuple[str, ...]
    share: float


def missing_poses(sightings: Sequence[BoardSighting], size: tuple[int, int], params: CoverageParams) -> Coverage:
    """Of a picture `size` (width, height), px. Poses need no calibration: they are told roughly, by a guessed one."""
    grid = corner_grid(sightings, size)
    tilts = [tilt for s in sightings if (tilt := _tilt_deg(s)) is not None]
    sizes = [_share_of_picture(s) for s in sightings]
    asked = (
        *_part_wishes(grid, params), *_tilt_wishes(tilts, params),
        (any(s >= params.near for s in sizes), "Hold the board nearer, so that it fills half of the picture."),
        (any(s <= params.far for s in sizes), "Hold the board further away, so that it fills a third of it."),
        (len(sightings) - alike(sightings) >= params.poses, f"Take {params.poses} pictures, each of another pose."),
    )  # fmt: skip
    missing = tuple(wish for is_there, wish in asked if not is_there)
    return Coverage(grid=grid, missing=missing, share=1.0 - len(missing) / len(asked))


def corner_grid(sightings: Sequence[BoardSighting], size: tuple[int, int]) -> Ints:
    """(3, 4) corners in each part of the picture."""
    grid = np.zeros((ROWS, COLUMNS), dtype=np.int64)
    for s in sightings:
        column = np.clip(s.pixels[:, 0] / size[0] * COLUMNS, 0, COLUMNS - 1).astype(np.int64)
        row = np.clip(s.pixels[:, 1] / size[1] * ROWS, 0, ROWS - 1).astype(np.int64)
        np.add.at(grid, (row, column), 1)
    return grid


def alike(sightings: Sequence[BoardSighting]) -> int:
    """How many show the board where an earlier one does, within 1 % of the picture's width."""
    seen: list[BoardSighting] = []
    for s in sightings:
        if not any(_same_place(s, other) for other in seen):
            seen.append(s)
    return len(sightings) - len(seen)


def _same_place(a: BoardSighting, b: BoardSighting) -> bool:
    both, in_a, in_b = np.intersect1d(a.ids, b.ids, return_indices=True)
    if not len(both):
        return False
    apart = a.pixels[in_a] - b.pixels[in_b]
    return bool(np.hypot(apart[:, 0], apart[:, 1]).max() < 0.01 * a.width_px)


def _part_wishes(grid: Ints, params: CoverageParams) -> list[tuple[bool, str]]:
    rows, columns = ("upper", "middle", "lower"), ("left", "left middle", "right middle", "right")
    return [
        (bool(grid[r, c] >= params.corners), f"Show the board in the {rows[r]} {columns[c]} of the picture.")
        for r in range(ROWS)
        for c in range(COLUMNS)
    ]


def _tilt_wishes(tilts: Sequence[tuple[float, float]], params: CoverageParams) -> list[tuple[bool, str]]:
    """Of tilts about the picture's height and width, deg."""
    least = params.tilt_deg
    counts = {
        "left edge": sum(across < -least for across, _ in tilts),
        "right edge": sum(across > least for across, _ in tilts),
        "upper edge": sum(down < -least for _, down in tilts),
        "lower edge": sum(down > least for _, down in tilts),
    }
    return [(n >= params.tilted, f"Tilt the board: bring its {edge} nearer by 30 deg.") for edge, n in counts.items()]


def _tilt_deg(sighting: BoardSighting) -> tuple[float, float] | None:
    """How far the left edge, and the upper edge, in the picture is turned towards the camera, deg."""
    wide, high = sighting.size
    guess = Intrinsics(
        width_px=wide, height_px=high, fx=GUESSED_FOCAL * wide, fy=GUESSED_FOCAL * wide, cx=wide / 2, cy=high / 2
    )
    try:
        T = board_pose(sighting, guess, Lens())
    except CalibrationError:
        return None
    normal, ray = T[:3, 2], T[:3, 3]
    across = math.atan2(normal[0], normal[2]) - math.atan2(ray[0], ray[2])
    down = math.atan2(normal[1], normal[2]) - math.atan2(ray[1], ray[2])
    return math.degrees(across), math.degrees(down)


def _share_of_picture(sighting: BoardSighting) -> float:
    _, _, wide, high = cv2.boundingRect(sighting.pixels.astype(np.float32))
    return max(wide / sighting.width_px, high / sighting.height_px)

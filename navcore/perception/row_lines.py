"""The one interface of all row line fitters, and what they hand on."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.geometry.se2 import SE2
from navcore.perception.corner_points import CornerPoints
from navcore.perception.scan_evidence import ScanEvidence

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowPrior:
    """The row that is expected, from map and pose, in the driving frame at the picture's capture.

    Attributes:
        offset, heading: of its centre line, as in `RowObservation`.
        std: 1-sigma of `offset`, m, > 0.
        width: corridor width, m; None if not known.
        heading_std: 1-sigma of `heading`, rad.
        pitch: how much further down than its mount says the camera looks, rad; None if nobody knows.
        roll: how far the driving frame leans against the ground to the side, left side up, rad, as the IMU tells it.
        land_roll: how far the ground does, against gravity.
    """

    offset: float
    heading: float
    std: float
    width: float | None = None
    heading_std: float = 0.09
    pitch: float | None = None
    roll: float = 0.0
    land_roll: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RowCue:
    """What is known beside the picture.

    Attributes:
        prior: the expected row.
        motion: pose of the driving frame in that of the previous picture; None if not known, then nothing of the
            previous picture is used.
        scan: what a 2D LiDAR adds, of the same corner points; None without one.
    """

    prior: RowPrior | None = None
    motion: SE2 | None = None
    scan: ScanEvidence | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GroundRow:
    """A corridor on the ground, in the driving frame.

    Attributes:
        offset, heading, width: of the centre line, and between the lines of plants; m, rad, m.
        covariance: (2, 2) of offset and heading.
        pitch: how much further down than its mount says the camera looked, rad.
        left_x, right_x: distances ahead of the driving frame's origin, along x, of the objects on either line.
        quality: 0 to 1.
        beside: (N, 2) feet that stand on neither line, in the driving frame, m.
        carried: metres by which it is carried on without a plant in sight; 0 while it is seen.
        scanned: a 2D LiDAR told how far ahead its plants stand.
        curvature: of the centre line beside the origin, 1/m; 0 for a straight one.
    """

    offset: float
    heading: float
    width: float
    covariance: Floats
    pitch: float
    left_x: Floats
    right_x: Floats
    quality: float
    beside: Floats = field(default_factory=lambda: np.empty((0, 2)))
    carried: float = 0.0
    scanned: bool = False
    curvature: float = 0.0

    def across(self, side: float | Floats, x: Floats) -> Floats:
        """y of the line on that side (+1 left, -1 right, 0 the centre line) at `x` ahead, driving frame, m."""
        aside = self.offset + side * self.width / 2
        return np.asarray((aside + x * math.sin(self.heading)) / math.cos(self.heading), dtype=np.float64)

    def feet(self) -> tuple[Mask, Floats, Floats]:
        """(N,) which stand on the left line, x and y in the driving frame, m, of the objects that carry the lines."""
        left, x = (
            np.arange(len(self.left_x) + len(self.right_x)) < len(self.left_x),
            np.concatenate((self.left_x, self.right_x)),
        )
        return left, x, self.across(np.where(left, 1.0, -1.0), x)

    def along(self, motion: SE2) -> float:
        """Metres along the row of the motion since the last picture (`T_last_now` of the driving frame)."""
        before = self.heading + motion.yaw
        return motion.x * math.cos(before) + motion.y * math.sin(before)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RowLines:
    """The corridor's two sides in the image.

    Attributes:
        left, right: lines directed away from the camera (v falls); None where there is none.
        kept: (N,) which corner points carried the fit.
        on_left: (N,) which side each of them was given to.
        left_seen, right_seen: False where the line is carried over from earlier pictures.
        reason: why there is no row, a short sentence; empty if both lines are there.
        ground: the corridor, by fitters that work on the ground.
        plant_sides: (M,) +1 for a scanned plant on the left line, -1 on the right, 0 on none; empty without a row.
    """

    left: Line2 | None
    right: Line2 | None
    kept: Mask
    on_left: Mask
    left_seen: bool
    right_seen: bool
    reason: str = ""
    ground: GroundRow | None = None
    plant_sides: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))


class RowLineFitter(Protocol):
    """From corner points to the corridor's two sides."""

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """Fit one picture. Fitters with a memory remember it."""
        ...

    def forget(self) -> None:
        """Start anew: the next picture does not follow the last one."""
        ...


def away_from_camera(line: Line2) -> Line2:
    """The same image line, directed upwards in the image; a level line keeps its direction."""
    return line.reversed() if -line.nx > 0.0 else line


def missing_side(left: Line2 | None, right: Line2 | None) -> str:
    """A short sentence for lines that are not there."""
    if left is None and right is None:
        return "no line of plants on either side"
    return "no line of plants on the left" if left is None else "" if right else "no line of plants on the right"

"""Slope check and memory over frames: paper A's third method (2.3.2, 4, steps 4 and 5), as published."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from navcore.geometry.angles import difference
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints
from navcore.perception.image_lines import image_line
from navcore.perception.row_lines import RowCue, RowLineFitter, RowLines, missing_side


@dataclass(frozen=True, slots=True, kw_only=True)
class SlopeCheckParams:
    """The paper gives neither Q1, Q2 nor T: Q1 and Q2 follow from the camera and the corridor's usual width.

    Attributes:
        corridor_width: m, > 0.
        tolerance_deg: T as an angle, because slopes grow without bound where lines get steep; 0 to 90.
    """

    corridor_width: float = 3.0
    tolerance_deg: float = 7.0


def reference_lines(camera: PinholeCamera, corridor_width: float) -> tuple[Line2, Line2]:
    """The lateral edges of the corridor's trapezoid, left and right, for a robot centred in it."""
    half = corridor_width / 2
    return image_line(camera, offset=half, heading=0.0), image_line(camera, offset=-half, heading=0.0)


class TemporalRansac:
    """Keeps each side's last line that passed the slope check, and shows it again when a new one does not pass.

    As published the memory has no age: a line may be shown for as long as nothing better is seen.
    """

    def __init__(self, fitter: RowLineFitter, camera: PinholeCamera, params: SlopeCheckParams) -> None:
        self._fitter = fitter
        self._reference = reference_lines(camera, params.corridor_width)
        self._tolerance = math.radians(params.tolerance_deg)
        self._previous: tuple[Line2 | None, Line2 | None] = (None, None)

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """This frame's lines where they pass, the previous frame's where not."""
        lines = self._fitter.fit(corners, cue)
        left_ok, right_ok = self._passes(lines.left, 0), self._passes(lines.right, 1)
        left = lines.left if left_ok else self._previous[0]
        right = lines.right if right_ok else self._previous[1]
        self._previous = (left, right)
        reason = missing_side(left, right)
        return replace(lines, left=left, right=right, left_seen=left_ok, right_seen=right_ok, reason=reason)

    def forget(self) -> None:
        """Drop the previous frame's lines."""
        self._previous = (None, None)

    def _passes(self, line: Line2 | None, side: int) -> bool:
        if line is None:
            return False
        return abs(difference(line.heading, self._reference[side].heading)) < self._tolerance

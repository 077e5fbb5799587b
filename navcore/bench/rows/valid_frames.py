"""Row fits on recorded drives: paper A's share of valid frames (3.1.3), and a stricter one against the truth."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.bench.rows.recorded_rows import RecordedFrame, RecordedRowsParams, record_rows
from navcore.geometry.angles import difference
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints, corner_points
from navcore.perception.corridor_track import CorridorTrackerParams
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.image_lines import image_line
from navcore.perception.one_per_foot import one_per_foot
from navcore.perception.row_lines import RowCue, RowLineFitter, RowLines, RowPrior
from navcore.perception.row_perception import RowMethod, RowPerceptionParams, row_line_fitter

# Makes a fitter that has seen nothing yet.
NewFitter = Callable[[], RowLineFitter]
# The published filter, tuned to our camera: beyond 5 m a corridor of 3 m fills the middle of the picture.
PUBLISHED_FILTER = GeometricFilterParams(k1=0.28, k2=0.72, k3=0.0, k4=1.0, k5=0.57)
# The last metres of a row, in which less and less of it is in sight.
LAST_M = 5.0
# Rows of the published tables.
ROWS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidRule:
    """Attributes:
    max_angle_deg: between each fitted line and its reference line.
    max_distance_px: mean distance of a side's points from its line, at 1280 px image width.
    ahead: distances before the driving frame's origin of the true ground points, m.
    """

    max_angle_deg: float = 5.0
    max_distance_px: float = 15.0
    ahead: tuple[float, ...] = (3.5, 4.0, 5.0, 6.0, 7.0, 8.0)

    def at_width(self, width_px: int) -> ValidRule:
        """The same for pictures of that width."""
        return replace(self, max_distance_px=self.max_distance_px * width_px / 1280)


@dataclass(slots=True)
class FrameCounts:
    """Of one method; every frame inside the row counts, and one without a line is not valid.

    Attributes:
        valid: by the paper's rule: direction, and the candidate points near the lines.
        true: direction, and the true ground points near the lines.
        abstained: no line on one of the sides.
    """

    frames: int = 0
    valid: int = 0
    true: int = 0
    abstained: int = 0

    def add(self, *, valid: bool, true: bool, abstained: bool) -> None:
        """One frame."""
        self.frames, self.valid, self.true = self.frames + 1, self.valid + valid, self.true + true
        self.abstained += abstained


@dataclass(frozen=True, slots=True)
class MethodCounts:
    """Frames further than `LAST_M` from the row's end, and those after it; `rows`: the former, by row.

    Paper A drove in `ROWS` rows: our drives take turns.
    """

    row: FrameCounts
    last: FrameCounts
    rows: tuple[FrameCounts, ...]

    @staticmethod
    def zero() -> MethodCounts:
        """Nothing counted yet."""
        return MethodCounts(FrameCounts(), FrameCounts(), tuple(FrameCounts() for _ in range(ROWS)))

    def parts(self, frame: RecordedFrame, drive: int) -> tuple[FrameCounts, ...]:
        """Where a frame of that drive counts."""
        return (self.row, self.rows[drive % ROWS]) if frame.to_end > LAST_M else (self.last,)


def method_fitter(method: RowMethod, camera: PinholeCamera) -> NewFitter:
    """New fitters of one method."""
    return lambda: row_line_fitter(camera, RowPerceptionParams(method=method))


def count_frames(
    new_fitter: NewFitter, camera: PinholeCamera, *, drives: int, seed: int,
    rows: RecordedRowsParams = RecordedRowsParams(), rule: ValidRule = ValidRule(),
) -> MethodCounts:  # fmt: skip
    """One fitter over `drives` recorded drives, the same for every fitter of that seed."""
    counts, limit = MethodCounts.zero(), rule.at_width(camera.width_px)
    for drive in range(drives):
        fitter = new_fitter()
        for frame in record_rows(camera, rows, np.random.default_rng((seed, drive))):
            if frame.to_end <= 0.0:
                break
            corners = candidates(frame, camera)
            lines = fitter.fit(corners, cue(frame))
            valid, true = is_valid(lines, corners, frame, limit), is_true(lines, frame, camera, limit)
            for part in counts.parts(frame, drive):
                part.add(valid=valid, true=true, abstained=lines.left is None or lines.right is None)
    return counts


def cue(frame: RecordedFrame) -> RowCue:
    """What the station knows beside the picture: that there is a row, how the robot moved, how it pitches."""
    vague = CorridorTrackerParams()
    prior = RowPrior(
        offset=0.0, heading=0.0, std=vague.offset_std, heading_std=math.radians(vague.heading_std_deg),
        pitch=frame.told_pitch,
    )  # fmt: skip
    return RowCue(prior=prior, motion=frame.motion)


def candidates(frame: RecordedFrame, camera: PinholeCamera) -> CornerPoints:
    """The candidate points of a frame, as the published chain makes them."""
    single = [frame.objects[i] for i in one_per_foot(frame.objects, camera.width_px)]
    corners = corner_points(single, camera.width_px, camera.height_px)
    mask = geometric_filter(
        corners.points, width_px=camera.width_px, height_px=camera.height_px, params=PUBLISHED_FILTER
    )  # fmt: skip
    return corners.only(mask)


def is_valid(lines: RowLines, corners: CornerPoints, frame: RecordedFrame, limit: ValidRule) -> bool:
    """Paper A's rule: both lines near their reference in direction, and their candidate points near the lines."""
    left = _side_valid(lines.left, frame.left, corners.points[corners.left], limit)
    return left and _side_valid(lines.right, frame.right, corners.points[~corners.left], limit)


def is_true(lines: RowLines, frame: RecordedFrame, camera: PinholeCamera, limit: ValidRule) -> bool:
    """Both lines run where the plants' true lines do in this picture, whatever was detected."""
    tilted = replace(camera, pitch=camera.pitch + frame.pitch)
    return _side_true(lines.left, frame, 1.0, tilted, limit) and _side_true(lines.right, frame, -1.0, tilted, limit)


def _side_true(
    line: Line2 | None, frame: RecordedFrame, side: float, camera: PinholeCamera, limit: ValidRule
) -> bool:
    x, aside = np.asarray(limit.ahead), frame.offset + side * frame.width / 2
    y = aside / math.cos(frame.heading) + x * math.tan(frame.heading)
    points = camera.project(np.column_stack((x, y, np.zeros(len(x)))))
    return _side_valid(line, image_line(camera, offset=aside, heading=frame.heading), points, limit)


def _side_valid(line: Line2 | None, reference: Line2, points: NDArray[np.float64], limit: ValidRule) -> bool:
    if line is None or abs(difference(line.heading, reference.heading)) > math.radians(limit.max_angle_deg):
        return False
    distances = np.abs(line.distances(points))
    return bool(len(distances) == 0 or distances.mean() < limit.max_distance_px)

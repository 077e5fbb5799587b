"""Paper A's measure of a row fit: the share of valid frames (3.1.3), with Wilson intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from navcore.bench.recorded_rows import RecordedFrame, RecordedRowsParams, record_rows
from navcore.geometry.angles import difference
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints, corner_points
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.row_lines import RowCue, RowLines
from navcore.perception.row_perception import RowMethod, RowPerceptionParams, row_line_fitter

# The published filter, tuned to our camera: beyond 5 m a corridor of 3 m fills the middle of the picture.
PUBLISHED_FILTER = GeometricFilterParams(k1=0.28, k2=0.72, k3=0.0, k4=1.0, k5=0.57)


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidRule:
    """Attributes:
    max_angle_deg: between each fitted line and its reference line.
    max_distance_px: mean distance of a side's candidate points from its line, at 1280 px image width.
    """

    max_angle_deg: float = 5.0
    max_distance_px: float = 15.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidRate:
    """Share of valid frames of one method, with its Wilson 95 % interval."""

    method: RowMethod
    valid: int
    frames: int

    @property
    def rate(self) -> float:
        """0 to 1."""
        return self.valid / self.frames

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper bound."""
        return wilson(self.valid, self.frames)


def wilson(successes: int, trials: int, z: float = 1.96) -> tuple[float, float]:
    """Wilson's score interval of a share."""
    if trials == 0:
        return 0.0, 1.0
    p, n = successes / trials, trials
    middle, half = p + z * z / (2 * n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return max(0.0, (middle - half) / (1 + z * z / n)), min(1.0, (middle + half) / (1 + z * z / n))


def valid_rate(
    method: RowMethod, camera: PinholeCamera, *, drives: int, seed: int,
    rows: RecordedRowsParams = RecordedRowsParams(), rule: ValidRule = ValidRule(),
) -> ValidRate:  # fmt: skip
    """Valid frames of one method over `drives` recorded drives, the same for every method of that seed."""
    params = RowPerceptionParams(method=method, filter=PUBLISHED_FILTER)
    valid = frames = 0
    for drive in range(drives):
        fitter = row_line_fitter(camera, params)
        for frame in record_rows(camera, rows, np.random.default_rng((seed, drive))):
            corners = candidates(frame, camera, params)
            lines = fitter.fit(corners, RowCue(motion=frame.motion))
            valid += is_valid(lines, corners, frame, camera, rule)
            frames += 1
    return ValidRate(method=method, valid=valid, frames=frames)


def candidates(frame: RecordedFrame, camera: PinholeCamera, params: RowPerceptionParams) -> CornerPoints:
    """The candidate points of a frame, as the chain makes them."""
    corners = corner_points(frame.objects, camera.width_px, camera.height_px)
    mask = geometric_filter(
        corners.points, width_px=camera.width_px, height_px=camera.height_px, params=params.filter
    )  # fmt: skip
    return corners.only(mask)


def is_valid(
    lines: RowLines, corners: CornerPoints, frame: RecordedFrame, camera: PinholeCamera, rule: ValidRule
) -> bool:
    """Paper A's rule: both lines near their reference in direction, and their candidate points near the lines."""
    limit_px = rule.max_distance_px * camera.width_px / 1280
    limit = replace(rule, max_distance_px=limit_px)
    left = _side_valid(lines.left, frame.left, corners.only(corners.left), limit)
    return left and _side_valid(lines.right, frame.right, corners.only(~corners.left), limit)


def _side_valid(line: Line2 | None, reference: Line2, corners: CornerPoints, limit: ValidRule) -> bool:
    if line is None or abs(difference(line.heading, reference.heading)) > math.radians(limit.max_angle_deg):
        return False
    distances = np.abs(line.distances(corners.points))
    return bool(len(distances) == 0 or distances.mean() < limit.max_distance_px)

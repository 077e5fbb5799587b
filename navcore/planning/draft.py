"""A plan in the making: segments, and every reason why it cannot be driven."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from navcore.messages import PathSegment, PlannedTrunk, SegmentKind
from navcore.planning.driven_row import DrivenRow
from navcore.planning.free_space import PLANTS, FreeSpace
from navcore.planning.params import PlanningParams
from navcore.planning.speeds import planned_speeds
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]

# Every so many poses the body is checked: 0.3 m apart, so that bodies overlap by far.
_CHECKED = 3
# Points of a path are no nearer to each other than this, m.
_NEAREST = 0.03


class Draft:
    """Collects stretches in the order of driving.

    Attributes:
        problems: sentences for the operator.
    """

    def __init__(self, space: FreeSpace, vehicle: VehicleParams, params: PlanningParams) -> None:
        self.space, self._vehicle, self._params = space, vehicle, params
        self.problems: list[str] = []
        self._segments: list[PathSegment] = []

    def add(
        self, kind: SegmentKind, poses: Floats, speeds: float | Floats, *, reverse: bool = False,
        row: DrivenRow | None = None, trunks: tuple[PlannedTrunk, ...] = (), halt: str = "",
    ) -> None:  # fmt: skip
        """Append a stretch along poses (N, 3); `row` as driven in this segment's direction of motion."""
        kept = _spaced(poses)
        if len(kept) < 2:
            return
        wanted = np.broadcast_to(np.asarray(speeds, dtype=np.float64), len(poses))[kept]
        poses = self._joined(poses[kept])
        self._segments.append(
            PathSegment(
                kind=kind, points=_pairs(poses), speeds=tuple(wanted.tolist()), reverse=reverse,
                row_id=row.row.id if row else None, corridor_width=row.row.width if row else None,
                row_start=row.entrance if row else None, row_end=row.far_end if row else None,
                trunks=trunks, halt=halt,
            )
        )  # fmt: skip

    def _joined(self, poses: Floats) -> Floats:
        """The poses, begun where the stretch before them ended: tiny stretches in between were left out."""
        joined = poses.copy()
        if self._segments:
            joined[0, :2] = self._segments[-1].points[-1]
        return joined

    def check(self, poses: Floats, where: str) -> None:
        """Add a problem if the body touches what it must not on poses (N, 3); `where` completes the sentence."""
        poses = np.vstack((poses[:-1:_CHECKED], poses[-1:]))
        hit = self.space.blocked(poses)
        if hit is not None:
            x, y = poses[hit[0], :2]
            self.meets(where, hit[1], (float(x), float(y)))

    def meets(self, where: str, obstacle: str, place: tuple[float, float]) -> None:
        """Add the sentence that the body, margin included, meets an obstacle at a place."""
        plants = obstacle == PLANTS
        margin = (
            self._params.plant_margin if plants or obstacle.endswith("of the headland") else self._params.zone_margin
        )
        advice = "Move the path, or correct the rows." if plants else "Move the path or the zone."
        self.problems.append(
            f"{where[0].upper()}{where[1:]} the robot comes nearer than {margin:.1f} m to {obstacle} "
            f"at ({place[0]:.1f}, {place[1]:.1f}) m. {advice}"
        )

    def finished(self) -> tuple[PathSegment, ...]:
        """The segments, their speeds bounded by curves and eased over each stretch driven one way."""
        done: list[PathSegment] = []
        for _, group in groupby(self._segments, key=lambda segment: segment.reverse):
            done += self._eased(list(group))
        return tuple(done)

    def _eased(self, segments: list[PathSegment]) -> list[PathSegment]:
        points = np.array([p for segment in segments for p in segment.points], dtype=np.float64)
        wanted = np.array([v for segment in segments for v in segment.speeds], dtype=np.float64)
        speeds = planned_speeds(points, wanted, self._vehicle, self._params).round(4)
        parts = np.split(speeds, np.cumsum([len(segment.points) for segment in segments])[:-1])
        return [_with_speeds(segment, part) for segment, part in zip(segments, parts, strict=True)]


def _spaced(poses: Floats) -> list[int]:
    """Indices of poses at least _NEAREST apart, the last one included; rounding makes hooks of nearer ones."""
    if len(poses) > 1 and np.hypot(*np.diff(poses[:, :2], axis=0).T).min() >= _NEAREST:
        return list(range(len(poses)))
    kept = [0]
    for i in range(1, len(poses)):
        if math.dist(poses[i, :2], poses[kept[-1], :2]) >= _NEAREST:
            kept.append(i)
    if kept[-1] != len(poses) - 1 and len(kept) > 1:
        kept[-1] = len(poses) - 1
    return kept


def _pairs(poses: Floats) -> tuple[tuple[float, float], ...]:
    return tuple((x, y) for x, y in poses[:, :2].round(4).tolist())


def _with_speeds(segment: PathSegment, speeds: Floats) -> PathSegment:
    return replace(segment, speeds=tuple(speeds.tolist()))

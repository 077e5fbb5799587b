"""Looks back at the row that is being left, with the camera that looks the other way.

Three metres before a row's end its last plants leave the picture ahead, and until GNSS is good or the next row is in
sight, nothing but odometry would tell where the path lies. The camera behind sees the whole row.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_filter import look_noise
from navcore.localization.row_line import RowLine
from navcore.messages import CameraName, NavMode, PathSegment, RowObservation, SegmentKind
from navcore.mission.evidence import RowEvidence, RowEvidenceParams
from navcore.mission.mode_selector import CARRIED
from navcore.mission.plant_odometer import PlantOdometer
from navcore.mission.route import row_length


@dataclass(frozen=True, slots=True)
class LeftRow:
    """A row as it was driven: its centre line, its corridor's width and its length, m."""

    line: RowLine
    width: float
    length: float

    @staticmethod
    def of(segment: PathSegment | None) -> LeftRow | None:
        """The row of a planned segment, None where it has none."""
        line = RowLine.of(segment)
        if segment is None or line is None:
            return None
        return LeftRow(line, segment.width, row_length(segment))


class LookBack:
    """Ties the path to the row that is left as long as it is seen.

    `row` is that row, None before the first; `active` while it is looked at.
    """

    def __init__(self, anchor: PathAnchor, params: RowEvidenceParams) -> None:
        self._anchor = anchor
        self.row: LeftRow | None = None
        self.active = False
        self._evidence = RowEvidence(params)
        self._odometer = PlantOdometer(anchor)

    @property
    def tie(self) -> SE2:
        """`T_map_odom` by the row that is left."""
        return self._anchor.departed

    @property
    def std(self) -> float:
        """1-sigma of where that row lies across the robot, m."""
        known = self._anchor.behind or self._anchor.row
        return math.sqrt(known.covariance[0, 0])

    def choose(self, mode: NavMode, here: PathSegment, sees_row_ahead: bool) -> bool:
        """Look back on the straight way out of the row, once nothing is seen ahead; True if that begins now."""
        before = self.active
        way_out = mode in CARRIED and here.kind is SegmentKind.EXIT
        self.active = way_out and self.row is not None and not sees_row_ahead
        if self.active and not before:
            self._anchor.look_back()
            self._odometer.begin()
        elif before and not self.active:
            self._anchor.behind = None
        return self.active and not before

    def see(self, seen: RowObservation, T_odom_drive: SE2) -> None:
        """Take an observation by the camera behind; `T_odom_drive` of the driving frame at its capture."""
        if not self.active or self.row is None or seen.offset is None or seen.heading is None:
            return
        offset, row = -seen.offset, self.row
        if not self._evidence.judge(replace(seen, offset=offset), row.line, (self.tie @ T_odom_drive,), row.width):
            return
        # What the robot drives ahead of the plants behind, they tell as less than 0.
        driven = None if seen.driven is None else -seen.driven
        self._odometer.take(row.line, self.tie @ T_odom_drive, driven, seen.driven_since_ns)
        noise = look_noise(seen.offset_std or 0.05, seen.heading_std or 0.02, -seen.correlation)
        self._anchor.see_left(row.line, T_odom_drive, offset, seen.heading, noise)


def other(camera: CameraName) -> CameraName:
    """The camera that looks the other way."""
    return CameraName.FRONT if camera is CameraName.REAR else CameraName.REAR

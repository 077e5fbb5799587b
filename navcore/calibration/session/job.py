"""What the two kinds of calibration have in common, to whoever takes the poses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from navcore.calibration.board import BoardSighting
from navcore.calibration.board_run import PlainScan
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.coverage import Coverage
from navcore.calibration.extrinsics import LidarCamera
from navcore.calibration.found_values import MadeBy
from navcore.calibration.intrinsics import CameraIntrinsics
from navcore.calibration.session.state import Result, Taken
from navcore.messages import BoardOnFloor, LidarScan, RawPicture


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardLook:
    """The board of a live picture. `problem`: why this pose is of no use, a sentence; empty if it is."""

    problem: str = ""
    board: BoardOnFloor | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fitted:
    """What comes of poses.

    Attributes:
        errors: by name of the pose: its error and that when left out. refused: by name why it was left out.
    """

    found: CameraIntrinsics | LidarCamera
    result: Result
    errors: Mapping[str, tuple[float, float | None]]
    refused: Mapping[str, str] = field(default_factory=dict)


class Job(Protocol):
    """A calibration of one kind."""

    def hear(self, scan: LidarScan) -> None:
        """A scan came in."""

    def unfit(self, picture: RawPicture) -> str:
        """Why pictures like this one are of no use, a sentence; empty if they are."""

    def look(self, sighting: BoardSighting, picture: RawPicture, since_ns: int) -> BoardLook:
        """What there is to a board that is still since then."""

    def scan(self, since_ns: int) -> PlainScan | None:
        """All rays since then, to be kept with the picture; None where none are needed."""

    def coverage(self, poses: Sequence[Taken]) -> Coverage:
        """What is missing of those kept."""

    def fit(self, poses: Sequence[Taken]) -> Fitted:
        """Work it out. Raises CalibrationError with every reason. May take seconds."""

    def note(self, fitted: Fitted | None) -> None:
        """The newest result is known."""

    def version(self, fitted: Fitted, made: MadeBy) -> CalibrationVersion:
        """To keep."""

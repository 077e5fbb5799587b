"""What a calibration under way is: what was asked for, what was taken, what came of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_run import PlainScan
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.found_values import FoundValue
from navcore.messages import BoardOnFloor, CalibrationJob, CameraName

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionSetup:
    """What was asked for.

    Attributes:
        robot: its name. rehearsal: with drawn pictures of a simulated board; nothing of it is for the robot.
        camera_version: of a LiDAR's calibration, the lens that it goes by; None for a camera's.
    """

    id: str
    job: CalibrationJob
    camera: CameraName
    board: Board
    robot: str
    began_utc: str
    rehearsal: bool = False
    camera_version: CalibrationVersion | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Taken:
    """A pose that was taken: the board in the picture, for the LiDAR its scan, and whether the person keeps it."""

    sighting: BoardSighting
    scan: PlainScan | None = None
    kept: bool = True

    @property
    def name(self) -> str:
        """Of its picture."""
        return self.sighting.name


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenPose:
    """A pose as the person sees it.

    Attributes:
        kept: by the person. refused: why the fit left it out, a sentence; empty if it did not.
        error, left_out_error: of the fit and of one that had not seen it, px for the camera; sigmas for the LiDAR,
            and no second one. None where there is no fit with it.
    """

    name: str
    kept: bool
    refused: str = ""
    error: float | None = None
    left_out_error: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """What the poses tell.

    Attributes:
        error, left_out_error: of all poses, in `unit`, px or sigmas; the second on pictures left out of the fit.
        boards: of a LiDAR's calibration, the poses from above in the LiDAR's plane.
    """

    values: tuple[FoundValue, ...]
    error: float
    left_out_error: float | None
    unit: str
    poses: int
    boards: tuple[BoardOnFloor, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionState:
    """How it stands.

    Attributes:
        revision: counts the changes. fitting: a result of the newest change is being worked out.
        grid: (3, 4) corners seen in each part of the picture, row by row; empty for the LiDAR.
        enough: so many corners in a part are enough.
        missing: sentences, the most useful first. share: of what is asked for that is there, 0 to 1.
        result: of the newest fit; None where there is none, and then `reasons` say why not.
        truth: of a rehearsal, name and value of what shall be found, in the units of the result.
        resumed: poses that were kept while the calibration was interrupted. lost: files that could not be read.
    """

    setup: SessionSetup
    revision: int
    fitting: bool
    poses: tuple[TakenPose, ...]
    grid: tuple[int, ...]
    enough: int
    missing: tuple[str, ...]
    share: float
    result: Result | None
    reasons: tuple[str, ...]
    truth: tuple[tuple[str, float], ...] = ()
    resumed: int = 0
    lost: tuple[str, ...] = ()

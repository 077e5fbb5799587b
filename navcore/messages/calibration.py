"""What travels between the row worker, who has the camera, and whoever calibrates it, and what people see."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages.camera import CameraName


class CalibrationJob(StrEnum):
    """CAMERA: focal length and lens. LIDAR: where the camera sits to the 2D LiDAR."""

    CAMERA = "camera"
    LIDAR = "lidar"


class BoardPhase(StrEnum):
    """How it stands with the board in the live picture.

    NO_PICTURE: the camera gives none. NO_BOARD: none is found. MOVING: it is not held still yet. KNOWN: it is still,
    but was taken like this before. STILL: it is about to be taken. TAKEN: it was taken just now. OFF_SCAN: the LiDAR
    does not have it.
    """

    NO_PICTURE = "no_picture"
    NO_BOARD = "no_board"
    MOVING = "moving"
    KNOWN = "known"
    STILL = "still"
    TAKEN = "taken"
    OFF_SCAN = "off_scan"


@dataclass(frozen=True, slots=True, kw_only=True)
class RawPictureWanted:
    """Somebody calibrates that camera now; repeated as long as it holds."""

    stamp_ns: int
    camera: CameraName


@dataclass(frozen=True, slots=True, kw_only=True)
class RawPicture:
    """A picture as the lens bends it, whatever calibration is in use; its JPEG travels beside it.

    Attributes:
        width_px, height_px: of the picture; 0 without one.
        problem: why there is none, a sentence, or what is wrong with it; empty when all is well.
        T_lidar_camera: 16 numbers row by row, from the optical axes, m, as mounted by what is in use; None without a
            2D LiDAR.
        truth: of a simulated camera, name and value of each number that shall be found.
    """

    stamp_ns: int
    camera: CameraName
    width_px: int = 0
    height_px: int = 0
    problem: str = ""
    T_lidar_camera: tuple[float, ...] | None = None
    truth: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationInUse:
    """With which stored calibrations the cameras see; cameras that go by the settings are not among them.

    Attributes:
        front, rear: id of the version; empty where the settings hold.
        robot: whose they are.
    """

    stamp_ns: int
    robot: str
    front: str = ""
    rear: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardOnFloor:
    """A board from above in the LiDAR's plane, m: its two ends as the camera tells them, and the rays found on it."""

    name: str
    ends: tuple[tuple[float, float], ...]
    rays: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationView:
    """The live picture's description for the browser while somebody calibrates; its JPEG travels beside it.

    Attributes:
        width_px, height_px: in whose pixels `corners` are; the JPEG may be smaller.
        corners: (u, v) of the board's corners found.
        words: what the person should do or know now, a sentence.
        stillness: how much of the time that a board must be held still has passed, 0 to 1.
        taken: how many poses were taken. revision: counts the changes of what was taken and of its result.
        scan: ends of the newest scan's rays in the LiDAR's plane (x, y), m; none without LiDAR.
        board: the board from above, if it is seen and the LiDAR is being calibrated.
        rehearsal: drawn pictures of a simulated board, not the robot's camera.
    """

    stamp_ns: int
    job: CalibrationJob
    camera: CameraName
    phase: BoardPhase
    words: str
    width_px: int = 0
    height_px: int = 0
    corners: tuple[tuple[float, float], ...] = ()
    stillness: float = 0.0
    taken: int = 0
    revision: int = 0
    scan: tuple[tuple[float, float], ...] = ()
    board: BoardOnFloor | None = None
    rehearsal: bool = False

"""Where the robot believes it is, what it does, and why."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages.camera_mount import CameraMount
from navcore.messages.sensing import FixQuality


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseEstimate:
    """Pose of `base_link` in `map`, with the covariance of (x, y, yaw), row-major 9 numbers."""

    stamp_ns: int
    x: float
    y: float
    yaw: float
    v: float
    omega: float
    covariance: tuple[float, ...]
    source: str


class NavMode(StrEnum):
    """Which source the robot is driving on."""

    IDLE = "idle"
    GNSS_PATH = "gnss_path"
    ROW_ENTRY = "row_entry"
    ROW = "row"
    ROW_END = "row_end"
    HEADLAND = "headland"
    MAP = "map"


class RunState(StrEnum):
    """State of the mission."""

    IDLE = "idle"
    STARTING = "starting"
    DRIVING = "driving"
    HOLDING = "holding"
    PAUSED = "paused"
    STOPPED = "stopped"
    FINISHED = "finished"


@dataclass(frozen=True, slots=True, kw_only=True)
class ActiveEvent:
    """An event of the fault table that is on now.

    Attributes:
        name: key in the table.
        effect: NO_ENTRY, SLOW, HOLD or STOP.
        text: what the operator should know and do.
    """

    name: str
    effect: str
    text: str
    since_ns: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeSwitch:
    """A change of the source driven on, with the numbers that caused it."""

    stamp_ns: int
    before: NavMode
    after: NavMode
    reason: str
    x: float
    y: float
    along_segment: float
    gnss_std: float | None
    row_quality: float | None
    row_offset: float | None
    end_distance: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class NextTrunk:
    """The known trunk that the robot comes to next in its row.

    Attributes:
        side: 1 on the left line, -1 on the right one, for who looks from the row's start on the site to its end,
            wherever the robot drives to: it is the trunk's name.
        number: 1 at that start; `of` stand on the line.
        ahead: along the row, m; a little negative while the robot is beside it.
        exact: the trunks around the robot were recognised within the last metres; else wheels and row's ends tell.
    """

    row_id: str
    side: int
    number: int
    of: int
    ahead: float
    exact: bool


class GhostSource(StrEnum):
    """Who alone would put the robot where."""

    GNSS = "gnss"
    ODOMETRY = "odometry"
    ROWS = "rows"
    MAP = "map"


@dataclass(frozen=True, slots=True, kw_only=True)
class Ghost:
    """Where one source alone puts `base_link` in `map` now, m and rad, and how far that is from the driven pose, m.

    Odometry's is carried from where the mission began; rows know where the robot is across them, not along.
    """

    source: GhostSource
    x: float
    y: float
    yaw: float
    apart: float


@dataclass(frozen=True, slots=True, kw_only=True)
class NavStatus:
    """What the operator sees of the navigator, 20 Hz.

    Attributes:
        lateral_error, heading_error: of the robot from the line it follows now, m and rad; None without one.
        progress: driven part of the mission, 0 to 1.
        remaining: metres to the mission's end.
        speed_limit: m/s after all regulation, with `speed_reason` naming the tightest cause.
        pose: that the robot drives by: in a row, by what it sees of it, relative to the row as drawn.
        stop_reason: why the mission was stopped, kept until it goes on or is acknowledged; else empty.
        gnss_pose: by GNSS, wheels and gyro alone; None in older logs too.
        camera: how the camera that saw a row last is mounted; None before. camera_roll: it leans by so much to the
            right against the IMU, and its 1-sigma, rad.
        trunk: that comes next; None outside rows and where no trunk is known.
        ghosts: what each source says alone, on a robot with a 3D LiDAR.
    """

    stamp_ns: int
    state: RunState
    mode: NavMode
    mode_reason: str
    run_id: str | None
    segment: int
    segments: int
    row_id: str | None
    progress: float
    remaining: float
    lateral_error: float | None
    heading_error: float | None
    v: float
    omega: float
    speed_limit: float
    speed_reason: str
    pose: PoseEstimate | None
    gnss_quality: FixQuality
    gnss_age_s: float | None
    row_age_s: float | None
    battery_v: float | None
    guard: str
    guard_reason: str
    events: tuple[ActiveEvent, ...]
    stop_reason: str = ""
    gnss_pose: PoseEstimate | None = None
    camera: CameraMount | None = None
    camera_roll: tuple[float, float] | None = None
    trunk: NextTrunk | None = None
    ghosts: tuple[Ghost, ...] = ()

"""The vocabulary: frozen data for all that crosses a thread, a process, a log or the browser.

Every `stamp_ns` is the monotonic time of *capture*. SI units are silent, anything else carries a suffix. Frames
follow REP 103/105: `map` is ENU in metres from the site's datum, `base_link` is x forward, y left, z up; pixels are
u right, v down. Angles are radians in (-pi, pi], counter-clockwise from east.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, StrEnum

from navcore.chassis.protocol import ChassisState, MotionCommand
from navcore.chassis.protocol import GuardRequest as GuardRequest

Point = tuple[float, float]


class FixQuality(IntEnum):
    """GGA quality field."""

    NONE = 0
    SINGLE = 1
    DIFFERENTIAL = 2
    PPS = 3
    RTK_FIXED = 4
    RTK_FLOAT = 5
    DEAD_RECKONING = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssFix:
    """One epoch of a receiver.

    Attributes:
        utc_s: receiver's UTC as seconds since 1970, None before it knows date and time.
        lat_deg, lon_deg, height_m: antenna position, ellipsoidal height; None without a position.
        std_east_m, std_north_m, std_up_m: receiver's own 1-sigma, None if not told.
        heading_rad: yaw of `base_link` in ENU from a dual antenna, None without one.
        heading_std_rad: its 1-sigma, None if not told.
        hdop, satellites, correction_age_s: None if not told.
    """

    stamp_ns: int
    utc_s: float | None
    quality: FixQuality
    lat_deg: float | None
    lon_deg: float | None
    height_m: float | None
    std_east_m: float | None = None
    std_north_m: float | None = None
    std_up_m: float | None = None
    heading_rad: float | None = None
    heading_std_rad: float | None = None
    speed: float | None = None
    course_rad: float | None = None
    hdop: float | None = None
    satellites: int | None = None
    correction_age_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ImuSample:
    """Turn rates (rad/s) and specific force (m/s^2) in `base_link`."""

    stamp_ns: int
    wx: float
    wy: float
    wz: float
    ax: float
    ay: float
    az: float


class CameraName(StrEnum):
    """The two cameras of paper A's robot."""

    FRONT = "front"
    REAR = "rear"


class ObjectKind(StrEnum):
    """What the detector knows."""

    TRUNK = "trunk"
    POST = "post"


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectedObject:
    """A box in the image, pixels, origin top left, (x1, y1) top left and (x2, y2) bottom right."""

    kind: ObjectKind
    confidence: float
    x1: float
    y1: float
    x2: float
    y2: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ImagePoint:
    """A corner point: where an object meets the ground, and whether the row fit kept it."""

    u: float
    v: float
    side: str
    kept: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class ImageLine:
    """A line segment in the image, pixels, near end first."""

    u0: float
    v0: float
    u1: float
    v1: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RowObservation:
    """The row ahead as one sensor saw it at `stamp_ns`, in the camera's driving frame.

    The driving frame is `base_link` for the front camera and `base_link` turned by pi for the rear camera, so
    that x always points the way the camera looks.

    Attributes:
        valid: True if there is a line; then all of the line's fields are numbers.
        reason: why there is none, a short sentence; empty when valid.
        offset: signed distance from the driving frame's origin to the centre line, m, positive if the line is left.
        heading: direction of the centre line in the driving frame, rad.
        offset_std, heading_std: 1-sigma.
        quality: 0 to 1.
        width: corridor width, m, None if not known.
        end_distance: distance ahead at which the row ends, m, None if no end is in sight.
        objects: number of trunks and posts that carried the fit.
        left_seen, right_seen: this frame's own evidence for each side (False: carried over from earlier frames).
        image_offset, image_heading: paper A's reading of the image's bisector: lateral deviation of the centre line
            at the look-ahead depth, m, and its angle to the image's vertical, rad; both positive to the left.
    """

    stamp_ns: int
    camera: CameraName
    valid: bool
    reason: str
    offset: float | None = None
    heading: float | None = None
    offset_std: float | None = None
    heading_std: float | None = None
    quality: float = 0.0
    width: float | None = None
    end_distance: float | None = None
    objects: int = 0
    left_seen: bool = False
    right_seen: bool = False
    image_offset: float | None = None
    image_heading: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraView:
    """A picture's description for the browser; the camera's own JPEG travels beside it in the same message.

    `centre` is the corridor's centre line on the ground, `bisector` the published one in the image.
    """

    stamp_ns: int
    camera: CameraName
    width_px: int
    height_px: int
    objects: tuple[DetectedObject, ...]
    points: tuple[ImagePoint, ...]
    left: ImageLine | None
    right: ImageLine | None
    centre: ImageLine | None
    row: RowObservation
    latency_ms: float
    bisector: ImageLine | None = None


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


class SegmentKind(StrEnum):
    """What part of a mission a stretch of the path is."""

    ROAD = "road"
    ENTRY = "entry"
    ROW = "row"
    EXIT = "exit"
    HEADLAND = "headland"


@dataclass(frozen=True, slots=True, kw_only=True)
class PathSegment:
    """A stretch of the path, driven one way.

    Attributes:
        points: (x, y) in `map`, about 0.1 m apart, at least two.
        speeds: wanted speed at each point, m/s, positive also in reverse.
        reverse: driven backwards, looking with the rear camera.
        row_id: the row that is entered, driven, or left; None elsewhere.
        corridor_width: width between the lines of plants, m, where `row_id` is given.
        row_start, row_end: ends of that row's centre line as drawn, `row_start` being the end at which this
            segment's direction of driving enters it.
    """

    kind: SegmentKind
    points: tuple[Point, ...]
    speeds: tuple[float, ...]
    reverse: bool = False
    row_id: str | None = None
    corridor_width: float | None = None
    row_start: Point | None = None
    row_end: Point | None = None


class LinkLossPolicy(StrEnum):
    """What the robot does when no operator's page has been heard of for 5 s."""

    CONTINUE = "continue"
    STOP = "stop"


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionPlan:
    """All that the navigator needs of a mission; immutable once started.

    Attributes:
        datum: (lat_deg, lon_deg, height_m) of the `map` frame's origin, WGS 84.
        keep_in, keep_out: polygons in `map`.
    """

    mission_id: str
    name: str
    datum: tuple[float, float, float]
    segments: tuple[PathSegment, ...]
    keep_in: tuple[tuple[Point, ...], ...] = ()
    keep_out: tuple[tuple[Point, ...], ...] = ()


class NavMode(StrEnum):
    """Which source the robot is driving on."""

    IDLE = "idle"
    GNSS_PATH = "gnss_path"
    ROW_ENTRY = "row_entry"
    ROW = "row"
    ROW_END = "row_end"
    HEADLAND = "headland"


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
class NavStatus:
    """What the operator sees of the navigator, 20 Hz.

    Attributes:
        lateral_error, heading_error: of the robot from the line it follows now, m and rad; None without one.
        progress: driven part of the mission, 0 to 1.
        remaining: metres to the mission's end.
        speed_limit: m/s after all regulation, with `speed_reason` naming the tightest cause.
        stop_reason: why the mission was stopped, kept until it goes on or is acknowledged; else empty.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraRequest:
    """What the row worker should look at, and what it may expect to see.

    Attributes:
        odom_x, odom_y, odom_yaw: smooth dead-reckoned pose of `base_link` at `stamp_ns`, for motion between frames.
        offset, heading: of the wanted row's centre line in the driving frame at `stamp_ns`, as in `RowObservation`;
            None where no row is expected.
        offset_std: 1-sigma of `offset`, m.
        width: corridor width, m.
        to_start: metres ahead at which the wanted row begins (negative inside), by map and odometry.
        to_end: metres ahead at which it ends.
        roll, pitch: how the driving frame leans against the ground, rad (left side up, nose down).
    """

    stamp_ns: int
    camera: CameraName
    odom_x: float
    odom_y: float
    odom_yaw: float
    offset: float | None = None
    heading: float | None = None
    offset_std: float | None = None
    width: float | None = None
    to_start: float | None = None
    to_end: float | None = None
    roll: float = 0.0
    pitch: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """Outcome of one tick.

    Attributes:
        command: for the guard; None means: send nothing (silence means stop).
        switch: set in the tick in which the mode changed.
        camera: what the row worker should look at; None where no row matters.
        guard_request: sent to the guard before the command: ARM in every tick from a deliberate start until the guard
            is ARMED, DISARM at the end of a run, ACKNOWLEDGE after the operator has acknowledged the guard's latch.
        replies: answers to the requests that this tick consumed.
    """

    stamp_ns: int
    command: MotionCommand | None
    status: NavStatus
    switch: ModeSwitch | None
    camera: CameraRequest | None
    guard_request: GuardRequest | None = None
    replies: tuple[Reply, ...] = ()


class RequestKind(StrEnum):
    """What an operator can ask of the navigator. Stop goes to the guard as well, on a socket of its own."""

    START = "start"
    PAUSE = "pause"
    RESUME = "resume"
    STOP = "stop"
    ACKNOWLEDGE = "acknowledge"
    HEARTBEAT = "heartbeat"


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """An operator's request, as the navigator consumed it."""

    kind: RequestKind
    request_id: str
    run_id: str | None = None
    plan: MissionPlan | None = None
    link_loss: LinkLossPolicy = LinkLossPolicy.CONTINUE


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """Answer to a request: accepted, or every reason why not."""

    request_id: str
    accepted: bool
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class NavInputs:
    """All that one tick consumed, oldest first. Logged as consumed: replay feeds it to `step()` again."""

    now_ns: int
    chassis: tuple[ChassisState, ...] = ()
    imu: tuple[ImuSample, ...] = ()
    gnss: tuple[GnssFix, ...] = ()
    rows: tuple[RowObservation, ...] = ()
    requests: tuple[Request, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SimTruth:
    """The simulated world's own truth: pose of `base_link` in `map`. Never an input of the navigator.

    `roll` and `pitch` are against the ground's mean plane, which is what a camera sees; gravity also knows the slope.
    """

    stamp_ns: int
    x: float
    y: float
    yaw: float
    roll: float
    pitch: float
    v: float
    omega: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RecorderStatus:
    """Whether the run is being written down. Driving goes on without.

    Attributes:
        problem: why nothing is written, empty when all is well or nothing was asked for.
    """

    stamp_ns: int
    recording: bool
    run_id: str | None
    size_bytes: int
    problem: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TrueRow:
    """A row as it truly is in the simulated world: its centre line, midway between its plants, in `map`."""

    id: str
    start: Point
    end: Point
    width: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SimFarm:
    """The rows of the simulated world, for the score. Never an input of the navigator."""

    stamp_ns: int
    rows: tuple[TrueRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SimContact:
    """The first instant at which the robot's body truly touches a thing: post, trunk, building or keep_out zone.

    (x, y) is the thing's place in `map`, m.
    """

    stamp_ns: int
    kind: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class NavPrelude:
    """All that the navigator consumed before the run, since it was new: replay begins with it.

    Attributes:
        config: settings of the robot as JSON.
        datum: (lat_deg, lon_deg, height_m) of the site.
        complete: False if there was too much to keep; then the run cannot be replayed exactly.
    """

    stamp_ns: int
    run_id: str
    config: str
    datum: tuple[float, float, float]
    complete: bool
    inputs: tuple[NavInputs, ...]

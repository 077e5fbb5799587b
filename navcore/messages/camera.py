"""What a camera saw, what it makes of the row, and what it is asked to look at."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages.camera_mount import CameraMount, MountAgreement


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
class ImageArea:
    """An area of the image, corners (u, v) in pixels in order."""

    points: tuple[tuple[float, float], ...]


class RowSource(StrEnum):
    """Which sensors a row was seen with."""

    CAMERA = "camera"
    LIDAR = "lidar"
    FUSED = "fused"


@dataclass(frozen=True, slots=True, kw_only=True)
class ScannedPlant:
    """A trunk or post that the 2D LiDAR follows, at the moment of the picture.

    Attributes:
        number: of the plant, the same as long as it is followed.
        x, y: centre in the camera's driving frame, m. diameter: m.
        sureness: 0 to 1, that it is a trunk or a post.
        side: 1 on the row's left line, -1 on its right one, 0 on none.
        object: which of the picture's objects it is, None if the camera does not see it.
    """

    number: int
    x: float
    y: float
    diameter: float
    sureness: float
    side: int
    object: int | None = None


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
        offset_std, heading_std: 1-sigma. correlation: of both errors, in (-1, 1).
        curvature: of the centre line beside the origin, 1/m, positive if it bends to the left; 0 where it is taken to
            be straight, as by a camera alone.
        quality: 0 to 1.
        width: corridor width, m, None if not known.
        end_distance: distance ahead at which the row ends, m, None if no end is in sight.
        seen_to: distance ahead up to which plants stand on its lines without a gap, m: it surely goes on that far;
            None if that cannot be said.
        driven: metres ahead along the row since it came in sight, by the plants that stand there and not by wheels
            that slip; None without a row. driven_since_ns: when it came in sight.
        objects: number of trunks and posts that carried the fit.
        carried: metres by which the row is carried on by odometry, between plants that were seen before; 0 while
            it is seen. A carried row is shown, and nothing is decided by it.
        left_seen, right_seen: this frame's own evidence for each side (False: carried over from earlier frames).
        lean: by so much more than told the camera leans to the side (roll of the driving frame, left side up), rad;
            once every few metres, else None. lean_std: 1-sigma.
        mount: how the camera is mounted, told together with `lean`.
        agreement: of the camera with the LiDAR, whenever another trunk was asked; else None.
        source: the sensors that it was seen with. missing: what is wrong with a sensor that should have helped, in a
            sentence; empty when all is well.
        plants: scanned ones on the row's two lines, nearest first, within 8 m, at most 12; none without 2D LiDAR.
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
    correlation: float = 0.0
    curvature: float = 0.0
    quality: float = 0.0
    width: float | None = None
    end_distance: float | None = None
    seen_to: float | None = None
    driven: float | None = None
    driven_since_ns: int | None = None
    objects: int = 0
    carried: float = 0.0
    left_seen: bool = False
    right_seen: bool = False
    image_offset: float | None = None
    image_heading: float | None = None
    lean: float | None = None
    lean_std: float | None = None
    mount: CameraMount | None = None
    agreement: MountAgreement | None = None
    source: RowSource = RowSource.CAMERA
    missing: str = ""
    plants: tuple[ScannedPlant, ...] = ()

    @property
    def in_sight(self) -> bool:
        """There is a line, and plants were seen that carry it: what may be decided by."""
        return self.valid and self.carried == 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraView:
    """A picture's description for the browser; the camera's own JPEG travels beside it in the same message.

    `centre` is the corridor's centre line on the ground, `bisector` the published one in the image. `left_band` and
    `right_band` are where the lines lie with 95 %, `region` is where corner points count. `plants` are scanned ones,
    `scan` is where the newest scan's rays end in the picture (u, v), `ends` where in the driving frame (x, y), m.
    `bearings` are how far to the left of straight ahead the objects are seen from the camera, rad, which stands
    `camera_x` m ahead of the driving frame's origin.
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
    left_band: ImageArea | None = None
    right_band: ImageArea | None = None
    region: ImageArea | None = None
    plants: tuple[ScannedPlant, ...] = ()
    scan: tuple[tuple[float, float], ...] = ()
    ends: tuple[tuple[float, float], ...] = ()
    bearings: tuple[float, ...] = ()
    camera_x: float = 0.0


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
        land_roll: how the ground there slopes to the side, left side up, rad: plants grow upright on it.
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
    land_roll: float = 0.0

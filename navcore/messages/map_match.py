"""Where a 3D LiDAR's cloud lies on the map."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages.sensing import FixQuality
from navcore.messages.status import PoseEstimate


class MatchState(StrEnum):
    """MATCHED is evidence; every other says why there is none."""

    MATCHED = "matched"
    STARTING = "starting"
    AMBIGUOUS = "ambiguous"
    LOST = "lost"
    NO_MAP = "no_map"


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarCondition:
    """How the 3D LiDAR itself does, whether there is a map or not.

    Attributes:
        points: of the newest turn.
        roll, pitch: of the ground as the LiDAR has it in `base_link`, rad (REP 103); 0 if it sits as its mount says,
            and until enough of the ground was seen.
        air: share of near points that hang in the air as drops do, 0 to 1.
    """

    points: int
    roll: float = 0.0
    pitch: float = 0.0
    air: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MapMatch:
    """One cloud on the map of cells. All but `stamp_ns`, `state`, `reason` and `lidar` is of the newest match that
    there was.

    Attributes:
        stamp_ns: capture of the cloud's last point.
        reason: a sentence's part that says why it is not MATCHED, else empty.
        x, y, z, roll, pitch, yaw: `base_link` in `map`, m and rad.
        covariance: of (x, y, yaw), row-major 9 numbers.
        score: 0 to 1, how well the points fit the cells; a high one does not prove the place.
        alike: so many places fit as well as each other where it is AMBIGUOUS, else 0.
        points: number of points that were matched. latency_ms: from capture to publication.
        passed, gone: posts and trunks of the map that were passed lately, and those of them that are not there.
        lidar: how the sensor does; None where nobody looked.
    """

    stamp_ns: int
    state: MatchState
    reason: str = ""
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0
    covariance: tuple[float, ...] = (0.0,) * 9
    score: float = 0.0
    points: int = 0
    latency_ms: float = 0.0
    passed: int = 0
    gone: int = 0
    lidar: LidarCondition | None = None
    alike: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Odometry:
    """The navigator's motion, for whoever must know how the robot moved during a scan. Frame: `odom`, `base_link`.

    Attributes:
        x, y, yaw: of `base_link` in `odom`, which drifts but never jumps, m and rad. v, omega: m/s and rad/s.
        roll, pitch: against gravity, rad (REP 103).
        pose: in `map` by all that the filter believes, None before it knows. quality: of the newest fix.
        told: where an operator said that the robot stands, carried on since, with how far that may be off; None
            before. told_ns: when it was said.
    """

    stamp_ns: int
    x: float
    y: float
    yaw: float
    v: float
    omega: float
    roll: float
    pitch: float
    pose: PoseEstimate | None
    quality: FixQuality
    told: PoseEstimate | None = None
    told_ns: int = 0

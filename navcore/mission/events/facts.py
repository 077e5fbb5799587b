"""What the table of events looks at, and the limits that it holds it to."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.chassis.protocol import ChassisState
from navcore.messages import CameraMount, LinkLossPolicy, MapMatch, MountAgreement, NavMode, RunState


@dataclass(frozen=True, slots=True, kw_only=True)
class EventParams:
    """Limits of the table; times in s, lengths in m.

    Attributes:
        chassis_s: age of the motion feedback 0x221 (hazard 9). system_s: of the system state 0x211 (hazard 10).
        tick_slow_s, tick_stop_s: time between two ticks (hazard 7).
        gnss_slow_s, gnss_stop_s: age of the position while it is driven on (hazard 27).
        pose_std: dead-reckoned 1-sigma while GNSS is driven on. carried: metres driven on odometry alone.
        entrance: a row that is not seen is not entered: the robot waits so far before its entrance.
        room: least room between body and plants when the robot passes the entrance.
        row_hold_s: age of the row line while it is driven on (hazard 37). hold_stop_s: longest hold.
        gnss_hold_s: longest wait for GNSS at the end of a row.
        off_path_slow, off_path_stop: distance from the path (hazard 50).
        link_s: time without an operator's page (hazard 20).
        arming_s: longest time for the chassis to obey.
        start_distance: from the robot to the mission's start, and from the path before it was first reached.
        askew_deg: a camera that leans further against the IMU, and by twice what is doubtful, has been moved; so has
            one that looks further up or down by `pitched_deg`, or stands higher or lower by `raised` m:
            slipping wheels and feet hidden in grass look like a decimetre.
        map_hold_s, map_std: age of the newest match and position 1-sigma while the 3D map is driven on.
        lidar3d_deg: a 3D LiDAR that leans or looks further aside against its mount has been moved.
        lidar3d_least: with fewer points in a turn it sees nothing.
        air: share of its near points that hang in the air, from which it rains, snows or is dusty, 0 to 1.
        gone, passed: share of the 3D map's posts and trunks that are not there any more, 0 to 1, and how many must
            have been passed before that is said.
        battery_low_v: warn and slow (hazard 52). battery_stop_v: stop.
    """

    chassis_s: float = 0.2
    system_s: float = 0.5
    tick_slow_s: float = 0.1
    tick_stop_s: float = 0.2
    gnss_slow_s: float = 1.0
    gnss_stop_s: float = 2.8
    pose_std: float = 0.6
    carried: float = 30.0
    entrance: float = 1.5
    room: float = 0.12
    row_hold_s: float = 0.42
    hold_stop_s: float = 20.0
    gnss_hold_s: float = 90.0
    off_path_slow: float = 0.3
    off_path_stop: float = 0.5
    link_s: float = 5.0
    arming_s: float = 5.0
    start_distance: float = 3.0
    askew_deg: float = 3.0
    pitched_deg: float = 2.5
    raised: float = 0.2
    map_hold_s: float = 0.6
    map_std: float = 0.25
    lidar3d_deg: float = 2.5
    lidar3d_least: int = 100
    air: float = 0.09
    gone: float = 0.07
    passed: int = 12
    battery_low_v: float = 23.5
    battery_stop_v: float = 22.0


@dataclass(frozen=True, slots=True, kw_only=True)
class EventFacts:
    """What the table looks at in one tick, `pose_cap` in m/s being what the second opinion on the pose allows.

    `pose_cap_passes`: it may pass by itself. Ages are None where nothing came; `captured`: the path was reached;
    `entrance`: metres to that of a row which is driven at without being seen; `room`: metres between body and plants
    on the narrower side of a seen one that is near; `askew`: how far the camera leans to the right against the IMU,
    and its 1-sigma, rad; `mount`: how else it is mounted; `agreement`: whether it agrees with the 2D LiDAR; `halt`:
    what the operator is told where the plan lets the robot wait; `map_reason`: why the 3D map does not tell the
    place, empty while it does, and `map_disputed`: it would, but other witnesses contradict it; `map_in_use`: there
    is one, and a 3D LiDAR that reports; `map_match`: its newest word, and `lidar3d_turned`: how far to the left it
    looks, rad.
    """

    state: RunState
    mode: NavMode
    tick_s: float
    chassis: ChassisState | None
    chassis_age_s: float | None
    system_age_s: float | None
    pose_std: float | None
    carried: float
    gnss_age_s: float | None
    pose_cap: float | None
    pose_cap_reason: str
    pose_cap_passes: bool
    row_age_s: float | None
    row_reason: str
    entrance: float | None
    room: float | None
    lateral_error: float | None
    captured: bool
    stuck: bool
    held_s: float
    arming_s: float
    link_age_s: float
    link_loss: LinkLossPolicy
    zone: str
    start_distance: float | None
    waiting_for_gnss: bool
    askew: tuple[float, float]
    mount: CameraMount | None = None
    agreement: MountAgreement | None = None
    halt: str = ""
    map_age_s: float | None = None
    map_reason: str = ""
    map_disputed: bool = False
    map_match: MapMatch | None = None
    lidar3d_turned: float = 0.0
    map_in_use: bool = False

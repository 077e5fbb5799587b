"""What a test can break in the simulated world."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.sim.lidar2d import LidarFaults


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldFaults:
    """Faults that a test can switch on at any instant, by replacing `World.faults`.

    Attributes:
        gnss_silent: the receiver sends nothing. gnss_frozen: fresh times, old position.
        corrections_lost: no RTK corrections arrive. gnss_off: it lies by so much east and north, m.
        imu_silent, imu_frozen: likewise.
        wheels_frozen: the chassis reports its last wheel state with fresh stamps.
        stuck: the wheels turn and the robot stays.
        drive_gain: the chassis drives so many times what it was told.
        lidar: what is wrong with the LiDAR.
    """

    gnss_silent: bool = False
    gnss_frozen: bool = False
    corrections_lost: bool = False
    gnss_off: tuple[float, float] = (0.0, 0.0)
    imu_silent: bool = False
    imu_frozen: bool = False
    wheels_frozen: bool = False
    stuck: bool = False
    drive_gain: float = 1.0
    lidar: LidarFaults = LidarFaults()

"""What the pilot is told of the robot in each tick."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.mission.mode_facts import ModeSelectorParams


@dataclass(frozen=True, slots=True, kw_only=True)
class Position:
    """The robot at one moment, by everything that says where it is.

    Attributes:
        T_odom_base: smooth dead-reckoned pose.
        T_map_base: the pose filter's, None without one.
        gnss_std, gnss_streak: see `ModeFacts`.
        standing: the robot does not move.
        yaw_std: 1-sigma of the yaw of T_map_base, rad.
        lean: (roll, pitch) of `base_link` against the ground, rad.
        roll: of `base_link` against gravity, rad, left side up. land_roll: of the ground there.
    """

    now_ns: int
    T_odom_base: SE2
    T_map_base: SE2 | None
    gnss_std: float | None
    gnss_streak: int
    standing: bool
    yaw_std: float = 0.0
    lean: tuple[float, float] = (0.0, 0.0)
    roll: float = 0.0
    land_roll: float = 0.0

    def surely_at(self, std: float) -> SE2 | None:
        """The pose if it is known to `std` m."""
        return self.T_map_base if self.gnss_std is not None and self.gnss_std <= std else None

    def gnss_good(self, params: ModeSelectorParams) -> bool:
        """Good enough to say which row is which."""
        return self.gnss_std is not None and self.gnss_std <= params.gnss_std and self.gnss_streak > 0

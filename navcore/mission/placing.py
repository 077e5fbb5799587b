"""Where an operator said that the robot stands, carried on by what it has driven since."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.messages import PoseEstimate, ToldPlace


@dataclass(frozen=True, slots=True, kw_only=True)
class PlacingParams:
    """Parameters of `Placing`: how far a press on the map and a turned arrow may be off.

    Attributes:
        std: 1-sigma, m; three of them are the metre and a half that a person on the spot is sure of.
        yaw_std: the same of the direction, rad; three are 30 deg.
        lasts: farther from there, m, the wheels' own errors are no less.
    """

    std: float = 0.5
    yaw_std: float = math.radians(10.0)
    lasts: float = 15.0


class Placing:
    """Attributes:
    told_ns: when it was said last; 0 before.
    """

    def __init__(self, params: PlacingParams = PlacingParams()) -> None:
        self._p = params
        self._T_map_odom: SE2 | None = None
        self._T_odom_told = SE2()
        self.told_ns = 0

    def hear(self, now_ns: int, place: ToldPlace, T_odom_base: SE2) -> None:
        """The newest word counts."""
        self._T_map_odom = SE2(place.x, place.y, place.yaw) @ T_odom_base.inverse()
        self._T_odom_told = T_odom_base
        self.told_ns = now_ns

    def forget(self) -> None:
        """The robot knows its place: an old word must not lead it astray later."""
        self._T_map_odom = None

    def estimate(self, now_ns: int, T_odom_base: SE2) -> PoseEstimate | None:
        """Where that puts `base_link` in `map` now, None without a word that still counts."""
        driven = math.hypot(T_odom_base.x - self._T_odom_told.x, T_odom_base.y - self._T_odom_told.y)
        if self._T_map_odom is None or driven > self._p.lasts:
            return None
        at, p = self._T_map_odom @ T_odom_base, self._p
        covariance = (p.std**2, 0.0, 0.0, 0.0, p.std**2, 0.0, 0.0, 0.0, p.yaw_std**2)
        return PoseEstimate(
            stamp_ns=now_ns, x=at.x, y=at.y, yaw=at.yaw, v=0.0, omega=0.0, covariance=covariance, source="told"
        )

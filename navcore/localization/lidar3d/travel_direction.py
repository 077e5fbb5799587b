"""Whether a 3D LiDAR looks where its mount says: a robot that drives straight goes where it points.

A LiDAR that is turned aside in its mount lays its clouds on the map as well as before, and tells a heading that is
wrong by as much; the way between two places is not.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from statistics import median

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2


@dataclass(frozen=True, slots=True, kw_only=True)
class TravelDirectionParams:
    """Parameters of `TravelDirection`.

    Attributes:
        step: between two places whose direction is asked, m. straight: it turns no more on the way, rad.
        looks, few: the median of so many steps is told, and nothing before there are few.
    """

    step: float = 0.5
    straight: float = 0.05
    looks: int = 20
    few: int = 6


class TravelDirection:
    """Fed with places on the map and by odometry.

    Attributes:
        turned: how far the LiDAR looks to the left of where its mount says, rad; None before enough was driven.
    """

    def __init__(self, params: TravelDirectionParams = TravelDirectionParams()) -> None:
        self._p = params
        self.turned: float | None = None
        self._looks: deque[float] = deque(maxlen=params.looks)
        self._last: tuple[SE2, SE2] | None = None

    def add(self, T_map_base: SE2, T_odom_base: SE2) -> None:
        """The same moment on the map and by odometry."""
        if self._last is None:
            self._last = (T_map_base, T_odom_base)
            return
        moved, driven = self._last[0].inverse() @ T_map_base, self._last[1].inverse() @ T_odom_base
        if math.hypot(driven.x, driven.y) < self._p.step:
            return
        self._last = (T_map_base, T_odom_base)
        if abs(driven.yaw) <= self._p.straight and math.hypot(moved.x, moved.y) > 0.0:
            self._looks.append(wrap(math.atan2(driven.y, driven.x) - math.atan2(moved.y, moved.x)))
            self.turned = median(self._looks) if len(self._looks) >= self._p.few else None

    def pause(self) -> None:
        """The places end here; what follows is not compared with them."""
        self._last = None

"""Where the planned path lies: the plan's `map` tied to the smooth odometry frame.

On the road the tie is the pose filter's. In a row it is what the camera sees: the drawn row is laid onto the seen
one, so that errors of the map and of GNSS under the canopy do not matter. Between them it is carried by odometry. A
change of source never makes the robot jump: the tie that is followed slides to the wanted one at a bounded rate.
"""

from __future__ import annotations

import math
from copy import deepcopy

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.localization.along_filter import AlongFilter
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.path_slide import PathSlide
from navcore.localization.row_bend import RowBend
from navcore.localization.row_filter import RowFilter
from navcore.localization.row_line import RowLine
from navcore.localization.wheel_slip import WheelSlip

Floats = NDArray[np.float64]


class PathAnchor:
    """Ties `map` to `odom` by whichever source the robot drives on. Poses are of the driving frame.

    `put_back` are the metres by which rows have put the robot back, less those ahead: what the wheels told too many.
    `departed` is the tie by which the last row was left, carried on by odometry and put right by looks back at it;
    `behind` is how well it is known then, None where nobody looks back.
    `row_heading` is the direction in `map` of the row seen last, rad: along and across it the variances are meant.
    """

    def __init__(self, T_map_odom: SE2, params: PathAnchorParams) -> None:
        self.params = params
        self.T_map_odom = T_map_odom
        self.followed = self.departed = T_map_odom
        self.row, self.along = RowFilter(params.row), AlongFilter(params)
        self.bend: RowBend | None = None
        self.behind: RowFilter | None = None
        self._slide = PathSlide(params.slide)
        self.put_back = self.row_heading = 0.0
        self.slip = WheelSlip(params.slip)
        self._left = False
        self.unsure()

    def unsure(self) -> None:
        """Forget how well the drawn row is known: the next row is told by the map alone."""
        p = self.params
        self.row.unsure(p.map_lateral, p.map_heading)
        self.row.new_gyro()
        self.along.unsure()
        self.slip.begin()

    def next_row(self) -> None:
        """Another row, reached from the last one: the map knows their distance better than their place."""
        p = self.params
        self.row.unsure(max(math.sqrt(self.row.covariance[0, 0]), p.next_lateral), p.map_heading)
        self.along.next_row()
        self.departed = self.T_map_odom
        self.slip.begin()

    @property
    def departed_stds(self) -> tuple[float, float]:
        """1-sigma of where the next row lies by `departed`: across it, m, and its direction, rad."""
        p, growth = self.params, self.params.row
        across = math.sqrt(p.next_lateral**2 + growth.growth_lateral**2 * self.along.driven)
        return across, math.sqrt(p.map_heading**2 + growth.growth_heading**2 * self.along.driven)

    def drive(self, distance: float, dt: float, T_odom_now: SE2, slope: float = 0.0) -> None:
        """Let the uncertainty grow over `distance` m, driven in `dt` s; turn by what the gyro tells too little.

        `slope` as in `RowFilter.drive`.
        """
        d = abs(distance)
        self.along.drive(d)
        if self.behind is not None:
            self.behind.drive(d, dt, slope)
        turned = T_odom_now @ SE2(0.0, 0.0, self.row.drive(d, dt, slope)) @ T_odom_now.inverse()
        self.T_map_odom, self.departed = self.T_map_odom @ turned, self.departed @ turned

    def leave(self) -> None:
        """The rows are left for the road."""
        self.departed, self._left = self.T_map_odom, True
        self.unsure()

    def follow_pose(self, T_map_base: SE2, T_odom_base: SE2, yaw_std: float) -> None:
        """Take the pose filter's tie; its direction, 1-sigma `yaw_std` rad, with that of the row that was left.

        Under leaves the filter's direction is degrees off, and mends only metres after its place.
        """
        by_row, p = (self.departed @ T_odom_base).yaw, self.params
        row_std = p.left_heading + p.left_growth * self.along.driven
        share = row_std**2 / (row_std**2 + yaw_std**2) if self._left else 1.0
        yaw = by_row + share * wrap(T_map_base.yaw - by_row)
        self.T_map_odom = SE2(T_map_base.x, T_map_base.y, wrap(yaw)) @ T_odom_base.inverse()

    def drift(self, T_odom_before: SE2, T_odom_now: SE2, moved: tuple[float, float]) -> None:
        """The robot has moved by `moved` m in `map`, whatever the wheels say; its turn is the gyro's."""
        before, now = self.T_map_odom @ T_odom_before, self.T_map_odom @ T_odom_now
        slip = SE2(before.x + moved[0] - now.x, before.y + moved[1] - now.y, 0.0)
        self.T_map_odom, self.departed = slip @ self.T_map_odom, slip @ self.departed

    def slip_back(self, T_odom_before: SE2, T_odom_now: SE2) -> None:
        """Where nothing else says how far the robot has moved: as far as the wheels tell, less their usual slip."""
        before, now, share = self.T_map_odom @ T_odom_before, self.T_map_odom @ T_odom_now, self.slip.share
        told = math.hypot(now.x - before.x, now.y - before.y)
        lost = share * told
        self.slip.drive(told, lost)
        self.along.hold_back(lost)
        self.drift(
            T_odom_before, T_odom_now, ((1.0 - share) * (now.x - before.x), (1.0 - share) * (now.y - before.y))
        )

    def see_row(
        self, row: RowLine, T_odom_drive: SE2, offset: float, heading: float, noise: Floats, curvature: float = 0.0
    ) -> None:  # fmt: skip
        """Lay the drawn row onto the seen centre line (`offset`, `heading`, `curvature` as in RowObservation, at
        capture). `noise` (2, 2) is the covariance of the first two.
        """
        self.row_heading = row.heading
        self._go_along_bend(T_odom_drive)
        at = row.coordinates(self.T_map_odom @ T_odom_drive)
        innovation = np.array((-offset - at.y, wrap(-heading - at.yaw)))
        across, turn = self.row.look(innovation, noise, inside=at.x > 0.0)
        self._set(row.pose(SE2(at.x, at.y + across, at.yaw + turn)), T_odom_drive)
        self.bend = RowBend(row, at.x, curvature) if curvature else None

    def straighten(self, T_odom_drive: SE2) -> None:
        """From here on the row is straight as it is drawn; here the path stays where it is."""
        self._go_along_bend(T_odom_drive)
        self.bend = None

    def _go_along_bend(self, T_odom_drive: SE2) -> None:
        """Lay the drawn row onto the seen one where the robot is now, as it bends: that is no error of odometry."""
        if self.bend is None:
            return
        step = self.bend.step(self.T_map_odom @ T_odom_drive)
        self.T_map_odom, self.followed = step @ self.T_map_odom, step @ self.followed

    def look_back(self) -> None:
        """From now on the row that is being left is seen from its end."""
        self.departed, self.behind = self.T_map_odom, deepcopy(self.row)
        self.behind.turn_back()

    def see_left(self, row: RowLine, T_odom_drive: SE2, offset: float, heading: float, noise: Floats) -> None:
        """Lay the row that was left onto its seen centre line, and the path with it; as in `see_row`."""
        if self.behind is None:
            return
        at = row.coordinates(self.departed @ T_odom_drive)
        innovation = np.array((-offset - at.y, wrap(-heading - at.yaw)))
        across, turn = self.behind.look_back(innovation, noise)
        put_right = row.pose(SE2(at.x, at.y + across, at.yaw + turn)) @ T_odom_drive.inverse()
        self.T_map_odom = put_right @ self.departed.inverse() @ self.T_map_odom
        self.departed = put_right

    def lose(self, heading: float, metres: float) -> None:
        """Of the way that was driven in that direction, rad in `map`, so many metres were not driven."""
        self.slip.lose(metres)
        back = SE2(-metres * math.cos(heading), -metres * math.sin(heading), 0.0)
        self.T_map_odom, self.departed = back @ self.T_map_odom, back @ self.departed

    def see_along(self, row: RowLine, T_odom_drive: SE2, along: float, std: float) -> None:
        """Correct the position along the row: `along` is the row coordinate x of the driving frame, m."""
        ahead = self.along.see(along - row.coordinates(self.T_map_odom @ T_odom_drive).x, std)
        if ahead is not None:
            self._shift(row, T_odom_drive, ahead)
            self.slip.see_end()

    def see_no_end(self, row: RowLine, T_odom_drive: SE2, at_most: float) -> None:
        """The row goes on, so the driving frame's row coordinate x is no larger than `at_most`, m."""
        back = self.along.see_beyond(row.coordinates(self.T_map_odom @ T_odom_drive).x - at_most)
        if back > 0.0:
            self._shift(row, T_odom_drive, -back)

    def _shift(self, row: RowLine, T_odom_drive: SE2, ahead: float) -> None:
        """Move the place along the row."""
        self.put_back -= ahead
        self.slip.lose(-ahead)
        at = row.coordinates(self.T_map_odom @ T_odom_drive)
        self._set(row.pose(SE2(at.x + ahead, at.y, at.yaw)), T_odom_drive)

    def _set(self, T_map_drive: SE2, T_odom_drive: SE2) -> None:
        self.T_map_odom = T_map_drive @ T_odom_drive.inverse()

    def slide(
        self, T_odom_drive: SE2, dt: float, driven: float, heading: float, lateral_error: float = 0.0,
        gentle: bool = False,
    ) -> SE2:  # fmt: skip
        """Move the followed tie towards the wanted one, `dt` s and `driven` m after the last time.

        `heading`, `lateral_error` and `gentle` as in `PathSlide`. Returns the followed pose of the driving frame.
        """
        at, wanted = self.followed @ T_odom_drive, self.T_map_odom @ T_odom_drive
        pose = self._slide.towards(
            at, wanted, heading, lateral_error, self._slide.reach(dt, abs(driven), gentle=gentle)
        )
        self.followed = pose @ T_odom_drive.inverse()
        return pose

    def jump(self) -> None:
        """Follow the wanted tie at once (allowed at standstill only)."""
        self.followed = self.T_map_odom

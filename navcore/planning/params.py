"""What the planner assumes of room, speed and turning."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningParams:
    """Lengths in m, speeds in m/s.

    Attributes:
        step: spacing of the path's points.
        radii: turning radii to try, widest first; wider is driven faster and truer.
        entry_length, least_entry: straight run along the row's axis before its entrance, wanted and at least: the
            camera must see the row before the robot is in it.
        entry_inside: how far the entry reaches into the row.
        exit_inside: how far before the row's end the exit begins.
        exit_length: straight run past the row's end, more where more is free.
        turn_exit, turn_entry: straight run past the end of a row and before the next one that a turn over the
            headland leaves where there is room: sources change while it is driven, and a row's end that is seen some
            decimetres off, which in a turn puts the robot beside its path, does not there.
        reverse_stop: distance from the far end at which the robot stops to drive back out.
        zone_margin: free between swept body and zone edges.
        plant_margin: free between swept body and plant lines, whose half thickness is `plant_radius`.
        turn_speed: on headlands and between row and road.
        slowest: no planned speed is below this.
        turn_share: share of the possible turn rate that curves may use.
        max_lateral_acceleration: m/s^2, as in the speed regulation.
        braking: m/s^2 along the path between planned speeds.
        lane_join: lanes whose ends come this near to another lane are connected.
        early_leave: how far before a waypoint's corner the path may leave the lane towards a row or the warehouse.
        row_margin: free on both sides of the body in a row, at least.
    """

    step: float = 0.1
    radii: tuple[float, ...] = (1.5, 1.2, 0.9)
    entry_length: float = 6.0
    least_entry: float = 1.5
    entry_inside: float = 3.0
    exit_inside: float = 3.0
    exit_length: float = 1.5
    turn_exit: float = 3.5
    turn_entry: float = 5.0
    reverse_stop: float = 1.0
    zone_margin: float = 0.30
    plant_margin: float = 0.20
    plant_radius: float = 0.10
    turn_speed: float = 0.5
    slowest: float = 0.15
    turn_share: float = 0.75
    max_lateral_acceleration: float = 0.5
    braking: float = 0.4
    lane_join: float = 3.0
    early_leave: float = 8.0
    row_margin: float = 0.15

    @property
    def exits(self) -> tuple[float, ...]:
        """Straight runs past a row's end to choose from, m."""
        return tuple(self.exit_length + extra for extra in (0.0, 1.0, 2.0, 3.5))

    def turn_rate(self, vehicle: VehicleParams) -> float:
        """Turn rate on the ground that paths may count on, rad/s."""
        return self.turn_share * vehicle.max_turn_rate / vehicle.turn_track_ratio

    def curve_speeds(self, curvature: Floats, vehicle: VehicleParams) -> Floats:
        """Highest speeds (N,) on curves of those curvatures (N,), 1/m."""
        k = np.maximum(np.abs(curvature), 1e-6)
        bounds = np.minimum(self.turn_rate(vehicle) / k, np.sqrt(self.max_lateral_acceleration / k))
        return np.maximum(bounds, self.slowest)


def straight_cost(length: float, wanted: float) -> float:
    """Of a straight run, m of way: what is missing of the wanted one counts threefold."""
    return length + 3.0 * max(wanted - length, 0.0)

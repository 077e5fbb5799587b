"""Vehicle profiles: what the planner, the controller and the simulator know of a robot's body."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class VehicleParams:
    """Footprint and limits of a differential or skid-steer robot.

    Attributes:
        length, width, height: body, m. The body is centred on `base_link`.
        wheelbase, track: between the axles and between left and right wheels, m.
        wheel_diameter: m.
        mass, payload: kg.
        max_speed: m/s.
        max_turn_rate: rad/s.
        max_acceleration: m/s^2, also used for braking.
        max_angular_acceleration: rad/s^2.
        turn_track_ratio: effective track / track when turning (skid steering turns less than its wheels say).
        antenna_x, antenna_y, antenna_height: main GNSS antenna in `base_link`, m.
    """

    name: str
    length: float
    width: float
    height: float
    wheelbase: float
    track: float
    wheel_diameter: float
    mass: float
    payload: float
    max_speed: float
    max_turn_rate: float
    max_acceleration: float
    max_angular_acceleration: float
    turn_track_ratio: float
    antenna_x: float = 0.0
    antenna_y: float = 0.0
    antenna_height: float = 1.2


PAPER_A = VehicleParams(
    name="transport robot (paper A)", length=1.160, width=0.815, height=0.620, wheelbase=0.74, track=0.70,
    wheel_diameter=0.30, mass=90.0, payload=60.0, max_speed=1.3, max_turn_rate=0.75, max_acceleration=1.0,
    max_angular_acceleration=2.0, turn_track_ratio=1.6,
)  # fmt: skip
SCOUT_2 = VehicleParams(
    name="AgileX Scout 2.0", length=1.080, width=0.726, height=0.336, wheelbase=0.648, track=0.576,
    wheel_diameter=0.33, mass=50.0, payload=50.0, max_speed=1.5, max_turn_rate=0.75, max_acceleration=1.2,
    max_angular_acceleration=2.0, turn_track_ratio=1.6,
)  # fmt: skip
PAPER_B = VehicleParams(
    name="tracked robot (paper B)", length=1.0, width=0.70, height=0.50, wheelbase=0.60, track=0.55,
    wheel_diameter=0.20, mass=80.0, payload=60.0, max_speed=2.0, max_turn_rate=1.0, max_acceleration=1.0,
    max_angular_acceleration=2.0, turn_track_ratio=1.5,
)  # fmt: skip

PROFILES: dict[str, VehicleParams] = {"paper_a": PAPER_A, "scout_2": SCOUT_2, "paper_b": PAPER_B}

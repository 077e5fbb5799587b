"""The table of processes: what runs, with which arguments, in which order it starts. It ends the other way round."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from navcore.runtime.simulation import SimulationParams
from navcore.transport.endpoints import Endpoints
from navcore.vehicle import PROFILES, VehicleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class CanSettings:
    """Arguments of python-can. `options` are the interface's own whole numbers."""

    interface: str = "socketcan"
    channel: str = "can0"
    options: dict[str, int] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """All that the processes of one robot are started with.

    Attributes:
        bus: directory of the sockets. site: map of the farm as JSON.
        vehicle: key of `vehicle.PROFILES`. config: settings, TOML; None takes the defaults.
        can, gnss: chassis and receiver; simulated ones if `simulation` is given.
        calibration: folder of the real robot's stored calibrations, and `name` whose they are; None for none.
    """

    bus: Path
    site: Path
    vehicle: str
    can: CanSettings
    gnss: str
    config: Path | None = None
    simulation: SimulationParams | None = None
    calibration: Path | None = None
    name: str = ""

    def vehicle_params(self) -> VehicleParams:
        """The profile."""
        return PROFILES[self.vehicle]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcessSpec:
    """One process.

    Attributes:
        module: run with `python -m`.
        arguments: of the command line.
        simulated_only: not started on a real robot.
        wanted: whether a robot needs it at all.
        knows_site: ended and started anew when the farm changes.
        knows_calibration: ended and started anew when another calibration is put in use.
        patience_s: from SIGTERM to SIGKILL.
    """

    name: str
    module: str
    arguments: Callable[[Robot], tuple[str, ...]]
    simulated_only: bool = False
    wanted: Callable[[Robot], bool] = lambda robot: True
    knows_site: bool = False
    knows_calibration: bool = False
    patience_s: float = 5.0


def guard_arguments(robot: Robot) -> tuple[str, ...]:
    """The guard takes paths, for it knows nothing of ours."""
    endpoints, limits = Endpoints(robot.bus), robot.vehicle_params()
    options = [part for name, value in robot.can.options.items() for part in ("--option", f"{name}={value}")]
    return (
        "--command", str(endpoints.guard_command), "--stop", str(endpoints.guard_stop),
        "--state", str(endpoints.chassis_state), "--interface", robot.can.interface, "--channel", robot.can.channel,
        "--max-speed", str(limits.max_speed), "--max-turn-rate", str(limits.max_turn_rate),
        *options,
    )  # fmt: skip


def navigator_arguments(robot: Robot) -> tuple[str, ...]:
    """See navigator_process."""
    motion = ("--tell-motion",) if has_lidar3d(robot) else ()
    return (*_bus(robot), *_site(robot), "--gnss", robot.gnss, *_config(robot), *motion)


def world_arguments(robot: Robot) -> tuple[str, ...]:
    """See world_process."""
    return (
        *_bus(robot), *_site(robot), "--vehicle", robot.vehicle, "--gnss-port", robot.gnss.rpartition(":")[2],
        "--channel", robot.can.channel, "--can-port", str(robot.can.options["port"]), *_simulation(robot),
    )  # fmt: skip


def row_worker_arguments(robot: Robot) -> tuple[str, ...]:
    """See row_worker."""
    drawn = () if robot.simulation is None else _simulation(robot)
    return (*_bus(robot), *_site(robot), *_config(robot), *_calibration(robot), *drawn)


def has_lidar3d(robot: Robot) -> bool:
    """Simulated or real."""
    if robot.simulation is not None:
        return robot.simulation.lidar3d
    if robot.config is None:
        return False
    # Here, because the settings name every room of the robot: without a file of them nothing waits for those.
    from navcore.config import load_config

    return bool(load_config(robot.config).lidar3d.model)


PROCESSES: tuple[ProcessSpec, ...] = (
    ProcessSpec(
        name="world", module="navcore.runtime.world_process", arguments=world_arguments, simulated_only=True,
        knows_site=True,
    ),
    ProcessSpec(name="guard", module="navcore.chassis.guard_process", arguments=guard_arguments),
    ProcessSpec(
        name="recorder", module="navcore.recording.recorder_process", arguments=lambda robot: _bus(robot),
        patience_s=20.0,
    ),
    ProcessSpec(
        name="navigator", module="navcore.runtime.navigator_process", arguments=navigator_arguments, knows_site=True
    ),
    ProcessSpec(
        name="row_worker", module="navcore.runtime.row_worker", arguments=row_worker_arguments, knows_site=True,
        knows_calibration=True,
    ),
    ProcessSpec(
        name="scan_worker", module="navcore.runtime.scan_worker", arguments=row_worker_arguments, wanted=has_lidar3d,
        knows_site=True,
    ),
    ProcessSpec(name="station", module="backend", arguments=lambda robot: ()),
)  # fmt: skip


def _bus(robot: Robot) -> tuple[str, ...]:
    return ("--bus", str(robot.bus))


def _site(robot: Robot) -> tuple[str, ...]:
    return ("--site", str(robot.site))


def _config(robot: Robot) -> tuple[str, ...]:
    return () if robot.config is None else ("--config", str(robot.config))


def _calibration(robot: Robot) -> tuple[str, ...]:
    return () if robot.calibration is None else ("--calibration", str(robot.calibration), "--robot", robot.name)


def _simulation(robot: Robot) -> tuple[str, ...]:
    return ("--simulation", msgspec.json.encode(robot.simulation or SimulationParams()).decode())

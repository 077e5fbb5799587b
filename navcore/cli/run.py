"""`rowpilot run`: the station and its robot, simulated unless a CAN bus and a receiver are named."""

from __future__ import annotations

import signal
import socket
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.errors import RowpilotError

if TYPE_CHECKING:
    from backend.settings import Settings
    from navcore.runtime.processes import Robot
    from navcore.runtime.simulation import SimulationParams

MULTICAST_GROUP = "239.74.163.2"


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command(name="run")(run)


def run(
    port: Annotated[int | None, typer.Option(help="TCP port of the station; else ROWPILOT_PORT or 8000.")] = None,
    data: Annotated[Path | None, typer.Option(help="Folder of database and logs; else ROWPILOT_DATA_DIR.")] = None,
    can: Annotated[str | None, typer.Option(help="CAN interface of a real chassis, such as can0.")] = None,
    gnss: Annotated[
        str | None, typer.Option(help="Receiver, tcp://host:port or serial:///dev/ttyUSB0?115200.")
    ] = None,
    config: Annotated[Path | None, typer.Option(help="Settings of the robot, TOML.")] = None,
    simulation: Annotated[
        str, typer.Option(help='What is simulated, JSON, such as \'{"season": "dormant", "light": "overcast"}\'.')
    ] = "{}",
) -> None:
    """Serve the station and drive the robot. Ends with Ctrl-C; the robot then stops."""
    try:
        _run(_settings(port, data, simulated=can is None), can, gnss, config, simulation)
    except RowpilotError as error:
        typer.echo(f"rowpilot: {error}", err=True)
        raise typer.Exit(1) from error


def _settings(port: int | None, data: Path | None, *, simulated: bool) -> Settings:
    """The station's settings: environment, then what was given here."""
    from pydantic import ValidationError

    from backend.settings import Settings
    from navcore.errors import ConfigError

    given = {"port": port, "data_dir": data, "simulated": simulated}
    try:
        return Settings(**{name: value for name, value in given.items() if value is not None})  # type: ignore[arg-type]
    except ValidationError as error:
        raise ConfigError(f"The settings are not usable: {error.errors()[0]['msg']}.") from error


def _run(settings: Settings, can: str | None, gnss: str | None, config: Path | None, simulation: str) -> None:
    from navcore.cli.first_farm import beginning_farm
    from navcore.runtime.supervisor import Supervisor

    if config is not None:
        _check(config)
    robot_on = (
        partial(_real_robot, settings, can, _receiver(gnss), config)
        if can
        else partial(_simulated_robot, settings, _choices(simulation), config)
    )
    # All that was given is sound: only now is anything written.
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    farm = beginning_farm(settings)
    supervisor = Supervisor(robot_on(farm.path), farm.site_id, _environment(settings))
    ended: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda got, _: ended.append(got))
    try:
        supervisor.start()
        while not ended:
            supervisor.watch()
    finally:
        supervisor.close()


def _check(config: Path) -> None:
    """Each process reads the settings for itself: what is wrong with them is said before any begins."""
    from navcore.config import load_config
    from navcore.perception.detector_choice import new_detector

    detector = load_config(config).detector
    if detector.weights:
        new_detector(detector)


def _environment(settings: Settings) -> dict[str, str]:
    """What the station's own process is told."""
    return {
        "ROWPILOT_PORT": str(settings.port),
        "ROWPILOT_DATA_DIR": str(settings.data_dir),
        "ROWPILOT_BUS_DIR": str(settings.bus_dir),
        "ROWPILOT_VEHICLE": settings.vehicle,
        "ROWPILOT_ROBOT": settings.robot,
        "ROWPILOT_SIMULATED": "true" if settings.simulated else "false",
    }


def _choices(simulation: str) -> SimulationParams:
    """What is simulated. Raises ConfigError."""
    import msgspec

    from navcore.errors import ConfigError
    from navcore.runtime.simulation import SimulationParams

    try:
        return msgspec.json.decode(simulation, type=SimulationParams)
    except msgspec.DecodeError as error:
        raise ConfigError(f"The simulation's settings are not usable: {error}") from error


def _receiver(gnss: str | None) -> str:
    """The receiver's address. Raises ConfigError for none, and for one that cannot be."""
    from navcore.errors import ConfigError
    from navcore.runtime.device_address import DeviceAddress

    if gnss is None:
        raise ConfigError("A real robot needs a receiver: give --gnss.")
    DeviceAddress(gnss)
    return gnss


def _simulated_robot(settings: Settings, params: SimulationParams, config: Path | None, site: Path) -> Robot:
    from navcore.runtime.processes import CanSettings, Robot

    options = {"port": _free_port(socket.SOCK_DGRAM), "hop_limit": 0, "fd": 0}
    return Robot(
        bus=settings.bus_dir, site=site, vehicle=settings.vehicle, config=config,
        can=CanSettings(interface="udp_multicast", channel=MULTICAST_GROUP, options=options),
        gnss=f"tcp://127.0.0.1:{_free_port(socket.SOCK_STREAM)}", simulation=params,
    )  # fmt: skip


def _real_robot(settings: Settings, can: str, gnss: str, config: Path | None, site: Path) -> Robot:
    from navcore.runtime.processes import CanSettings, Robot

    return Robot(
        bus=settings.bus_dir, site=site, vehicle=settings.vehicle, config=config,
        can=CanSettings(interface="socketcan", channel=can), gnss=gnss, calibration=settings.calibration_dir,
        name=settings.robot,
    )  # fmt: skip


def _free_port(kind: socket.SocketKind) -> int:
    """A port of this machine that nobody uses, so that two stations do not mix."""
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])

"""What can be set from outside: environment variables with the prefix `ROWPILOT_`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Self

from pydantic import Field, model_validator
from pydantic_settings import BaseSettings, SettingsConfigDict

from navcore.vehicle import PROFILES

LOOPBACK_HOSTS = ("127.0.0.1", "::1", "localhost")


def default_data_dir() -> Path:
    """`var/` beside the sources of a checkout, else the user's data folder (XDG base directory specification)."""
    checkout = Path(__file__).resolve().parents[1]
    if (checkout / "pyproject.toml").is_file():
        return checkout / "var"
    data_home = os.environ.get("XDG_DATA_HOME") or str(Path.home() / ".local" / "share")
    return Path(data_home) / "rowpilot"


def default_bus_dir() -> Path:
    """Folder of the sockets between the processes; short, because a socket's path must fit 107 bytes."""
    runtime_dir = os.environ.get("XDG_RUNTIME_DIR")
    return Path(runtime_dir or f"/tmp/rowpilot-{os.getuid()}") / "rowpilot"


class Settings(BaseSettings):
    """Settings of the station.

    Attributes:
        host: address to listen on. Anything but loopback needs `open_to_network`.
        port: TCP port.
        open_to_network: the operator knows that others on the network will reach the login.
        allowed_hosts: further host names under which browsers may call the station (Host header).
        data_dir: database, orthophotos and run logs.
        bus_dir: sockets between the processes.
        vehicle: key of `navcore.vehicle.PROFILES`.
        simulated: the robot is the simulator.
        scene: run the 3D view.
        scene_port: its loopback port; chosen at start if None.
        upload_limit_bytes: largest orthophoto file that is taken.
        decoded_limit_bytes: largest orthophoto, decoded.
        import_memory_bytes, import_cpu_s, import_wall_s: limits of the import process.
        keep_free_bytes: disk space that uploads leave free.
        session_idle_s, session_absolute_s: a login ends after that much silence, and after that time anyway.
        operator_timeout_s: a browser whose heartbeat is older no longer counts as an operator.
    """

    model_config = SettingsConfigDict(env_prefix="ROWPILOT_", frozen=True, extra="forbid")

    host: str = "127.0.0.1"
    port: int = Field(default=8000, ge=0, le=65535)
    open_to_network: bool = False
    allowed_hosts: tuple[str, ...] = ()
    data_dir: Path = Field(default_factory=default_data_dir)
    bus_dir: Path = Field(default_factory=default_bus_dir)
    vehicle: str = "paper_a"
    simulated: bool = True
    scene: bool = True
    scene_port: int | None = Field(default=None, ge=1, le=65535)
    upload_limit_bytes: int = Field(default=8 * 2**30, gt=0)
    decoded_limit_bytes: int = Field(default=12 * 2**30, gt=0)
    import_memory_bytes: int = Field(default=2 * 2**30, gt=0)
    import_cpu_s: int = Field(default=1800, gt=0)
    import_wall_s: int = Field(default=3600, gt=0)
    keep_free_bytes: int = Field(default=2**30, ge=0)
    session_idle_s: int = Field(default=12 * 3600, gt=0)
    session_absolute_s: int = Field(default=7 * 24 * 3600, gt=0)
    operator_timeout_s: float = Field(default=2.0, gt=0)

    @model_validator(mode="after")
    def _network_is_opened_on_purpose(self) -> Self:
        if self.host not in LOOPBACK_HOSTS and not self.open_to_network:
            raise ValueError("host is not loopback: set ROWPILOT_OPEN_TO_NETWORK=true to open the station")
        if self.vehicle not in PROFILES:
            raise ValueError(f"vehicle must be one of {', '.join(sorted(PROFILES))}")
        return self

    @property
    def database_path(self) -> Path:
        """The one SQLite file."""
        return self.data_dir / "rowpilot.sqlite3"

    @property
    def orthophoto_dir(self) -> Path:
        """Finished orthophotos, one file each, named by the server."""
        return self.data_dir / "orthophotos"

    @property
    def upload_dir(self) -> Path:
        """Uploads and half-made pictures; emptied at start."""
        return self.data_dir / "uploads"

    @property
    def tile_dir(self) -> Path:
        """Rendered map tiles; may be deleted at any time."""
        return self.data_dir / "tiles"

    @property
    def run_dir(self) -> Path:
        """Run logs, `<run id>.mcap`."""
        return self.data_dir / "runs"

    @property
    def map3d_dir(self) -> Path:
        """3D maps, `<site id>/<run id>/`."""
        return self.data_dir / "maps3d"

    @property
    def cookie_name(self) -> str:
        """Browsers share cookies between the ports of a host; two stations must not log each other out."""
        return f"rowpilot_{self.port}"

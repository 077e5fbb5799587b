"""What is set of a robot's 3D LiDAR."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from ipaddress import IPv4Address

from navcore.drivers.lidar3d.models import MODELS, LidarModel, ModelName
from navcore.drivers.lidar3d.turns import TurnsParams
from navcore.errors import ConfigError
from navcore.geometry.lidar_mount import LidarMount, robot_lidar3d
from navcore.geometry.se3 import SE3

EVERY_CARD = "0.0.0.0"
_FARTHEST_MOUNT = 5.0
_KNOWN = ", ".join(MODELS)
_BOUNDS = (
    ("port", 1, 65_535, ""), ("device_port", 0, 65_535, ""), ("unit_mm", 0.5, 10.0, " mm"), ("lever", 0.0, 0.1, " m"),
    ("nearest", 0.0, 5.0, " m"), ("silent_s", 0.2, 60.0, " s"), ("reconnect_s", 0.01, 60.0, " s"),
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar3dParams:
    """One Velodyne VLP-16 or Leishen C16.

    Attributes:
        model: "vlp16", "c16" (beams 2 deg apart) or "c16-fine" (1.33 deg); empty for a robot without one.
        listen: address of the network card that it is plugged into; "0.0.0.0" for every one. A LiDAR that sends to
            all (255.255.255.255), as a new VLP-16 does, is heard only there.
        port, device_port: of this computer, to which it sends data and what it tells of itself; 1 to 65535, the
            second 0 if it is not wanted.
        sender: the LiDAR's own address, by which another device's packets are passed over; empty for any.
        mount: where it sits, within 5 m of `base_link`; paper C's until it is measured.
        unit_mm: of a told distance, 0.5 to 10 mm; None for the model's own (VLP-16 2 mm, C16 2.5 mm).
        lever: how far from its axis rays leave the head, 0 to 0.1 m; None for the model's own (a C16's is told as
            0.043 to 0.046 m by version).
        nearest: nearer echoes are the robot's own, 0 to 5 m.
        silent_s: a LiDAR that sends nothing for so long is listened to anew, 0.2 to 60 s.
        reconnect_s: between two attempts, 0.01 to 60 s.
        turns: how packets are gathered.
    """

    model: str = ""
    listen: str = EVERY_CARD
    port: int = 2368
    device_port: int = 2369
    sender: str = ""
    mount: LidarMount = field(default_factory=robot_lidar3d)
    unit_mm: float | None = None
    lever: float | None = None
    nearest: float = 0.0
    silent_s: float = 1.0
    reconnect_s: float = 1.0
    turns: TurnsParams = TurnsParams()

    def __post_init__(self) -> None:
        for words in self._wrong():
            raise ConfigError(f"The 3D LiDAR's settings are not usable: {words}.")

    def _wrong(self) -> list[str]:
        """Each in words."""
        checks = (
            (not self.model or self.model in MODELS, f"model must be {_KNOWN}, but is '{self.model}'"),
            (_is_address(self.listen), f"listen must be an address like 192.168.1.102, but is '{self.listen}'"),
            (not self.sender or _is_address(self.sender), f"sender must be an address, but is '{self.sender}'"),
            (_is_mount(self.mount), f"mount must lie within {_FARTHEST_MOUNT:.0f} m and turn by numbers"),
        )
        return [words for right, words in checks if not right] + [
            f"{name} must be {least:g} to {most:g}{unit}, but is {value}"
            for name, least, most, unit in _BOUNDS
            if (value := getattr(self, name)) is not None and not least <= value <= most
        ]

    def ports(self) -> tuple[int, ...]:
        """All that are listened to; what is seldom sent comes first, so that it is never kept waiting."""
        return tuple(dict.fromkeys(port for port in (self.device_port, self.port) if port))

    def lidar_model(self) -> LidarModel:
        """As set. Raises ConfigError for a robot without one."""
        if not self.model:
            raise ConfigError(f"No 3D LiDAR is set. Name its model: {_KNOWN}.")
        model = MODELS[ModelName(self.model)]
        return replace(
            model,
            unit=model.unit if self.unit_mm is None else self.unit_mm * 1e-3,
            lever=model.lever if self.lever is None else self.lever,
            nearest=max(model.nearest, self.nearest),
        )

    def T_base_lidar(self) -> SE3:
        """From `lidar3d` to `base_link`."""
        return self.mount.T_base_lidar()


def _is_address(text: str) -> bool:
    try:
        IPv4Address(text)
    except ValueError:
        return False
    return True


def _is_mount(mount: LidarMount) -> bool:
    placed = all(abs(each) <= _FARTHEST_MOUNT for each in (mount.x, mount.y, mount.z))
    return placed and all(math.isfinite(each) for each in (mount.roll, mount.pitch, mount.yaw))

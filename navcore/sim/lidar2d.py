"""The simulated 2D LiDAR: a turn of rays over what the camera sees too, taken while the robot drives on."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.lidar_mount import LidarMount, robot_lidar
from navcore.geometry.pinhole import rotation_from_rpy
from navcore.messages import LidarScan
from navcore.sim.lidar_kernels import cast
from navcore.sim.orchard import Orchard, Shed
from navcore.sim.render.planting import planted

Floats = NDArray[np.float64]

# A ray on an edge mixes what stands there with what stands no further behind it than that, m.
MOST_MIXED = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar2dParams:
    """An RPLIDAR of paper B's class: 0.2 to 12 m, 16 000 rays a second, 5 to 15 turns a second, 0.225 deg.

    Attributes:
        mount: where it sits.
        rays_per_s, hz: of the rays and the turns; > 0.
        near, far: shortest and longest range, m.
        noise: 1-sigma of a range, m; noise_share: and beside that a share of it. The maker's "2 % up to 5 m" is the
            bound of both parts and of the scale together: at 5 m three sigmas are 9 cm.
        scale_std: of the error that all ranges of one device share.
        lost: share of rays that do not come back from what they meet squarely; grazing rays are lost three times as
            often again.
        beam_deg: width of a ray: one that meets an edge tells a range between that and what stands behind.
        latency_s: from the last ray until the scan is there.
    """

    mount: LidarMount = field(default_factory=robot_lidar)
    rays_per_s: float = 16_000.0
    hz: float = 10.0
    near: float = 0.2
    far: float = 12.0
    noise: float = 0.010
    noise_share: float = 0.004
    scale_std: float = 0.003
    lost: float = 0.02
    beam_deg: float = 0.15
    latency_s: float = 0.02

    def __post_init__(self) -> None:
        if not (self.rays_per_s > 0.0 and 1.0 <= self.hz <= 50.0):
            raise InputError("The LiDAR's rays per second must be positive, and its turns between 1 and 50 a second.")


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarFaults:
    """What a test can break at any instant.

    Attributes:
        silent: no scan is sent. zeros: no ray comes back.
        blinded_deg: rays between these bearings, deg in (-180, 180], come back empty: low sun.
        turned_deg: the mount has turned by so much to the left.
    """

    silent: bool = False
    zeros: bool = False
    blinded_deg: tuple[float, float] | None = None
    turned_deg: float = 0.0


class Lidar2d:
    """Fed with the robot's true pose as time goes on. The same seed and the same poses give the same scans."""

    def __init__(self, orchard: Orchard, params: Lidar2dParams, rng: np.random.Generator, start_ns: int = 0) -> None:
        self.faults = LidarFaults()
        self._params, self._rng = params, rng
        self._tubes = planted(orchard, np.zeros((0, 15))).tubes
        self._walls = _walls(orchard.shed)
        self._scale = float(1.0 + params.scale_std * rng.standard_normal())
        self._step = math.tau * params.hz / params.rays_per_s
        self._turn_rays = round(params.rays_per_s / params.hz)
        self._cast_ns, self._began_ns = start_ns, start_ns
        self._angles: list[Floats] = []
        self._ranges: list[Floats] = []
        self._cast_rays = 0
        self._owed = 0.0
        self._sent: deque[LidarScan] = deque()

    def step(self, now_ns: int, x: float, y: float, rpy: tuple[float, float, float]) -> None:
        """Cast the rays that fall due up to `now_ns` from the pose of `base_link` at that moment, (x, y) m, rad."""
        self._owed += (now_ns - self._cast_ns) * 1e-9 * self._params.rays_per_s
        due, self._cast_ns = int(self._owed), now_ns
        self._owed -= due
        done = 0
        while done < due:
            part = min(due - done, self._turn_rays - self._cast_rays)
            self._cast(part, x, y, rpy)
            done += part
            if self._cast_rays == self._turn_rays:
                self._finish(now_ns - round((due - done) / self._params.rays_per_s * 1e9))

    def due(self, now_ns: int) -> tuple[LidarScan, ...]:
        """Scans that have arrived by now."""
        arrived = []
        while self._sent and self._sent[0].stamp_ns + round(self._params.latency_s * 1e9) <= now_ns:
            arrived.append(self._sent.popleft())
        return tuple(arrived)

    def _cast(self, count: int, x: float, y: float, rpy: tuple[float, float, float]) -> None:
        p = self._params
        angles = -self._step * (self._cast_rays + np.arange(count, dtype=np.float64))
        R_map_base = rotation_from_rpy(*rpy)
        turned = angles + math.radians(self.faults.turned_deg)
        flat = np.column_stack((np.cos(turned), np.sin(turned), np.zeros(count)))
        ways = flat @ (R_map_base @ p.mount.R_base_lidar()).T
        origin = R_map_base @ (p.mount.x, p.mount.y, p.mount.z) + (x, y, 0.0)
        near = np.flatnonzero(np.hypot(self._tubes[:, 0, 0] - x, self._tubes[:, 0, 1] - y) < p.far + 1.0)
        first, square, second = cast(origin, ways, self._tubes, near, self._walls, p.far)
        self._angles.append(angles)
        self._ranges.append(self._measured(angles, first, square, second))
        self._cast_rays += count

    def _measured(self, angles: Floats, first: Floats, square: Floats, second: Floats) -> Floats:
        """Ranges as the device tells them, m, 0 where nothing came back."""
        p, n = self._params, len(first)
        chance, mix, noise = self._rng.random(n), self._rng.random(n), self._rng.standard_normal(n)
        graze = square < 0.3
        edge = (square < self._edge(first)) & (second - first < MOST_MIXED)
        told = np.where(edge, first + mix * (second - first), first)
        lost = chance < p.lost * np.where(graze, 4.0, 1.0)
        told = self._scale * told + noise * np.hypot(p.noise, p.noise_share * told)
        outside = lost | (told < p.near) | (told > p.far) | self._blind(angles)
        return np.where(outside, 0.0, told)

    def _edge(self, ranges: Floats) -> Floats:
        """How squarely a ray must meet a trunk of 0.1 m for all of its width to fall on it."""
        beam = 0.5 * math.radians(self._params.beam_deg) * ranges
        inside = np.clip(1.0 - beam / 0.05, 0.0, 1.0)
        return np.sqrt(1.0 - inside**2)

    def _blind(self, angles: Floats) -> NDArray[np.bool_]:
        if self.faults.zeros:
            return np.ones(len(angles), dtype=np.bool_)
        if self.faults.blinded_deg is None:
            return np.zeros(len(angles), dtype=np.bool_)
        low, high = self.faults.blinded_deg
        bearing = np.degrees(np.remainder(angles + math.pi, math.tau) - math.pi)
        return np.asarray((bearing >= low) & (bearing <= high))

    def _finish(self, stamp_ns: int) -> None:
        angles, ranges = np.concatenate(self._angles), np.concatenate(self._ranges)
        scan = LidarScan(
            stamp_ns=stamp_ns, began_ns=self._began_ns, angles=tuple(np.round(angles, 5).tolist()),
            distances=tuple(np.round(ranges, 4).tolist()),
        )  # fmt: skip
        self._angles, self._ranges, self._cast_rays, self._began_ns = [], [], 0, stamp_ns
        if not self.faults.silent:
            self._sent.append(scan)


def _walls(shed: Shed | None) -> Floats:
    """(W, 5) x0, y0, x1, y1 and height of the shed's sides, m."""
    if shed is None:
        return np.zeros((0, 5))
    c, s, a, b = math.cos(shed.yaw), math.sin(shed.yaw), shed.length / 2, shed.depth / 2
    corners = [(shed.x + c * u - s * v, shed.y + s * u + c * v) for u, v in ((-a, -b), (a, -b), (a, b), (-a, b))]
    return np.array([(*corners[i], *corners[(i + 1) % 4], shed.height) for i in range(4)])

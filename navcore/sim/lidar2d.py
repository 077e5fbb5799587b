"""The simulated 2D LiDAR: rays cast one after another from wherever the robot is at that moment.

Modelled on an RPLIDAR A2M12, which has paper B's figures (0.2 to 12 m, 16 000 rays a second, 0.225 deg at 10 Hz). It
triangulates: where its spot lies half on an edge, the disparity it reads is a mean, so what it returns lies between
the near and the far surface, linear in one over the distance.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import rotation_from_rpy
from navcore.messages import LidarScan, SimTruth
from navcore.sim.lidar_rays import Beam, Device, Draws, measure, owners_of
from navcore.sim.orchard import Orchard
from navcore.sim.rays.scene import ray_scene

Floats = NDArray[np.float64]
_NS = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar2dParams:
    """Paper B's sensor. "2 % of the distance up to 5 m" is read as 2 sigma and split: most of such a triangulating
    sensor's error is its own calibration and repeats from ray to ray, the smaller part is white (chosen, not
    measured): 0.8 % and 0.4 % make 0.9 % 1-sigma together.

    Attributes:
        least_range, most_range: m; nothing nearer or farther is measured. 0.05 to 1, 1 to 40.
        rays_per_s: 1000 to 64 000. turns_per_s: 5 to 15.
        beam_deg: width of the spot, 0 to 1.
        scale_std: 1-sigma of the device's scale error, share of the distance, 0 to 0.05.
        offset_std: 1-sigma of the device's constant error, m, 0 to 0.05.
        noise_share, noise_floor: white 1-sigma: the larger of a share of the distance (0 to 0.05) and m (0 to 0.05).
        edge_gap: two surfaces under one spot farther apart than this are mixed, m, 0.01 to 1.
        missing: share of rays without a return whatever they meet, 0 to 1.
        strength: mean photons, so to say, from a white surface met squarely at `most_range`; a return has the chance
            1 - exp(-strength x albedo x cosine x (most_range / distance)^2): dark bark met at a graze is lost first.
            0.1 to 1000.
        latency_s: from a turn's last ray to its arrival, 0 to 0.5.
    """

    least_range: float = 0.2
    most_range: float = 12.0
    rays_per_s: float = 16_000.0
    turns_per_s: float = 10.0
    beam_deg: float = 0.25
    scale_std: float = 0.008
    offset_std: float = 0.004
    noise_share: float = 0.004
    noise_floor: float = 0.003
    edge_gap: float = 0.08
    missing: float = 0.005
    strength: float = 2.0
    latency_s: float = 0.02

    def __post_init__(self) -> None:
        bounds = {
            "least_range": (0.05, 1.0), "most_range": (1.0, 40.0), "rays_per_s": (1000.0, 64_000.0),
            "turns_per_s": (5.0, 15.0), "beam_deg": (0.0, 1.0), "scale_std": (0.0, 0.05), "offset_std": (0.0, 0.05),
            "noise_share": (0.0, 0.05), "noise_floor": (0.0, 0.05), "edge_gap": (0.01, 1.0), "missing": (0.0, 1.0),
            "strength": (0.1, 1000.0), "latency_s": (0.0, 0.5),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            if not low <= getattr(self, name) <= high:
                value = getattr(self, name)
                raise InputError(f"The LiDAR's {name} must lie between {low} and {high}, but is {value}.")

    @property
    def rays_per_turn(self) -> int:
        """Rays of one turn, 1600 by default."""
        return round(self.rays_per_s / self.turns_per_s)


FLAWLESS = Lidar2dParams(
    beam_deg=0.0, scale_std=0.0, offset_std=0.0, noise_share=0.0, noise_floor=0.0, missing=0.0, strength=1000.0
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar2dFaults:
    """What is broken now.

    Attributes:
        silent: no turn is handed out. zeros: turns without a single return.
        sun: azimuth in `map` and half width (rad) of a low sun's glare; rays into it are lost but for a few false
            returns. None without.
        turned: roll, pitch, yaw by which the mount was knocked out of place, in the sensor's axes, rad.
    """

    silent: bool = False
    zeros: bool = False
    sun: tuple[float, float] | None = None
    turned: tuple[float, float, float] = (0.0, 0.0, 0.0)


WORKING = Lidar2dFaults()


@dataclass(frozen=True, slots=True, kw_only=True)
class SimScan:
    """A turn with its truth.

    Attributes:
        scan: as the sensor tells it.
        owners: per ray the number of the trunk or post that it met, trunks first, then posts, from 1; 0 for anything
            else, nothing, or two at once. For the score, never for the navigator.
    """

    scan: LidarScan
    owners: tuple[int, ...]


class Lidar2d:
    """Turns clockwise as RPLIDARs do: angles fall from 0. Same arguments and same calls, same bits."""

    def __init__(self, orchard: Orchard, mount: LidarMount, params: Lidar2dParams, rng: np.random.Generator) -> None:
        self._scene, self._params, self._rng = ray_scene(orchard), params, rng
        self._arm, self._R_base_lidar = np.array((mount.x, mount.y, mount.z)), mount.R_base_lidar()
        scale, offset = rng.standard_normal(2)
        p, n = params, params.rays_per_turn
        self._device = Device(
            least=p.least_range, most=p.most_range, scale=1.0 + p.scale_std * float(scale),
            offset=p.offset_std * float(offset), noise_share=p.noise_share, noise_floor=p.noise_floor,
            half_beam=math.radians(p.beam_deg) / 2, edge_gap=p.edge_gap, missing=p.missing, strength=p.strength,
        )  # fmt: skip
        self._angles = -2.0 * math.pi * np.arange(n) / n
        self._told_angles: tuple[float, ...] = tuple(np.round(self._angles, 5).tolist())
        self._ray_ns = _NS / p.rays_per_s
        self._turned, self._mounted = WORKING.turned, self._R_base_lidar
        self._last_ns: int | None = None
        self._pose = np.zeros(5)
        self._sent: deque[tuple[int, SimScan]] = deque()
        self._start_turn(0)

    def update(self, truth: SimTruth, faults: Lidar2dFaults = WORKING) -> None:
        """Cast the rays that fall due between the last truth and this one, each from the pose at its own time.

        The first call only starts the motor. Raises NotFiniteError for a pose that is no number, ContractError when
        time runs backwards.
        """
        if not math.isfinite(truth.x + truth.y + truth.yaw + truth.roll + truth.pitch):
            raise NotFiniteError("The robot's true pose must be finite numbers.")
        last_ns, before, self._last_ns = self._last_ns, self._pose, truth.stamp_ns
        if last_ns is None:
            self._pose = _pose(truth, truth.yaw)
            self._start_turn(truth.stamp_ns)
            return
        if truth.stamp_ns < last_ns:
            raise ContractError("The LiDAR cannot turn backwards in time.")
        self._pose = _pose(truth, float(before[2]))
        while (end := self._due(truth.stamp_ns)) > self._next:
            self._cast(before, last_ns, max(truth.stamp_ns - last_ns, 1), end, faults)
            if end == len(self._angles):
                self._close(faults)

    def due(self, now_ns: int) -> tuple[SimScan, ...]:
        """Turns that have arrived by now, oldest first, each handed out once."""
        arrived = []
        while self._sent and self._sent[0][0] <= now_ns:
            arrived.append(self._sent.popleft()[1])
        return tuple(arrived)

    def _start_turn(self, began_ns: int) -> None:
        n = len(self._angles)
        self._began_ns, self._next = began_ns, 0
        self._draws = Draws(self._rng.standard_normal(n), self._rng.random((n, 4)))
        self._distances, self._met = np.zeros(n), np.zeros(n, np.int64)

    def _due(self, now_ns: int) -> int:
        """Index after the last ray of this turn that is due; ray i is taken i ray times after the turn began."""
        return min(math.floor((now_ns - self._began_ns) / self._ray_ns) + 1, len(self._angles))

    def _cast(self, before: Floats, last_ns: int, span_ns: int, end: int, faults: Lidar2dFaults) -> None:
        """Rays up to `end` of this turn, between the pose `before` and the pose now."""
        if faults.turned != self._turned:
            self._turned, self._mounted = faults.turned, self._R_base_lidar @ rotation_from_rpy(*faults.turned)
        azimuth, glare = (0.0, -1.0) if faults.sun is None else faults.sun
        first = (self._began_ns - last_ns) / span_ns
        beam = Beam(
            before, self._pose, first, self._ray_ns / span_ns, self._arm, self._mounted, float(azimuth), float(glare)
        )
        measure(
            self._scene, self._device, beam, self._draws, self._angles, self._next, end, self._distances, self._met
        )
        self._next = end

    def _close(self, faults: Lidar2dFaults) -> None:
        """Send the turn off and begin the next."""
        n = len(self._angles)
        stamp_ns = self._began_ns + round((n - 1) * self._ray_ns)
        if not faults.silent:
            owners = owners_of(self._scene.owners, self._met)
            if faults.zeros:
                self._distances[:], owners[:] = 0.0, 0
            scan = LidarScan(
                stamp_ns=stamp_ns, began_ns=self._began_ns, angles=self._told_angles,
                distances=tuple(np.round(self._distances, 4).tolist()),
            )  # fmt: skip
            arrives_ns = stamp_ns + round(self._params.latency_s * _NS)
            self._sent.append((arrives_ns, SimScan(scan=scan, owners=tuple(owners.tolist()))))
        self._start_turn(self._began_ns + round(n * self._ray_ns))


def _pose(truth: SimTruth, near_yaw: float) -> Floats:
    """x, y, yaw, roll, pitch; the yaw within half a turn of `near_yaw`, so that it can be interpolated."""
    yaw = near_yaw + math.remainder(truth.yaw - near_yaw, math.tau)
    return np.array((truth.x, truth.y, yaw, truth.roll, truth.pitch))

"""The simulated 3D LiDAR: sixteen beams, one column after another, each from where the robot is at that moment."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import rotation_from_rpy
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.sim.lidar3d_rays import Echoes, Optics, Rig, cast_turn, measure
from navcore.sim.rays.fan import beams, hits
from navcore.sim.rays.land_scene import LandScene, Part
from navcore.sim.rays.shapes import SPOT_GAIN

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]
_NS = 1e-9

# Elevations in the order of firing, deg: both sensors interleave them (protocols of Leishen and Velodyne).
INTERLEAVED_DEG = (-15.0, 1.0, -13.0, 3.0, -11.0, 5.0, -9.0, 7.0, -7.0, 9.0, -5.0, 11.0, -3.0, 13.0, -1.0, 15.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar3dParams:
    """A spinning LiDAR of sixteen beams. The defaults are a Leishen C16 (2 degree model) with 1800 columns a turn.

    Attributes:
        elevations_deg: of the beams in the order of firing, within 30; 4 to 64 beams.
        columns: rays of one beam in a turn, 360 to 3600.
        turns_per_s: 5 to 20 (both sensors).
        beam_period_s: from one beam's firing to the next, 1e-6 to 1e-5 (C16 3.125 us, VLP-16 2.304 us).
        least_range, most_range: m; nothing nearer or farther is measured. 0.1 to 1, 10 to 200.
        resolution: of the distances told, m, 1e-4 to 0.05 (C16 2.5 mm, VLP-16 2 mm).
        noise: white 1-sigma of a distance, m, 0 to 0.2 (both sheets say 2 to 3 cm typical).
        beam_offset_std: 1-sigma of each beam's constant error, m, 0 to 0.05 (chosen).
        missing: share of rays without a return whatever they meet, 0 to 1.
        strength: mean photons, so to say, from a white surface met squarely at 100 m; a return has the chance
            1 - exp(-strength x albedo x cosine x (100 m / distance)^2). 0.01 to 1e6. 2 sees bark to about 50 m.
        edge_gap: two surfaces under one spot nearer to each other than this give one echo between them, farther apart
            the stronger of two, m, 0 to 2 (half the length of a 4 ns pulse).
    """

    elevations_deg: tuple[float, ...] = INTERLEAVED_DEG
    columns: int = 1800
    turns_per_s: float = 10.0
    beam_period_s: float = 3.125e-6
    least_range: float = 0.4
    most_range: float = 100.0
    resolution: float = 0.0025
    noise: float = 0.02
    beam_offset_std: float = 0.005
    missing: float = 0.01
    strength: float = 2.0
    edge_gap: float = 0.6

    def __post_init__(self) -> None:
        bounds = {
            "columns": (360, 3600), "turns_per_s": (5.0, 20.0), "beam_period_s": (1e-6, 1e-5),
            "least_range": (0.1, 1.0), "most_range": (10.0, 200.0), "resolution": (1e-4, 0.05), "noise": (0.0, 0.2),
            "beam_offset_std": (0.0, 0.05), "missing": (0.0, 1.0), "strength": (0.01, 1e6), "edge_gap": (0.0, 2.0),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise InputError(f"The 3D LiDAR's {name} must lie between {low} and {high}, but is {value}.")
        if not (4 <= len(self.elevations_deg) <= 64 and max(map(abs, self.elevations_deg)) <= 30.0):
            raise InputError("The 3D LiDAR must have 4 to 64 beams, each within 30 degrees of level.")

    @property
    def turn_s(self) -> float:
        """Time of a turn, s."""
        return 1.0 / self.turns_per_s


C16 = Lidar3dParams()
VLP16 = Lidar3dParams(beam_period_s=2.304e-6, resolution=0.002)
FLAWLESS_3D = Lidar3dParams(noise=0.0, beam_offset_std=0.0, missing=0.0, strength=1e6, edge_gap=0.0, resolution=1e-4)


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar3dFaults:
    """What is broken now.

    Attributes:
        empty: turns without a single return.
        rain: share of rays that meet a drop within 6 m, 0 to 1.
        turned: roll, pitch, yaw by which the mount was knocked out of place, in the sensor's axes, rad.
    """

    empty: bool = False
    rain: float = 0.0
    turned: tuple[float, float, float] = (0.0, 0.0, 0.0)


WORKING_3D = Lidar3dFaults()
_RAIN_REACH_M = 6.0
# Mean way of a ray in grass before a blade stops it, m.
_GRASS_WAY_M = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimTurn:
    """A turn with its truth.

    Attributes:
        stamp_ns: when the last point was taken.
        cloud: in the sensor's frame (x forward, y left, z up), m, as the sensor tells it: not corrected for motion.
        parts: (N,) what each point truly lies on, `Part`. For the score, never for the navigator.
    """

    stamp_ns: int
    cloud: PointCloud
    parts: Bytes


class Lidar3d:
    """Turns clockwise, a turn begins and ends behind the robot. Same seed, stamp and poses: the same bits."""

    def __init__(self, scene: LandScene, mount: LidarMount, params: Lidar3dParams, seed: int) -> None:
        self._scene, self._params, self._seed, self._mount = scene, params, seed, mount
        p, rising = params, np.radians(sorted(params.elevations_deg))
        self._beams = beams(rising, p.most_range)
        self._fired = np.argsort(np.argsort(p.elevations_deg))  # ring of each beam in the order of firing
        self._azimuths = math.pi - 2.0 * math.pi * np.arange(p.columns) / p.columns
        self._beam_s = p.beam_period_s * np.arange(len(rising))
        last_s = (p.columns - 1) / p.columns * p.turn_s + self._beam_s[-1]
        self._ages = p.turn_s * np.arange(p.columns) / p.columns - last_s
        self._offsets = p.beam_offset_std * np.random.default_rng((seed, 0)).standard_normal(len(rising))
        self._optics = Optics(
            least=p.least_range, most=p.most_range, strength=p.strength * 100.0**2, missing=p.missing,
            edge_reach=SPOT_GAIN / (2.0 * math.pi / p.columns), edge_gap=p.edge_gap, noise=p.noise, step=p.resolution,
        )  # fmt: skip

    def turn(
        self, stamp_ns: int, stamps_ns: Sequence[int], poses: Sequence[SE3], faults: Lidar3dFaults = WORKING_3D
    ) -> SimTurn:
        """The turn whose last point is taken at `stamp_ns`.

        Args:
            stamps_ns: (K,) rising times of `poses`, K >= 2; they must reach from the turn's begin to its end.
            poses: `T_map_base` at those times.

        Raises ContractError for times that do not rise or do not span the turn, NotFiniteError for a pose that is no
        number.
        """
        rig = self._rig(self._knots(stamp_ns, stamps_ns, poses), faults)
        rng = np.random.default_rng((self._seed, 1, stamp_ns))
        shape = (len(self._ages), len(self._beam_s))
        draws, normal = rng.random((2, *shape)), rng.standard_normal(shape)
        ways = rng.exponential(_GRASS_WAY_M, shape)
        echoes, told = _echoes(shape), _echoes(shape)
        cast_turn(self._scene, self._beams, rig, ways, hits(shape[1], len(self._scene.kinds)), echoes)
        echoes.distances[:] += np.where(echoes.distances > 0.0, self._offsets, 0.0)
        measure(self._optics, echoes, draws[0], draws[1], normal, told)
        self._spoil(told, faults, rng)
        return self._told(stamp_ns, told)

    def _knots(self, stamp_ns: int, stamps_ns: Sequence[int], poses: Sequence[SE3]) -> Floats:
        """Poses as rows of time against the stamp, x, y, z, roll, pitch, yaw, the yaw unwrapped."""
        knots = np.array(
            [((ns - stamp_ns) * _NS, *T.t, *T.rpy()) for ns, T in zip(stamps_ns, poses, strict=True)]
        ).reshape(-1, 7)
        if not np.isfinite(knots).all():
            raise NotFiniteError("The robot's true poses must be finite numbers.")
        if len(knots) < 2 or (np.diff(knots[:, 0]) <= 0.0).any():
            raise ContractError("The poses of a turn must be two or more, their times rising.")
        if knots[0, 0] > self._ages[0] + _NS or knots[-1, 0] < -_NS:
            raise ContractError("The poses must reach from the begin of the turn to its end.")
        knots[:, 6] = np.unwrap(knots[:, 6])
        return knots

    def _rig(self, knots: Floats, faults: Lidar3dFaults) -> Rig:
        m = self._mount
        return Rig(
            knots=knots, arm=np.array((m.x, m.y, m.z)),
            R_base_lidar=np.ascontiguousarray(m.R_base_lidar() @ rotation_from_rpy(*faults.turned)),
            times=self._ages, azimuths=self._azimuths,
        )  # fmt: skip

    def _spoil(self, told: Echoes, faults: Lidar3dFaults, rng: np.random.Generator) -> None:
        """What the faults make of a turn, in place."""
        if faults.empty:
            told.distances[:] = 0.0
        if faults.rain > 0.0:
            shape = told.distances.shape
            wet, drops = rng.random(shape) < faults.rain, rng.uniform(self._params.least_range, _RAIN_REACH_M, shape)
            nearer = wet & ((told.distances == 0.0) | (drops < told.distances))
            told.distances[nearer], told.parts[nearer] = drops[nearer], int(Part.MIXED)

    def _told(self, stamp_ns: int, told: Echoes) -> SimTurn:
        """Points in the order of firing."""
        column, shot = np.nonzero(told.distances[:, self._fired])
        ring = self._fired[shot]
        d, azimuth = told.distances[column, ring], self._azimuths[column]
        flat = d * self._beams.cosines[ring]
        points = np.column_stack((flat * np.cos(azimuth), flat * np.sin(azimuth), d * self._beams.sines[ring]))
        cloud = PointCloud(
            points=points,
            times=self._ages[column] + self._beam_s[shot],
            intensities=np.clip(np.rint(100.0 * told.light[column, ring]), 1.0, 255.0).astype(np.uint8),
            rings=ring.astype(np.uint8),
        )
        return SimTurn(stamp_ns=stamp_ns, cloud=cloud, parts=told.parts[column, ring].astype(np.uint8))


def _echoes(shape: tuple[int, int]) -> Echoes:
    return Echoes(np.zeros(shape), np.zeros(shape), np.zeros(shape, np.int64))

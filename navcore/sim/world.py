"""The simulated world: one robot on a true site, with everything unkind on."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from navcore.errors import ContractError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount, robot_lidar
from navcore.maps.site_map import SiteMap
from navcore.messages import ImuSample, LidarScan, SimContact, SimFarm, SimTruth, TrueRow
from navcore.sim.body_pose import antenna_state
from navcore.sim.canopy import Canopy, CanopyParams
from navcore.sim.contacts import ContactDetector
from navcore.sim.gnss_receiver import GnssReceiver, GnssReceiverParams
from navcore.sim.imu import Imu, ImuParams
from navcore.sim.lidar2d import WORKING, Lidar2d, Lidar2dFaults, Lidar2dParams
from navcore.sim.map_error import MapErrorParams, perturb
from navcore.sim.orchard import OrchardParams
from navcore.sim.parking import parked
from navcore.sim.planting import build_orchard
from navcore.sim.terrain import SURFACE_TRAITS, Surface, Terrain, TerrainParams
from navcore.sim.vehicle_dynamics import VehicleDynamics, VehicleDynamicsParams, WheelState
from navcore.vehicle import VehicleParams

STEP_NS = 5_000_000
_IMU_STEPS = 2
_CONTACT_STEPS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldParams:
    """One world. The defaults are the unkind levels that every score is measured at.

    Attributes:
        seed: of everything random; it also replaces the orchard's own seed.
        place_seed: of the land and what stands on it, for several drives over the same place; None is `seed`.
        start: (x, y, yaw) of the robot in the true world; None parks it at the warehouse, not quite as drawn.
        parking_std_m, parking_std_deg: 1-sigma of that.
        payload: on the robot, kg.
        orchard, map_error, terrain, dynamics, imu, canopy, gnss: levels of each part.
        lidar2d: of the 2D LiDAR, None for a robot without one. lidar_mount: where it truly sits.
    """

    seed: int = 1
    place_seed: int | None = None
    start: tuple[float, float, float] | None = None
    parking_std_m: float = 0.10
    parking_std_deg: float = 2.0
    payload: float = 30.0
    orchard: OrchardParams = field(default_factory=OrchardParams)
    map_error: MapErrorParams = field(default_factory=MapErrorParams)
    terrain: TerrainParams = field(default_factory=TerrainParams)
    dynamics: VehicleDynamicsParams = field(default_factory=VehicleDynamicsParams)
    imu: ImuParams = field(default_factory=ImuParams)
    canopy: CanopyParams = field(default_factory=CanopyParams)
    gnss: GnssReceiverParams = field(default_factory=GnssReceiverParams)
    lidar2d: Lidar2dParams | None = None
    lidar_mount: LidarMount = field(default_factory=robot_lidar)


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldFaults:
    """Faults that a test can switch on at any instant, by replacing `World.faults`.

    Attributes:
        gnss_silent: the receiver sends nothing. gnss_frozen: fresh times, old position.
        corrections_lost: no RTK corrections arrive. gnss_off: it lies by so much east and north, m.
        imu_silent, imu_frozen: likewise.
        wheels_frozen: the chassis reports its last wheel state with fresh stamps.
        stuck: the wheels turn and the robot stays.
        drive_gain: the chassis drives so many times what it was told.
        lidar: what is broken of the 2D LiDAR.
    """

    gnss_silent: bool = False
    gnss_frozen: bool = False
    corrections_lost: bool = False
    gnss_off: tuple[float, float] = (0.0, 0.0)
    imu_silent: bool = False
    imu_frozen: bool = False
    wheels_frozen: bool = False
    stuck: bool = False
    drive_gain: float = 1.0
    lidar: Lidar2dFaults = WORKING


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldOutput:
    """What the world gives up to an instant.

    Attributes:
        truth: never an input of the navigator.
        wheels: as the chassis measures them now.
        imu: samples that have arrived since the last call, oldest first.
        nmea: bytes that have arrived since the last call.
        contacts: things touched since the last call.
        scans: turns of the 2D LiDAR that have arrived since the last call, oldest first.
        scan_owners: of each, what its rays truly met, as in `SimScan`; never an input of the navigator.
    """

    truth: SimTruth
    wheels: WheelState
    imu: tuple[ImuSample, ...]
    nmea: bytes
    contacts: tuple[SimContact, ...]
    scans: tuple[LidarScan, ...] = ()
    scan_owners: tuple[tuple[int, ...], ...] = ()


class World:
    """The true site and the robot on it. Same arguments and same calls: the same outputs, bit for bit.

    Attributes:
        site: the true site, perturbed from the drawn one. terrain: its ground. orchard: what stands on it.
        faults: what is broken now.
        touched: all contacts so far.
    """

    def __init__(self, site: SiteMap, vehicle: VehicleParams, params: WorldParams, start_ns: int = 0) -> None:
        # One generator per part: switching one part off leaves all others as they were.
        place_seed = params.seed if params.place_seed is None else params.place_seed
        streams = [*np.random.SeedSequence(place_seed).spawn(2), *np.random.SeedSequence(params.seed).spawn(7)[2:]]
        map_rng, ground_rng, drive_rng, imu_rng, gnss_rng, park_rng, lidar_rng = map(np.random.default_rng, streams)
        self._vehicle, self._start_ns, self._now_ns, self._steps = vehicle, start_ns, start_ns, 0
        self.site = perturb(site, params.map_error, map_rng)
        self.terrain = Terrain(self.site, params.terrain, ground_rng)
        orchard = build_orchard(self.site, replace(params.orchard, seed=place_seed))
        # A scan meets plants above their feet, where the slope matters; pictures are read by the feet.
        self.orchard = replace(orchard, uphill=self.terrain.slope) if params.lidar2d else orchard
        self.faults = WorldFaults()
        self.touched: list[SimContact] = []
        pose = parked(self.site, params.start, params.parking_std_m, params.parking_std_deg, park_rng)
        self._drive = VehicleDynamics(vehicle, params.dynamics, params.payload, pose, drive_rng)
        canopy = Canopy(self.orchard, params.canopy, params.seed)
        self._gnss = GnssReceiver(site.datum, canopy, params.gnss, gnss_rng)
        self._detector = ContactDetector(self.site, self.orchard, vehicle)
        self._ground = self._feel_ground()
        self._imu = Imu(params.imu, *self._ground[:2], imu_rng)
        self._imu_latency_ns = round(params.imu.latency_s * 1e9)
        self._acceleration = 0.0
        self._imu_sent: list[ImuSample] = []
        self._contacts: list[SimContact] = []
        self._wheels = self._drive.wheels(start_ns)
        self._lidar: Lidar2d | None = None
        if params.lidar2d is not None:
            self._lidar = Lidar2d(self.orchard, params.lidar_mount, params.lidar2d, lidar_rng)
            self._lidar.update(self._truth())

    def advance(self, now_ns: int, v: float, omega: float) -> WorldOutput:
        """Run to `now_ns` with the chassis' target set to (v, omega) from the last instant on.

        Raises NotFiniteError for a target that is no number and ContractError when time runs backwards.
        """
        if not (math.isfinite(v) and math.isfinite(omega)):
            raise NotFiniteError("The chassis' target must be finite numbers.")
        if now_ns < self._now_ns:
            raise ContractError("The world cannot run backwards.")
        self._drive.command(self._now_ns, v * self.faults.drive_gain, omega * self.faults.drive_gain)
        while self._now_ns + STEP_NS <= now_ns:
            self._step()
        return self._output(now_ns)

    def farm(self) -> SimFarm:
        """The true rows, for the score; to be published about once a second."""
        rows = tuple(TrueRow(id=r.id, start=r.start, end=r.end, width=r.width) for r in self.site.rows)
        return SimFarm(stamp_ns=self._now_ns, rows=rows)

    def _step(self) -> None:
        self._now_ns += STEP_NS
        self._steps += 1
        drive, before = self._drive, (self._drive.x, self._drive.y, self._drive.yaw)
        roll, pitch, surface = self._ground
        drive.step(self._now_ns, STEP_NS * 1e-9, roll, pitch, surface)
        if self.faults.stuck:
            drive.hold(before)
        self._acceleration += 0.2 * (drive.acceleration - self._acceleration)
        if self._steps % _IMU_STEPS == 0:
            self._ground = self._feel_ground()
            self._sample_imu()
        if self._steps % _CONTACT_STEPS == 0:
            self._contacts += self._detector.update(self._now_ns, drive.x, drive.y, drive.yaw)
        if (self._now_ns - self._start_ns) % self._gnss.period_ns < STEP_NS:
            self._receive()
        if self._lidar is not None:
            self._lidar.update(self._truth(), self.faults.lidar)

    def _feel_ground(self) -> tuple[float, float, Surface]:
        """Roll and pitch (rad) of the ground under the wheels, and what it is made of."""
        d, body = self._drive, self._vehicle
        roll, pitch = self.terrain.tilt(d.x, d.y, d.yaw, body.wheelbase, body.track)
        return roll, pitch, self.terrain.surface(d.x, d.y)

    def _sample_imu(self) -> None:
        roll, pitch, surface = self._ground
        sample = self._imu.sample(
            self._now_ns, _IMU_STEPS * STEP_NS * 1e-9, speed=self._drive.v, acceleration=self._acceleration,
            omega=self._drive.omega, roughness=SURFACE_TRAITS[surface].roughness,
            ground_roll=roll, ground_pitch=pitch,
        )  # fmt: skip
        if self.faults.imu_frozen and self._imu_sent:
            sample = replace(self._imu_sent[-1], stamp_ns=self._now_ns)
        if not self.faults.imu_silent:
            self._imu_sent.append(sample)

    def _receive(self) -> None:
        if self.faults.gnss_silent:
            return
        elapsed_s = (self._now_ns - self._start_ns) * 1e-9
        drive, faults, ground = self._drive, self.faults, self.terrain.height(self._drive.x, self._drive.y)
        antenna = antenna_state(drive, self._imu.roll, self._imu.pitch, self._vehicle, ground, faults.gnss_off)
        self._gnss.epoch(self._now_ns, elapsed_s, antenna, frozen=faults.gnss_frozen, starved=faults.corrections_lost)

    def _truth(self) -> SimTruth:
        d = self._drive
        land_roll, land_pitch = self.terrain.land_tilt(d.yaw)
        return SimTruth(
            stamp_ns=self._now_ns, x=d.x, y=d.y, yaw=d.yaw, roll=self._imu.roll - land_roll,
            pitch=self._imu.pitch - land_pitch, v=d.v, omega=d.omega,
        )  # fmt: skip

    def _output(self, now_ns: int) -> WorldOutput:
        arrived = [s for s in self._imu_sent if s.stamp_ns + self._imu_latency_ns <= now_ns]
        self._imu_sent = self._imu_sent[len(arrived) :]
        contacts, self._contacts = tuple(self._contacts), []
        self.touched += contacts
        if self.faults.wheels_frozen:
            self._wheels = replace(self._wheels, stamp_ns=self._now_ns)
        else:
            self._wheels = self._drive.wheels(self._now_ns)
        turns = () if self._lidar is None else self._lidar.due(now_ns)
        return WorldOutput(
            truth=self._truth(), wheels=self._wheels, imu=tuple(arrived), nmea=self._gnss.due(now_ns),
            contacts=contacts, scans=tuple(t.scan for t in turns), scan_owners=tuple(t.owners for t in turns),
        )  # fmt: skip

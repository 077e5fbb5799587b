"""A whole robot in one thread and in simulated time: world, chassis, guard, receiver, camera and navigator.

The very objects that run in separate processes on the robot. The same seed gives the same run, bit for bit.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from navcore.chassis.guard import Guard, GuardParams
from navcore.chassis.limits import LimitParams
from navcore.chassis.protocol import ChassisState
from navcore.chassis.scout_can import Frame
from navcore.drivers.nmea_stream import NmeaStream
from navcore.messages import (
    CameraRequest,
    CameraView,
    Decision,
    ImuSample,
    LidarScan,
    MapMatch,
    NavInputs,
    Odometry,
    Request,
    SimTruth,
)
from navcore.navigator import Navigator
from navcore.sim.scout_ecu import ScoutEcu
from navcore.sim.world import World, WorldOutput

MS = 1_000_000
# Waiting to be looked at; where no row matters nobody looks for minutes.
MOST_SCANS = 8


class Eye(Protocol):
    """Looks at the row as the row worker does."""

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """What is seen from where the robot truly is, and in the scans that arrived since the last look."""


class MapEye(Protocol):
    """Looks for the robot on the 3D map as the scan worker does."""

    def look(self, truth: SimTruth, motion: Odometry) -> MapMatch | None:
        """A match, when a turn of the LiDAR ends now. To be called at every tick."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LockstepParams:
    """Rates and delays of the simulated robot, ms.

    Attributes:
        physics_ms: step of the world. tick_ms: of the navigator (50 Hz). camera_ms: between pictures (10 Hz).
        camera_latency_ms: from exposure to the observation's arrival: sensor 80 ms and processing.
        map_latency_ms: from the end of the 3D LiDAR's turn to the match's arrival.
        start_ns: simulated monotonic time at which the run begins.
    """

    physics_ms: int = 5
    tick_ms: int = 20
    camera_ms: int = 100
    camera_latency_ms: int = 120
    map_latency_ms: int = 100
    start_ns: int = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Tick:
    """One tick of a run, for whoever listens: what went in, what came out, and the truth."""

    inputs: NavInputs
    decision: Decision
    truth: SimTruth
    chassis: ChassisState
    views: tuple[CameraView, ...]


class Lockstep:
    """Steps everything together."""

    def __init__(
        self, world: World, navigator: Navigator, eye: Eye | None, params: LockstepParams | None = None,
        map_eye: MapEye | None = None,
    ) -> None:  # fmt: skip
        self.map_eye = map_eye
        self._matches: deque[tuple[int, MapMatch]] = deque()
        self.params = params or LockstepParams()
        self.world, self.navigator, self.eye = world, navigator, eye
        limits = LimitParams(
            max_speed=navigator.vehicle.max_speed, max_turn_rate=navigator.vehicle.max_turn_rate
        )  # fmt: skip
        self.guard, self.ecu, self.receiver = Guard(GuardParams(limits=limits)), ScoutEcu(), NmeaStream()
        self.now_ns = self.params.start_ns
        self.listeners: list[Callable[[Tick], None]] = []
        self._requests: deque[Request] = deque()
        self._pictures: deque[tuple[int, CameraView]] = deque()
        self._next_picture_ns = self.now_ns
        self._camera: CameraRequest | None = None
        self._scans: tuple[LidarScan, ...] = ()

    def ask(self, request: Request) -> None:
        """Hand a request to the navigator with the next tick."""
        self._requests.append(request)

    def run(self, seconds: float, until: Callable[[Tick], bool] | None = None) -> Tick:
        """Tick for at most so long; ends early when `until` holds. The last tick."""
        end_ns = self.now_ns + int(seconds * 1e9)
        tick = self.tick()
        while self.now_ns < end_ns and not (until is not None and until(tick)):
            tick = self.tick()
        return tick

    def tick(self) -> Tick:
        """One tick of the navigator, with the physics up to it."""
        outputs = self._physics()
        self._scans = (*self._scans, *(scan for out in outputs for scan in out.scans))[-MOST_SCANS:]
        views = self._look(outputs[-1].truth)
        inputs = NavInputs(
            now_ns=self.now_ns,
            chassis=(self.guard.chassis_state(),),
            imu=_imu(outputs),
            gnss=tuple(fix for out in outputs for fix in self.receiver.feed(out.nmea, out.truth.stamp_ns)),
            rows=tuple(view.row for view in views),
            requests=self._taken_requests(),
            matches=self._match(outputs[-1].truth),
        )
        decision = self.navigator.step(self.now_ns, inputs)
        self._obey(decision)
        tick = Tick(inputs=inputs, decision=decision, truth=outputs[-1].truth, chassis=inputs.chassis[0], views=views)
        for listener in self.listeners:
            listener(tick)
        return tick

    def _physics(self) -> list[WorldOutput]:
        outputs = []
        for _ in range(self.params.tick_ms // self.params.physics_ms):
            self.now_ns += self.params.physics_ms * MS
            v, omega = self.ecu.target(self.now_ns)
            outputs.append(self.world.advance(self.now_ns, v, omega))
            for frame in self.ecu.feedback(self.now_ns, outputs[-1].wheels):
                self._send(self.guard.on_frame(frame, self.now_ns))
        self._send(self.guard.tick(self.now_ns))
        return outputs

    def _send(self, frames: tuple[Frame, ...]) -> None:
        for frame in frames:
            self.ecu.receive(frame, self.now_ns)

    def _look(self, truth: SimTruth) -> tuple[CameraView, ...]:
        """Take a picture when one is due and wanted; the views whose time of arrival has come."""
        if self.eye is not None and self._camera is not None and self.now_ns >= self._next_picture_ns:
            self._next_picture_ns = self.now_ns + self.params.camera_ms * MS
            view = self.eye.look(truth, self._camera, self._scans)
            self._scans = ()
            self._pictures.append((self.now_ns + self.params.camera_latency_ms * MS, view))
        arrived = []
        while self._pictures and self._pictures[0][0] <= self.now_ns:
            arrived.append(self._pictures.popleft()[1])
        return tuple(arrived)

    def _match(self, truth: SimTruth) -> tuple[MapMatch, ...]:
        """The matches whose time of arrival has come."""
        if self.map_eye is not None:
            match = self.map_eye.look(truth, self.navigator.odometry(self.now_ns))
            if match is not None:
                self._matches.append((self.now_ns + self.params.map_latency_ms * MS, match))
        arrived = []
        while self._matches and self._matches[0][0] <= self.now_ns:
            arrived.append(self._matches.popleft()[1])
        return tuple(arrived)

    def _taken_requests(self) -> tuple[Request, ...]:
        requests = tuple(self._requests)
        self._requests.clear()
        return requests

    def _obey(self, decision: Decision) -> None:
        if decision.guard_request is not None:
            self._send(self.guard.on_request(decision.guard_request, self.now_ns, self.now_ns))
        if decision.command is not None:
            self._send(self.guard.on_command(decision.command, self.now_ns))
        self._camera = decision.camera


def _imu(outputs: list[WorldOutput]) -> tuple[ImuSample, ...]:
    return tuple(sample for out in outputs for sample in out.imu)

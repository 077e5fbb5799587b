"""`rowpilot bench loop`: the whole station in real time, stopped again and again, judged by its log and the bus."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from navcore.bench.loop.browsers import OperatorBrowsers
from navcore.bench.loop.bus import BusWitness, MotionFrame, first_zero_after, was_moving
from navcore.bench.loop.farm import map_of, near_the_rows
from navcore.bench.loop.farm_import import ImportLoad
from navcore.bench.loop.log import LoopRecord, part, read_record
from navcore.bench.loop.rights import give_up_niceness, give_up_priority, has_priority
from navcore.bench.loop.station import LoopStation
from navcore.errors import TransportError
from navcore.maps.site_map import SiteMap
from navcore.messages import NavStatus, RunState
from navcore.runtime.simulation import SimulationParams
from navcore.topics import NAV_STATUS
from navcore.transport.codec import decode, encode
from navcore.transport.pubsub import Subscriber

PROMPT = ("guard", "navigator", "world", "row_worker")
MS = 1_000_000
START_S, STATE_S = 60.0, 30.0
STAND_S, MOVE_S, POLL_S = 1.0, 5.0, 0.1
FRESH_NS = 100 * MS
ZERO_S = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopParams:
    """How long, and under which load.

    Attributes:
        phase_s: driven with the priorities that the system grants, and again without any, s.
        drive_s: between two stops, s.
        browsers: on Drive. imports: an orthophoto is imported all the while.
        lidar3d: the robot carries a 3D LiDAR and has a map of the farm in use.
    """

    phase_s: float = 330.0
    drive_s: float = 6.0
    browsers: int = 2
    imports: bool = True
    lidar3d: bool = False


QUICK = LoopParams(phase_s=50.0, drive_s=1.5)


@dataclass(frozen=True, slots=True, kw_only=True)
class Phase:
    """One stretch of driving.

    Attributes:
        real_time: under SCHED_FIFO. stops_s: from click to zero at the chassis, s. missed: stops without a zero.
        record: what the log tells. frames: what the chassis got.
    """

    real_time: bool
    stops_s: tuple[float, ...]
    missed: int
    record: LoopRecord
    frames: tuple[MotionFrame, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Stretch:
    """When a phase was driven, monotonic ns, and its stops."""

    real_time: bool
    from_ns: int
    to_ns: int
    stops_s: tuple[float, ...]
    missed: int


class LoopBench:
    """Drives the shipped station. `tell` gets a line now and then."""

    def __init__(self, folder: Path, params: LoopParams, tell: Callable[[str], None]) -> None:
        self._params, self._tell = params, tell
        simulation = SimulationParams(lidar3d=params.lidar3d)
        # Before the station runs, whose processes go first.
        self._map = map_of(near_the_rows(), simulation) if params.lidar3d else None
        self._station = LoopStation(folder, simulation)
        self._status = Subscriber(self._station.endpoints, (NAV_STATUS.name,))
        self._browsers: OperatorBrowsers | None = None
        self._imports: ImportLoad | None = None

    def run(self) -> tuple[Phase, ...]:
        """Both phases; the first one only where SCHED_FIFO is not permitted. Raises TransportError."""
        self._start_mission(near_the_rows())
        witness = BusWitness(*self._station.can_bus())
        try:
            self._load()
            stretches = self._stretches(witness)
            self._station.post("/api/runs/current/stop")
            frames = tuple(witness.frames())
        finally:
            witness.close()
        self._station.close()  # the recorder finishes its log
        records = [read_record(log) for log in self._station.logs()]
        return tuple(_phase(stretch, records, frames) for stretch in stretches)

    def close(self) -> None:
        """End everything that was started."""
        if self._browsers is not None:
            self._browsers.close()
        if self._imports is not None:
            self._imports.close()
        self._status.close()
        self._station.close()

    def _start_mission(self, site: SiteMap) -> None:
        ask = self._station.post
        site_id = ask("/api/sites", {"site": _json(site)})["id"]
        ask("/api/robot/site", {"site_id": site_id})
        if self._map is not None:
            self._station.use_map(site_id, self._map)
        mission = ask(f"/api/sites/{site_id}/missions/for-row", {"row_id": site.rows[0].id, "exit": "reverse"})
        self._mission = ask(f"/api/sites/{site_id}/missions", {"mission": mission})["id"]
        self._start()

    def _start(self) -> None:
        deadline = time.monotonic() + START_S
        while True:
            nonce = self._station.get("/api/drive/nonce")["nonce"]
            wanted = {"mission_id": self._mission, "link_loss": "continue", "nonce": nonce}
            try:
                self._station.post("/api/runs", wanted)
            except TransportError:  # refused until the robot knows where it is
                if time.monotonic() > deadline:
                    raise
                time.sleep(1.0)
            else:
                return self._wait_for(RunState.DRIVING)

    def _load(self) -> None:
        if self._params.imports:
            self._imports = ImportLoad(self._station)
        if self._params.browsers:
            try:
                self._browsers = OperatorBrowsers(self._station, self._params.browsers)
            except ImportError:
                self._tell("Playwright is not installed: no browsers, and stops are sent by this process.")

    def _stretches(self, witness: BusWitness) -> list[Stretch]:
        pids = {name: pid for name, pid in self._station.processes().items() if name in PROMPT}
        permitted = all(has_priority(pid) for pid in pids.values())
        stretches = [self._drive(witness, real_time=permitted)]
        if permitted:
            give_up_priority(pids.values())
            stretches.append(self._drive(witness, real_time=False))
        return stretches

    def _drive(self, witness: BusWitness, *, real_time: bool) -> Stretch:
        from_ns = time.monotonic_ns()
        stops: list[float] = []
        missed = 0
        while time.monotonic_ns() - from_ns < self._params.phase_s * 1e9:
            if not real_time:
                give_up_niceness(os.getpid())
            self._pause(self._params.drive_s)
            took = self._stop(witness) if self._moves(witness) else None
            if took is not None:
                missed += math.isinf(took)
                stops += [] if math.isinf(took) else [took]
                self._tell(
                    f"{'with' if real_time else 'without'} SCHED_FIFO, stop {len(stops) + missed}: {took:.3f} s"
                )
            self._go_on()
        return Stretch(
            real_time=real_time, from_ns=from_ns, to_ns=time.monotonic_ns(), stops_s=tuple(stops), missed=missed
        )  # fmt: skip

    def _moves(self, witness: BusWitness) -> bool:
        """Wait until the chassis is told to drive; False if that does not come."""
        deadline = time.monotonic() + MOVE_S
        while time.monotonic() < deadline:
            newest = witness.frames(time.monotonic_ns() - FRESH_NS)
            if newest and not newest[-1].is_zero:
                return True
            self._pause(POLL_S)
        return False

    def _stop(self, witness: BusWitness) -> float | None:
        """From the press until the zero is at the chassis, s; infinite if it never came, None if the robot stood."""
        asked_ns = time.monotonic_ns()
        if self._browsers is not None:
            asked_ns = self._browsers.click_stop()
        else:
            self._station.post("/api/runs/current/stop")
        self._pause(ZERO_S)
        frames = witness.frames()
        if not was_moving(frames, asked_ns):
            return None
        zero_ns = first_zero_after(frames, asked_ns)
        return math.inf if zero_ns is None else (zero_ns - asked_ns) * 1e-9

    def _go_on(self) -> None:
        """Resume after a stop; begin anew after the mission's end."""
        self._pause(STAND_S)
        state = self._state()
        if state is RunState.STOPPED:
            with suppress(TransportError):  # refused while the pose settles: the next round asks again
                self._station.post("/api/runs/current/resume")
        elif state in (RunState.IDLE, RunState.FINISHED):
            self._start()

    def _pause(self, seconds: float) -> None:
        if self._browsers is not None:
            self._browsers.pause(seconds)
        else:
            time.sleep(seconds)

    def _state(self) -> RunState | None:
        received = self._status.newest(1000).get(NAV_STATUS.name)
        return None if received is None else decode(NavStatus, received.payload).state

    def _wait_for(self, state: RunState) -> None:
        deadline = time.monotonic() + STATE_S
        while time.monotonic() < deadline:
            received = self._status.newest(500).get(NAV_STATUS.name)
            status = None if received is None else decode(NavStatus, received.payload)
            if status is not None and status.state is state:
                return
        raise TransportError(f"The robot was not {state.value} within {STATE_S:.0f} s. Look at the station's log.")


def _json(site: SiteMap) -> object:
    import json

    return json.loads(encode(site))


def _phase(stretch: Stretch, records: list[LoopRecord], frames: tuple[MotionFrame, ...]) -> Phase:
    inside = [part(record, stretch.from_ns, stretch.to_ns) for record in records]
    longest = max(inside, key=lambda record: len(record.tick_ns))
    return Phase(
        real_time=stretch.real_time, stops_s=stretch.stops_s, missed=stretch.missed, record=longest, frames=frames
    )  # fmt: skip

"""The simulated robot at the other end of the bus: its own navigator, in simulated time, as fast as it goes."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

from navcore.messages import Request, RequestKind, SimTruth
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.topics import MAP_MATCH, NAV_PLAN, NAV_STATUS
from navcore.transport.codec import decode
from navcore.transport.pubsub import Publisher
from navcore.transport.request import Replier
from tests.backend.played_robot import PlayedRobot


class LockstepRobot(PlayedRobot):
    """As `PlayedRobot`, but the navigator decides.

    Attributes:
        truth: of the newest tick.
    """

    def __init__(self, bus_dir: Path, lockstep: Lockstep) -> None:
        self.lockstep = lockstep
        self.truth: SimTruth | None = None
        super().__init__(bus_dir)

    def _navigate(self) -> None:
        with (
            Publisher(self.endpoints, "navigator") as publisher,
            Publisher(self.endpoints, "scan_worker") as scan_worker,
            Replier(self.endpoints.navigator_requests) as door,
        ):
            while not self._ended.is_set():
                question = door.receive(0)
                request = None if question is None else decode(Request, question)
                if request is not None:
                    self.requests.append(request)
                    self.lockstep.ask(request)
                tick = self.lockstep.tick()
                self.truth = tick.truth
                if request is not None:
                    self._reply(request, tick, publisher, door)
                self._tell(tick, publisher, scan_worker)

    def _reply(self, request: Request, tick: Tick, publisher: Publisher, door: Replier) -> None:
        reply = next(r for r in tick.decision.replies if r.request_id == request.request_id)
        if reply.accepted and request.kind is RequestKind.START:
            publisher.publish(NAV_PLAN.name, request.plan)
        door.reply(reply)

    def _tell(self, tick: Tick, publisher: Publisher, scan_worker: Publisher) -> None:
        """Simulated times are moved to now: the station asks how old a message is."""
        now_ns = time.monotonic_ns()
        publisher.publish(NAV_STATUS.name, replace(tick.decision.status, stamp_ns=now_ns))
        for match in tick.inputs.matches:
            scan_worker.publish(MAP_MATCH.name, replace(match, stamp_ns=now_ns))

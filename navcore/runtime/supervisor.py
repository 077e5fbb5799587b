"""Starts the processes of the table, starts again what dies, and moves the robot to another farm.

It never moves the robot: a navigator or guard that was started again waits for a new deliberate start.
"""

from __future__ import annotations

import fcntl
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import IO

from navcore.errors import InputError, RowpilotError, TransportError
from navcore.runtime.child import Child
from navcore.runtime.processes import PROCESSES, ProcessSpec, Robot
from navcore.runtime.site_file import read_site
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Replier
from navcore.transport.supervision import SupervisorReply, SupervisorRequest, SupervisorRequestKind

WAIT_MS = 50


class Supervisor:
    """All processes of one robot. For one thread, which must live as long as they."""

    def __init__(
        self, robot: Robot, site_id: str | None, environment: dict[str, str],
        table: tuple[ProcessSpec, ...] = PROCESSES,
    ) -> None:  # fmt: skip
        """Raises TransportError if another one holds the directory of sockets."""
        endpoints = Endpoints(robot.bus)
        endpoints.prepare()
        self._lock = hold(robot.bus)
        self._robot, self._site_id = robot, site_id
        there = [spec for spec in table if robot.simulation is not None or not spec.simulated_only]
        specs = [spec for spec in there if spec.wanted(robot)]
        self._children = [Child(spec, environment) for spec in specs]
        self._replier = Replier(endpoints.supervisor_requests)

    def start(self) -> None:
        """Start all, in the table's order."""
        for child in self._children:
            child.start(self._robot, time.monotonic())

    def watch(self) -> None:
        """Answer one question, and look after everybody. To be called for ever."""
        question = self._replier.receive(WAIT_MS)
        if question is not None:
            self._replier.reply(self._answer(question))
        for child in self._children:
            child.watch(self._robot, time.monotonic())

    def close(self) -> None:
        """End all, in the reverse order: the world outlives the guard, whose last word is zero."""
        for child in reversed(self._children):
            child.end()
        self._replier.close()
        self._lock.close()

    def _answer(self, question: bytes) -> SupervisorReply:
        try:
            request = decode(SupervisorRequest, question)
            if request.kind is SupervisorRequestKind.LOAD_SITE:
                self._load_site(request)
            elif request.kind is SupervisorRequestKind.LOAD_CALIBRATION:
                self._load_calibration()
        except RowpilotError as error:
            return self._reply(str(error))
        return self._reply()

    def _load_site(self, request: SupervisorRequest) -> None:
        """End whoever knows the farm, and start them on the other one. A robot that was driving stops and latches."""
        if request.site_path is None:
            raise InputError("There is no site to load. Name the file of its map.")
        site = Path(request.site_path)
        if read_site(site).warehouse is None:
            raise InputError("The robot has no place there: draw the warehouse first.")
        self._robot, self._site_id = replace(self._robot, site=site), request.site_id
        self._start_again([child for child in self._children if child.spec.knows_site])

    def _load_calibration(self) -> None:
        """A simulated robot's eyes know no stored calibration."""
        if self._robot.calibration is not None:
            self._start_again([child for child in self._children if child.spec.knows_calibration])

    def _start_again(self, children: Sequence[Child]) -> None:
        for child in reversed(children):
            child.ask_to_end()
        for child in reversed(children):
            child.end()
        for child in children:
            child.start(self._robot, time.monotonic())

    def _reply(self, reason: str = "") -> SupervisorReply:
        return SupervisorReply(
            accepted=not reason, reason=reason, site_id=self._site_id, site_path=str(self._robot.site),
            simulated=self._robot.simulation is not None,
            processes=tuple(child.status() for child in self._children),
        )  # fmt: skip


def hold(directory: Path) -> IO[bytes]:
    """Lock a directory of sockets for this process. Raises TransportError if another one has it."""
    lock = (directory / "supervisor.lock").open("wb")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        lock.close()
        raise TransportError(
            f"Rowpilot is already running with {directory}. Stop it first, or set ROWPILOT_BUS_DIR for a second one."
        ) from None
    return lock

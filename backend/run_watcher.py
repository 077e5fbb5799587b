"""Keeps the row of the run under way up to date, from the live feed. It only reads; it never starts anything."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime

from sqlalchemy.exc import SQLAlchemyError

from backend.run_figures import RunFigures, resumed
from backend.runs import RunStore
from backend.worker import Worker
from navcore.errors import InputError
from navcore.messages import ModeSwitch, NavStatus, RunState
from navcore.topics import NAV_PLAN, NAV_STATUS, NAV_SWITCH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Received, Subscriber

log = logging.getLogger("rowpilot.station")
POLL_MS = 50
WRITE_S = 1.0
LOST_S = 30.0
FORGOTTEN = "The robot was started again during this run. The log of the run tells what happened."
LOST = "The station has not heard of the robot since. The log of the run tells what happened."
OVER = frozenset({RunState.IDLE, RunState.FINISHED})


class RunWatcher(Worker):
    """A thread with a subscription of its own: a slow disk delays nobody. What was seen is written at the end."""

    def __init__(
        self,
        endpoints: Endpoints,
        runs: RunStore,
        show_plan: Callable[[Received], None],
        on_end: Callable[[str], None],
    ) -> None:
        """`show_plan` gets the stored plan of a run found under way; `on_end` the id of a run that has ended."""
        super().__init__("run-watcher")
        self._endpoints = endpoints
        self._runs = runs
        self._show_plan = show_plan
        self._on_end = on_end
        self._figures: RunFigures | None = None
        self._told_run: str | None = ""  # the robot's last word on what it drives; nothing yet
        self._written_s = 0.0
        self._heard_s = time.monotonic()

    def _work(self) -> None:
        with Subscriber(self._endpoints, (NAV_STATUS.name, NAV_SWITCH.name)) as subscriber:
            while not self._closing.is_set():
                received = subscriber.receive(POLL_MS)
                while received is not None:
                    self._take(received)
                    received = subscriber.receive(0)
                self._write_when_due()
        self._write()

    def _take(self, received: Received) -> None:
        with suppress(InputError):  # a navigator of another version: the front end says so, the run goes on
            if received.name == NAV_STATUS.name:
                self._take_status(decode(NavStatus, received.payload))
            elif self._figures is not None:
                self._figures.add_switch(decode(ModeSwitch, received.payload))

    def _take_status(self, status: NavStatus) -> None:
        self._heard_s = time.monotonic()
        if self._figures is not None and self._figures.run_id != status.run_id:
            self._end(self._figures)
        if status.run_id != self._told_run:
            self._told_run = status.run_id
            self._interrupt_all_but(status.run_id, FORGOTTEN)
        if status.run_id is not None:
            self._add(status.run_id, status)

    def _add(self, run_id: str, status: NavStatus) -> None:
        if self._figures is None:
            self._figures = self._follow(run_id)
        before = self._figures.last
        self._figures.add(status)
        if status.state in OVER and (before is None or before.state not in OVER):
            self._write()
            self._on_end(run_id)

    def _end(self, figures: RunFigures) -> None:
        """A stopped run that the robot speaks of no more was acknowledged: nobody can resume it."""
        self._let_go()
        if figures.last is not None and figures.last.state not in OVER:
            self._on_end(figures.run_id)

    def _follow(self, run_id: str) -> RunFigures:
        """A run that we did not see begin, after a restart of the station, gets its plan from the database."""
        plan = self._runs.plan_bytes(run_id)
        if plan is not None:
            self._show_plan(Received(NAV_PLAN.name, plan, b""))
            return resumed(self._runs.get(run_id))
        return RunFigures(run_id)

    def _let_go(self) -> None:
        if self._figures is not None:
            self._write()
            self._figures = None

    def _write_when_due(self) -> None:
        now_s = time.monotonic()
        if now_s - self._heard_s > LOST_S:
            self._give_up()
        elif now_s - self._written_s >= WRITE_S:
            self._write()

    def _give_up(self) -> None:
        self._heard_s = time.monotonic()
        self._let_go()
        self._interrupt_all_but(None, LOST)

    def _interrupt_all_but(self, run_id: str | None, reason: str) -> None:
        with suppress(SQLAlchemyError):
            self._runs.interrupt_all_but(run_id, reason)

    def _write(self) -> None:
        self._written_s = time.monotonic()
        figures = self._figures
        if figures is None:
            return
        events, figures.fresh_events = figures.fresh_events, []
        try:
            self._runs.write_figures(figures.run_id, figures.columns(datetime.now(UTC)), events)
        except SQLAlchemyError:  # a full or locked disk must not end the watching; the next write has all sums
            figures.fresh_events = events + figures.fresh_events
            log.exception("cannot write the figures of run %s", figures.run_id)

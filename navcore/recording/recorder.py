"""Writes what the bus says into the log of the run. Whatever goes wrong here is told, and stops nobody."""

from __future__ import annotations

from pathlib import Path

from navcore.messages import RecorderStatus
from navcore.recording.requests import (
    RecorderReply,
    RecorderRequest,
    RecorderRequestKind,
    RecordingSummary,
)
from navcore.recording.run_log import RunLog, RunLogParams
from navcore.transport.pubsub import Received


class Recorder:
    """At most one open log. Clocks are arguments: monotonic ns, and ns since 1970 for people."""

    def __init__(self, params: RunLogParams | None = None) -> None:
        self._params = params or RunLogParams()
        self._log: RunLog | None = None
        self._last: RecordingSummary | None = None
        self._problem = ""

    def answer(self, request: RecorderRequest, now_ns: int, wall_ns: int) -> RecorderReply:
        """Do what is asked."""
        if request.kind is RecorderRequestKind.START:
            return self._start(request, now_ns, wall_ns)
        if request.kind is RecorderRequestKind.FINISH:
            return self._finish(request, now_ns)
        return self._reply(now_ns)

    def take(self, received: Received, now_ns: int) -> None:
        """Write a message, if a log is open."""
        if self._log is not None:
            try:
                self._log.write(received, now_ns)
            except OSError as error:
                self._give_up(error, now_ns)

    def idle(self, now_ns: int) -> None:
        """To be called at least once per second, also when nothing comes."""
        if self._log is not None:
            try:
                self._log.sync_if_due(now_ns)
            except OSError as error:
                self._give_up(error, now_ns)

    def close(self, now_ns: int) -> None:
        """Finish what is open."""
        if self._log is not None:
            self._close(self._log, now_ns)

    def status(self, now_ns: int) -> RecorderStatus:
        """For the operator."""
        summary = self._log.summary(now_ns) if self._log else self._last
        return RecorderStatus(
            stamp_ns=now_ns, recording=self._log is not None, run_id=summary.run_id if summary else None,
            size_bytes=summary.size_bytes if summary else 0, problem=self._problem,
        )  # fmt: skip

    def _start(self, request: RecorderRequest, now_ns: int, wall_ns: int) -> RecorderReply:
        if request.run_id is None or request.path is None:
            return self._reply(now_ns, "A recording needs a run and a file.")
        self.close(now_ns)
        self._problem = ""
        path = Path(request.path)
        try:
            self._log = RunLog(path, request.run_id, request.metadata, now_ns, wall_ns, self._params)
        except FileExistsError:
            return self._reply(now_ns, f"There is already a log {path.name}. It is not overwritten.")
        except OSError as error:
            self._problem = f"The run is not recorded: {error.strerror}. Make room on the disk."
            return self._reply(now_ns, self._problem)
        return self._reply(now_ns)

    def _finish(self, request: RecorderRequest, now_ns: int) -> RecorderReply:
        if self._log is None:
            known = self._last is not None and request.run_id in (None, self._last.run_id)
            return self._reply(now_ns, "" if known else "Nothing is being recorded.")
        if request.run_id not in (None, self._log.run_id):
            return self._reply(now_ns, f"Run {self._log.run_id} is being recorded, not {request.run_id}.")
        self._close(self._log, now_ns)
        return self._reply(now_ns)

    def _close(self, log: RunLog, now_ns: int) -> None:
        try:
            log.finish()
        except OSError as error:
            self._give_up(error, now_ns)
            return
        self._log, self._last = None, log.summary(now_ns)

    def _give_up(self, error: OSError, now_ns: int) -> None:
        if self._log is None:
            return
        self._problem = f"The run is no longer recorded: {error.strerror}. Make room on the disk."
        self._log.abandon()
        self._last, self._log = self._log.summary(now_ns, self._problem), None

    def _reply(self, now_ns: int, reason: str = "") -> RecorderReply:
        summary = self._log.summary(now_ns) if self._log else self._last
        return RecorderReply(accepted=not reason, recording=self._log is not None, reason=reason, summary=summary)

"""Keeps the calibrating process running while somebody looks at it, and starts it again when it has died."""

from __future__ import annotations

import subprocess
import time
from threading import Lock

from backend.settings import Settings
from backend.tied import tied
from backend.worker import Worker

IDLE_S = 30.0  # nobody asked for so long: the page is closed
PAUSE_S = 0.5
LONGEST_PAUSE_S = 10.0
CALM_S = 10.0
PATIENCE_S = 4.0
POLL_S = 0.1


class CalibratorKeeper(Worker):
    """A thread that keeps at most one child process. Safe for many threads."""

    def __init__(self, settings: Settings) -> None:
        super().__init__("calibrator")
        self._settings = settings
        self._one = Lock()
        self._wanted_s = float("-inf")
        self._child: subprocess.Popen[bytes] | None = None
        self._started_s = self._not_before_s = 0.0
        self._pause_s = PAUSE_S
        self.deaths = 0

    def want(self) -> None:
        """Somebody asks for it now."""
        with self._one:
            self._wanted_s = time.monotonic()

    def end(self) -> None:
        """The calibration is over: no process of it runs when this returns."""
        with self._one:
            self._wanted_s, self.deaths, self._pause_s = float("-inf"), 0, PAUSE_S
            self._end_child()

    def _work(self) -> None:
        while not self._closing.wait(POLL_S):
            with self._one:
                self._look_after(time.monotonic())
        with self._one:
            self._end_child()

    def _look_after(self, now_s: float) -> None:
        if self._child is not None and self._child.poll() is not None:
            finished = self._child.returncode == 0  # there was nothing to calibrate any more
            self._child = None
            self._wanted_s = float("-inf") if finished else self._wanted_s
            self.deaths += not finished
            self._pause_s = PAUSE_S if now_s - self._started_s > CALM_S else min(2 * self._pause_s, LONGEST_PAUSE_S)
            self._not_before_s = now_s + self._pause_s
        wanted = now_s - self._wanted_s <= IDLE_S
        if wanted and self._child is None and now_s >= self._not_before_s:
            self._child = subprocess.Popen(command(self._settings), stdin=subprocess.DEVNULL)
            self._started_s = now_s
        elif not wanted:
            self._end_child()

    def _end_child(self) -> None:
        if self._child is None:
            return
        self._child.terminate()
        try:
            self._child.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        self._child = None


def command(settings: Settings) -> list[str]:
    """Of the calibrating process."""
    return tied(
        "backend.calibrator.process",
        f"--bus={settings.bus_dir}",
        f"--session={settings.calibration_session_dir}",
        f"--versions={settings.calibration_dir}",
        f"--rehearsals={settings.rehearsal_dir}",
    )

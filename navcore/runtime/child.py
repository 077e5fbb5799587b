"""One supervised process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress

from navcore.runtime.processes import ProcessSpec, Robot
from navcore.transport.supervision import ProcessStatus

FIRST_PAUSE_S = 0.2
LONGEST_PAUSE_S = 30.0
CALM_S = 30.0
TIED = "navcore.runtime.tied"
# Matrices here are small: threads that share them wait for each other, and take the cores from who is in a hurry.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


class Child:
    """Started, watched, and started again after a pause that grows while it keeps dying. Times are monotonic s."""

    def __init__(self, spec: ProcessSpec, environment: dict[str, str]) -> None:
        self.spec = spec
        self.restarts = 0
        self._environment = environment
        self._process: subprocess.Popen[bytes] | None = None
        self._started_s = 0.0
        self._start_at_s: float | None = None
        self._pause_s = FIRST_PAUSE_S

    def start(self, robot: Robot, now_s: float) -> None:
        """Start it; it ends with us, however we end."""
        module = self.spec.module, *self.spec.arguments(robot)
        command = sys.executable, "-m", TIED, str(os.getpid()), *module
        environment = {**ONE_THREAD, **os.environ, **self._environment}
        self._process = subprocess.Popen(command, env=environment, start_new_session=True)
        self._started_s, self._start_at_s = now_s, None

    def watch(self, robot: Robot, now_s: float) -> None:
        """Start it again if it has died."""
        if self._process is not None and self._process.poll() is not None:
            self._process = None
            self._pause_s = FIRST_PAUSE_S if now_s - self._started_s > CALM_S else self._pause_s
            self._start_at_s = now_s + self._pause_s
            self._pause_s = min(2 * self._pause_s, LONGEST_PAUSE_S)
        if self._start_at_s is not None and now_s >= self._start_at_s:
            self.restarts += 1
            self.start(robot, now_s)

    def ask_to_end(self) -> None:
        """SIGTERM."""
        self._start_at_s = None
        if self._process is not None:
            with suppress(ProcessLookupError):
                self._process.send_signal(signal.SIGTERM)

    def end(self) -> None:
        """SIGTERM, and SIGKILL for who does not listen."""
        self.ask_to_end()
        if self._process is None:
            return
        try:
            self._process.wait(self.spec.patience_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process = None

    def status(self) -> ProcessStatus:
        """For whoever asks."""
        process = self._process
        running = process is not None and process.poll() is None
        pid = process.pid if process is not None and running else None
        return ProcessStatus(name=self.spec.name, running=running, pid=pid, restarts=self.restarts)

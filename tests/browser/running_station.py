"""The station as a newcomer starts it: `rowpilot run`, with all its processes, in folders of its own."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Self

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/enter\?token=\S+")
START_S = 120.0
END_S = 60.0


class RunningStation:
    """`rowpilot run` on a free port; ended with all its processes on leaving the context."""

    def __init__(self, data: Path) -> None:
        data.mkdir(parents=True, exist_ok=True)
        self.data = data
        self._bus = Path(tempfile.mkdtemp(prefix="rp-"))  # short: the names of sockets must be
        self._out, self._err = data / "stdout.txt", data / "stderr.txt"
        self._process = self._start()
        self.address = self._printed_address()

    @property
    def origin(self) -> str:
        """Scheme, host and port."""
        return self.address.partition("/enter")[0]

    def _start(self) -> subprocess.Popen[bytes]:
        command = (
            str(Path(sys.executable).parent / "rowpilot"),
            "run",
            "--port",
            "0",
            "--data",
            str(self.data),
        )
        environment = {**os.environ, "ROWPILOT_BUS_DIR": str(self._bus)}
        with self._out.open("wb") as out, self._err.open("wb") as err:
            return subprocess.Popen(command, stdout=out, stderr=err, env=environment, start_new_session=True)

    def _printed_address(self) -> str:
        deadline = time.monotonic() + START_S
        while time.monotonic() < deadline and self._process.poll() is None:
            if found := ADDRESS.search(self._out.read_text()):
                return found[0]
            time.sleep(0.2)
        self.close()
        raise AssertionError(f"No address was printed.\n{self._err.read_text()[-4000:]}")

    def complaints(self) -> str:
        """The end of what its processes wrote about errors, for the report of a failed test."""
        return self._err.read_text()[-4000:]

    def close(self) -> None:
        """As Ctrl-C does, and by force if that does not help."""
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        shutil.rmtree(self._bus, ignore_errors=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

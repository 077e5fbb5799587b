"""Runs the 3D view beside the station and starts it again when it ends; nothing else depends on it."""

from __future__ import annotations

import subprocess

from backend.settings import Settings
from backend.tied import tied
from backend.worker import Worker

PAUSE_S = 3.0
PATIENCE_S = 3.0


class SceneProcess(Worker):
    """A thread that keeps one child process."""

    def __init__(self, settings: Settings) -> None:
        super().__init__("scene")
        self._settings = settings

    def start(self) -> None:
        """Begin, if the settings name a port."""
        if self._settings.scene_port is not None:
            super().start()

    def _work(self) -> None:
        while not self._closing.is_set():
            # Its banner on stdout names an address that only the station may use.
            with subprocess.Popen(
                command(self._settings), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL
            ) as child:
                while child.poll() is None and not self._closing.wait(0.2):
                    pass
                end(child)
            self._closing.wait(PAUSE_S)


def command(settings: Settings) -> list[str]:
    """Of the 3D view."""
    return tied(
        "backend.scene",
        f"--bus={settings.bus_dir}",
        f"--port={settings.scene_port}",
        f"--data={settings.data_dir}",
        f"--vehicle={settings.vehicle}",
    )


def end(child: subprocess.Popen[bytes]) -> None:
    """Asked first, then made to."""
    child.terminate()
    try:
        child.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        child.kill()

"""The 3D view is a process of its own, and never outlives its station."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys
from pathlib import Path

from backend.scene_proxy import answers
from backend.settings import Settings
from tests.backend.played_robot import until
from tests.living_process import ends

STATION = """
import sys, threading
from backend.scene_process import SceneProcess
from backend.settings import Settings
SceneProcess(Settings.model_validate_json(sys.argv[1])).start()
threading.Event().wait()
"""


def children(process: int) -> list[int]:
    """Of all its threads."""
    tasks = Path(f"/proc/{process}/task").iterdir()
    return [int(child) for task in tasks for child in (task / "children").read_text().split()]


def test_the_view_ends_with_its_station_even_when_that_is_killed(settings: Settings, tmp_path: Path) -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    text = settings.model_copy(update={"scene_port": port}).model_dump_json()
    log = tmp_path / "log"
    with log.open("wb") as told, subprocess.Popen([sys.executable, "-c", STATION, text], stderr=told) as station:
        try:
            assert until(lambda: answers(port), 60.0)
            assert all(answers(port) for _ in range(5))
            (view,) = children(station.pid)
        finally:
            station.send_signal(signal.SIGKILL)
    assert ends(view)
    assert not answers(port)
    assert log.read_text() == ""  # looking whether it is there is no failure

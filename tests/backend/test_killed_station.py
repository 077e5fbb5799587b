"""The whole station process, killed under a robot that drives."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from typing import Any

import pytest

from backend.settings import Settings
from navcore.messages import RequestKind, RunState
from tests.backend.played_robot import PlayedRobot, until


class StationProcess:
    """`python -m backend`, as it is served."""

    def __init__(self, settings: Settings, port: int = 0) -> None:
        self._environment = os.environ | {
            "ROWPILOT_DATA_DIR": str(settings.data_dir),
            "ROWPILOT_BUS_DIR": str(settings.bus_dir),
            "ROWPILOT_SCENE": "false",
            "ROWPILOT_PORT": str(port),
        }
        self.log = settings.data_dir.parent / "station.log"
        with self.log.open("ab") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "backend"], env=self._environment, stdout=subprocess.PIPE, stderr=log
            )
        self.address, self.token = self._read_address()
        self.port = int(self.address.rpartition(":")[2])

    def _read_address(self) -> tuple[str, str]:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            found = re.search(rb"(http://\S+)/enter\?token=(\S+)", line)
            if found:
                return found[1].decode(), found[2].decode()
        raise AssertionError(self.log.read_text())

    def enter(self) -> None:
        class NoRedirect(urllib.request.HTTPRedirectHandler):
            def redirect_request(self, *_: Any) -> None:
                return None

        opener = urllib.request.build_opener(NoRedirect)
        assert until(lambda: self._is_up())
        codes = []
        for _ in range(2):
            try:
                opener.open(f"{self.address}/enter?token={self.token}")
            except urllib.error.HTTPError as answer:
                codes.append(answer.code)
                answer.close()
        assert codes == [303, 403]

    def _is_up(self) -> bool:
        try:
            urllib.request.urlopen(f"{self.address}/api/session").close()
        except OSError:
            return False
        return True

    def kill(self, number: int) -> int:
        self.process.send_signal(number)
        return self.process.wait(30.0)


@pytest.fixture
def processes() -> Iterator[list[StationProcess]]:
    started: list[StationProcess] = []
    yield started
    for station in started:
        if station.process.poll() is None:
            station.kill(signal.SIGKILL)
        if station.process.stdout is not None:
            station.process.stdout.close()


def test_a_killed_station_comes_back_without_moving_anything(
    robot: PlayedRobot, settings: Settings, processes: list[StationProcess]
) -> None:
    robot.state, robot.run_id = RunState.DRIVING, "a" * 16
    first = StationProcess(settings)
    processes.append(first)
    first.enter()
    before = robot.x
    assert first.kill(signal.SIGKILL) == -signal.SIGKILL
    assert until(lambda: robot.x > before + 0.2)
    second = StationProcess(settings, first.port)
    processes.append(second)
    second.enter()
    assert robot.state is RunState.DRIVING
    assert set(robot.kinds()) <= {RequestKind.HEARTBEAT}
    assert first.token not in first.log.read_text()
    assert second.token not in first.log.read_text()
    assert "GET /enter" in first.log.read_text()
    assert second.kill(signal.SIGTERM) in (0, -signal.SIGTERM)

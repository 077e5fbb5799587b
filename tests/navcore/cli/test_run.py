"""`rowpilot run` starts everything, prints one address, and takes everything with it when it ends."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app

DEADLINE_S = 60.0
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/enter\?token=\S+")


@pytest.fixture
def folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="rp") as name:
        yield Path(name)


@pytest.fixture(scope="module")
def known_data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Data of the station: made by its first start, and found by those after it."""
    return tmp_path_factory.mktemp("run") / "data"


def start(folder: Path, data: Path) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", "from navcore.cli import main; main()", "run", "--port", "0"]
    environment = {**os.environ, "ROWPILOT_BUS_DIR": str(folder / "bus")}
    return subprocess.Popen(
        [*command, "--data", str(data)], env=environment, text=True, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )  # fmt: skip


def processes_of(folder: Path) -> list[int]:
    """Living processes that have this folder on their command line or in their environment."""
    found = []
    for process in Path("/proc").iterdir():
        if process.name.isdigit() and int(process.name) != os.getpid():
            try:
                told = (process / "cmdline").read_bytes() + (process / "environ").read_bytes()
            except OSError:
                continue
            if str(folder).encode() in told:
                found.append(int(process.name))
    return found


@pytest.mark.realtime
@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_one_address_is_printed_and_nothing_outlives_the_command(
    folder: Path, known_data: Path, ending: signal.Signals
) -> None:
    station = start(folder, known_data)
    assert station.stdout is not None
    printed = ""
    while not ADDRESS.search(printed):
        line = station.stdout.readline()
        assert line, printed
        printed += line
    assert len(ADDRESS.findall(printed)) == 1
    assert len(processes_of(folder)) >= 6
    station.send_signal(ending)
    deadline = time.monotonic() + DEADLINE_S
    while processes_of(folder):
        assert time.monotonic() < deadline, processes_of(folder)
        time.sleep(0.05)
    station.communicate()


def test_a_real_robot_needs_a_receiver(folder: Path) -> None:
    result = CliRunner().invoke(app, ["run", "--can", "can0", "--data", str(folder / "data")])
    assert result.exit_code == 1
    assert "needs a receiver" in result.output
    assert not (folder / "data").exists()


def test_settings_of_the_simulation_that_are_none_are_refused(folder: Path) -> None:
    arguments = ["run", "--data", str(folder / "data"), "--simulation", '{"season": "monsoon"}']
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 1
    assert "simulation" in result.output
    assert not (folder / "data").exists()


@pytest.mark.parametrize("content", [None, "<gpx>", '[front_camera]\nsauce = "/dev/video0"\n'])
def test_settings_of_the_robot_are_refused_before_anything_begins(folder: Path, content: str | None) -> None:
    settings = folder / "robot.toml"
    if content is not None:
        settings.write_text(content)
    result = CliRunner().invoke(app, ["run", "--data", str(folder / "data"), "--config", str(settings)])
    assert result.exit_code == 1
    assert result.output.startswith("rowpilot: ")
    assert "robot.toml" in result.output or "sauce" in result.output
    assert not (folder / "data").exists()

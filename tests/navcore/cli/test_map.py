"""`rowpilot map`: a log becomes files; killed in the middle it goes on; what it cannot use it refuses in words."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.maps.ndt.ndt_file import read_ndt_map
from tests.navcore.mapping.point_orchard import DriveCase, write_log

KEYFRAMES_BEFORE_THE_KILL = 4


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_log(tmp_path_factory.mktemp("log") / "run.mcap", DriveCase(length=5.0))


def started(log: Path, out: Path) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "navcore.cli", "map", str(log), "--out", str(out), "--json", "--progress-json"]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def wait_for(folder: Path, keyframes: int) -> None:
    deadline = time.monotonic() + 300.0
    while len(list(folder.glob("*.npz"))) < keyframes:
        assert time.monotonic() < deadline, "no keyframes came"
        time.sleep(0.01)


def test_a_killed_map_goes_on_and_ends_as_if_it_had_not_been(log: Path, tmp_path: Path) -> None:
    killed = started(log, tmp_path / "killed")
    wait_for(tmp_path / "killed" / "keyframes", KEYFRAMES_BEFORE_THE_KILL)
    killed.send_signal(signal.SIGKILL)
    killed.communicate()
    assert killed.returncode == -signal.SIGKILL
    assert not (tmp_path / "killed" / "report.json").exists()
    first = tmp_path / "killed" / "keyframes" / "000001.npz"
    kept = first.stat().st_mtime_ns
    resumed = started(log, tmp_path / "killed")
    wait_for(tmp_path / "killed" / "keyframes", KEYFRAMES_BEFORE_THE_KILL + 2)
    assert first.stat().st_mtime_ns == kept  # not made anew
    told = json.loads(resumed.communicate()[0])
    assert resumed.returncode == 0
    whole = started(log, tmp_path / "whole")
    assert json.loads(whole.communicate()[0]) | {"files": told["files"]} == told
    for name in ("map.ndt", "cloud.pcd"):
        assert (tmp_path / "killed" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert not (tmp_path / "killed" / "keyframes").exists()
    assert len(read_ndt_map(tmp_path / "killed" / "map.ndt")) > 100


def test_a_log_without_clouds_is_refused_in_words(tmp_path: Path) -> None:
    blind = write_log(tmp_path / "blind.mcap", DriveCase(length=1.0, scans=False))
    result = CliRunner().invoke(app, ["map", str(blind), "--out", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "has no clouds of a 3D LiDAR" in result.stderr


def test_what_is_no_log_is_refused_in_words(tmp_path: Path) -> None:
    letter = tmp_path / "letter.mcap"
    letter.write_text("Dear robot")
    result = CliRunner().invoke(app, ["map", str(letter), "--out", str(tmp_path / "out")])
    assert result.exit_code == 2
    assert "Choose a log downloaded from a run" in result.stderr

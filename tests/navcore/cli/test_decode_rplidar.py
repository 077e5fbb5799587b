"""`rowpilot decode rplidar FILE [--json]`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.drivers.rplidar.protocol import Answer, Command, request
from navcore.sim.rplidar_device import RplidarDevice
from tests.navcore.drivers.rplidar_scenes import room

runner = CliRunner()


@pytest.fixture
def log(tmp_path: Path) -> Path:
    device, path = RplidarDevice(room, Answer.EXPRESS), tmp_path / "port.bin"
    asked = b"".join(
        device.receive(request(command)) for command in (Command.GET_INFO, Command.GET_HEALTH, Command.SCAN)
    )
    path.write_bytes(b"\x00\x01" + asked + device.run(0.5))
    return path


def test_each_turn_is_a_row_with_its_rays(log: Path) -> None:
    result = runner.invoke(app, ["decode", "rplidar", str(log)])
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[1].split()[:2] == ["1", "800"]
    assert float(lines[1].split()[3]) == pytest.approx(2.0, abs=0.01)  # m
    assert any(line.startswith("LiDAR health: good") for line in lines)
    assert any("2: no answer of an RPLIDAR begins here" in line for line in lines)


def test_json_holds_every_ray(log: Path) -> None:
    found = json.loads(runner.invoke(app, ["decode", "rplidar", str(log), "--json"]).stdout)
    assert found["format"] == "express"
    assert len(found["turns"]) >= 3
    assert len(found["turns"][0]["angle_rad"]) == len(found["turns"][0]["distance_m"]) == 800
    assert found["info"]["firmware"] == [1, 2]


@pytest.mark.parametrize("content", [b"", b"$GNGGA,1,2,3\r\n" * 20])
def test_a_file_without_answers_is_refused_with_a_sentence(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "other.bin"
    path.write_bytes(content)
    result = runner.invoke(app, ["decode", "rplidar", str(path)])
    assert result.exit_code == 2
    assert "record its port from before the scan is started" in result.stderr


def test_a_file_that_is_not_there_is_refused_with_a_sentence(tmp_path: Path) -> None:
    result = runner.invoke(app, ["decode", "rplidar", str(tmp_path / "none.bin")])
    assert result.exit_code == 2
    assert "cannot be read" in result.stderr

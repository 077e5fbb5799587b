"""`rowpilot decode lidar3d FILE [--model NAME] [--sender ADDRESS] [--output FOLDER] [--json]`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.drivers.lidar3d.models import C16, ModelName
from navcore.maps.cloud_files.cloud_file import read_cloud
from tests.navcore.drivers.lidar3d_captures import write_capture
from tests.navcore.drivers.lidar3d_scenes import arrivals, datagrams, off_walls

runner = CliRunner()


@pytest.fixture
def capture(tmp_path: Path) -> Path:
    return write_capture(tmp_path / "c16.pcap", arrivals(C16, datagrams(ModelName.C16)))


def test_each_turn_is_a_row_and_the_lidar_tells_of_itself(capture: Path) -> None:
    result = runner.invoke(app, ["decode", "lidar3d", str(capture)])
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert [line.split()[0] for line in lines[1:5]] == ["1", "2", "3", "4"]
    assert lines[1].endswith("incomplete")
    number, _day, _time, took, points, nearest, furthest, lost = lines[2].split()
    assert (number, points, lost) == ("2", "32000", "0")
    assert float(took) == pytest.approx(100.0, abs=0.1)  # ms
    assert float(nearest) == pytest.approx(2.0, abs=0.01)  # m: the wall to the left
    assert float(furthest) == pytest.approx(5.9, abs=0.2)  # m: a corner
    assert "2 whole turns and 2 incomplete ones of a Leishen C16 (2 deg) at 192.168.1.200" in result.stdout
    assert "set to 600 rpm, its clock at 2026-05-01 10:00:00" in result.stdout


def test_json_holds_the_same_figures(capture: Path) -> None:
    result = runner.invoke(app, ["decode", "lidar3d", str(capture), "--json"])
    found = json.loads(result.stdout)
    assert found["model"] == "c16"
    assert [turn["whole"] for turn in found["turns"]] == [False, True, True, False]
    assert found["turns"][1]["points"] == 32_000
    assert found["device"]["rpm"] == 600
    assert (found["lost"], found["refused"], found["broken"], found["contradiction"]) == (0, {}, False, "")


def test_points_are_written_turn_by_turn(capture: Path, tmp_path: Path) -> None:
    folder = tmp_path / "points"
    result = runner.invoke(app, ["decode", "lidar3d", str(capture), "--output", str(folder)])
    assert result.exit_code == 0
    files = sorted(path.name for path in folder.iterdir())
    assert files == [f"turn-00000{n}.pcd" for n in (1, 2, 3, 4)]
    cloud = read_cloud(folder / "turn-000002.pcd").cloud
    assert len(cloud) == 32_000
    assert off_walls(cloud).max() < 0.002  # m
    assert cloud.times.min() == pytest.approx(-0.1, abs=1e-4)  # s
    assert set(np.unique(cloud.rings)) == set(range(16))


def test_a_folder_with_files_in_it_is_not_written_over(capture: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    result = runner.invoke(app, ["decode", "lidar3d", str(capture), "--output", str(tmp_path)])
    assert result.exit_code == 2
    assert "holds files already; name a new folder" in result.stderr
    result = runner.invoke(app, ["decode", "lidar3d", str(capture), "--output", str(tmp_path / "notes.txt")])
    assert result.exit_code == 2
    assert "cannot be written to" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--model", "c17"], "model must be vlp16, c16, c16-fine, but is 'c17'"),
        (["--model", "vlp16"], "but the LiDAR is set to be a Velodyne VLP-16"),
        (["--model", "c16-fine"], "but it is set to be a Leishen C16 (1.33 deg)"),
        (["--sender", "10.1.2.3"], "holds no LiDAR at 10.1.2.3"),
    ],
)
def test_what_contradicts_the_packets_is_refused_with_one_sentence(
    capture: Path, arguments: list[str], says: str
) -> None:
    result = runner.invoke(app, ["decode", "lidar3d", str(capture), *arguments])
    assert result.exit_code == 2
    assert says in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert "Traceback" not in result.output


def test_a_missing_file_a_folder_and_what_is_no_capture_are_refused_with_a_sentence(tmp_path: Path) -> None:
    text = tmp_path / "text.pcap"
    text.write_text("no capture")
    for path in (tmp_path / "none.pcap", tmp_path, text):
        result = runner.invoke(app, ["decode", "lidar3d", str(path)])
        assert result.exit_code == 2
        assert str(path) in result.stderr


def test_the_recorded_vlp16_is_decoded(shared_data: Path) -> None:
    path = shared_data / "lidar3d" / "sample_velodyne_vlp16_gps.pcap"
    result = runner.invoke(app, ["decode", "lidar3d", str(path), "--json"])
    found = json.loads(result.stdout)
    assert (found["model"], found["packets"], found["lost"], found["others"]) == ("vlp16", 293, 0, 0)
    assert [turn["points"] for turn in found["turns"]] == [14_522, 18_549, 18_543, 18_495, 3_377]
    assert found["position"]["sentence"].startswith("$GPRMC,081802.00,A,3649.7478558,N")

"""`rowpilot scan` on real scans, and what it says of files that are none."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.cli import app

runner = CliRunner()
ROOM = "lidar2d/rplidar-c1-kitchenette"
MOMENTS = {"scans_2025-09-04-16-43-09.json": "circle1.json", "scans_2025-09-04-16-51-11.json": "circle2.json"}


def seen(*arguments: object) -> list[dict[str, Any]]:
    result = runner.invoke(app, ["scan", *map(str, arguments), "--json"])
    assert result.exit_code == 0, result.stderr
    records: list[dict[str, Any]] = json.loads(result.stdout)
    return records


@pytest.mark.parametrize("moment", MOMENTS)
def test_walls_of_a_real_room_are_lines_within_two_centimetres(shared_data: Path, moment: str) -> None:
    """Five RPLIDAR C1 stand about the room."""
    records = seen(shared_data / ROOM / moment)
    assert len(records) == 5
    for record in records:
        assert record["rays"] > 500
        assert record["walls"][0]["length_m"] > 0.75
        assert all(wall["rms_m"] < 0.02 for wall in record["walls"])
    assert sum(wall["length_m"] for record in records for wall in record["walls"]) > 30.0


@pytest.mark.parametrize("moment", MOMENTS)
def test_the_barrel_in_that_room_is_where_those_who_recorded_it_found_it(shared_data: Path, moment: str) -> None:
    """Their circles are of 0.15 to 0.29 m; the sensor beside which it stands too near to tell is left out."""
    circles = json.loads((shared_data / ROOM / MOMENTS[moment]).read_text())
    records, off = seen(shared_data / ROOM / moment, "--thickest", 0.6), []
    for record in records:
        centre = circles[record["scan"].split()[-1]]["center"]
        things = [thing for thing in record["uprights"] if thing["diameter_m"] > 0.25]
        off.append(min((math.dist((t["x_m"], t["y_m"]), centre) for t in things), default=math.inf))
    assert np.median(off) < 0.1  # m


def test_a_ring_of_a_recorded_vlp16_shows_walls_and_uprights(shared_data: Path, tmp_path: Path) -> None:
    path = shared_data / "lidar3d" / "sample_velodyne_vlp16_gps.pcap"
    records = seen(path, "--elevation", 1, "--far", 30, "--out", tmp_path)
    assert len(records) == 3
    first = {round(thing["x_m"], 1): thing["diameter_m"] for thing in records[0]["uprights"]}
    for record in records:
        assert record["walls"][0]["length_m"] > 0.7
        same = [thing for thing in record["uprights"] if round(thing["x_m"], 1) in first]
        assert len(same) >= 3  # the sensor stands still: they are there in every turn
    drawing = cv2.imread(str(tmp_path / "scan-0003.png"))
    assert drawing is not None
    assert drawing.shape == (1000, 1000, 3)


@pytest.mark.parametrize("elevation", [0.0, 1.3, 2.6])
def test_a_street_as_a_velodyne_saw_it_has_poles(shared_data: Path, elevation: float) -> None:
    for path in sorted((shared_data / "lidar3d").glob("25137*.pcd")):
        (record,) = seen(path, "--elevation", elevation, "--far", 40)
        poles = [t for t in record["uprights"] if t["rays"] >= 3 and 0.03 <= t["diameter_m"] <= 0.4]
        assert len(poles) >= 5


def test_rays_in_a_csv_are_told_in_words(tmp_path: Path) -> None:
    path = tmp_path / "trunk.csv"
    rays = [(deg / 4, 2.0 if 80 <= deg <= 90 else 5.0) for deg in range(1440)]
    path.write_text("angle_deg,distance_m\n" + "\n".join(f"{a},{d}" for a, d in rays))
    result = runner.invoke(app, ["scan", str(path)])
    assert result.exit_code == 0
    assert "trunk.csv: 1440 rays came back" in result.stdout
    assert "upright" in result.stdout


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("none.csv", None, "There is no file"),
        ("rays.csv", "0.0,1.0\n0.1,1.0\n", "angle_deg,distance_m"),
        ("room.json", "[[1, 2]]", "must hold an object"),
        ("room.json", "{", "cannot be read as JSON"),
        ("room.json", '{"front": [[1, 2, 3]]}', "front must be a list of points"),
        ("room.json", '{"front": [[1, "a"]]}', "front must be a list of points"),
        ("room.json", '{"front": []}', "front must be a list of points"),
        ("room.json", '{"front": [[NaN, 1.0]]}', "no number"),
        ("notes.txt", "hello", "is no file of points"),
        ("cloud.pcd", "hello", "cloud.pcd"),
        ("packets.pcap", "hello", "packets.pcap"),
    ],
)
def test_what_is_no_scan_is_refused_in_a_sentence(tmp_path: Path, name: str, text: str | None, said: str) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    result = runner.invoke(app, ["scan", str(path)])
    assert result.exit_code == 2
    assert said in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1


def test_a_ring_where_there_is_none_is_refused(shared_data: Path) -> None:
    path = sorted((shared_data / "lidar3d").glob("25137*.pcd"))[0]
    result = runner.invoke(app, ["scan", str(path), "--elevation", "55"])
    assert result.exit_code == 2
    assert "name another --elevation" in result.stderr


def test_a_drawing_that_cannot_be_put_anywhere_is_told(tmp_path: Path) -> None:
    scan, taken = tmp_path / "room.json", tmp_path / "taken"
    scan.write_text(json.dumps({"front": [[math.cos(a), math.sin(a)] for a in np.arange(0.0, 6.0, 0.01)]}))
    taken.write_text("a file")
    result = runner.invoke(app, ["scan", str(scan), "--out", str(taken)])
    assert result.exit_code == 2
    assert "cannot be put into" in result.stderr

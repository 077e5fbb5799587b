"""`rowpilot see PICTURE...`: any picture or video, without a station."""

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
from navcore.geometry.pinhole import robot_camera
from navcore.messages import SimTruth
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer
from navcore.sim.layouts import tuning_layout
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard

runner = CliRunner()
OFFSET_M = 0.2


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """row.png: in a row, the robot 0.2 m left of its middle; sky.png: nothing but grey; black.png."""
    path = tmp_path_factory.mktemp("pictures")
    site = tuning_layout(3)
    orchard = build_orchard(site, OrchardParams(seed=3, season=Season.BUDDING, trellis=Trellis.VSP))
    row = site.rows[1]
    (x0, y0), (x1, y1) = row.start, row.end
    yaw = math.atan2(y1 - y0, x1 - x0)
    x = x0 + 12.0 * math.cos(yaw) - OFFSET_M * math.sin(yaw)
    y = y0 + 12.0 * math.sin(yaw) + OFFSET_M * math.cos(yaw)
    truth = SimTruth(stamp_ns=0, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
    light = named_light(LightName.OVERCAST, along=yaw, seed=1)
    cv2.imwrite(str(path / "row.png"), CameraRenderer(orchard, robot_camera(), light).render(truth, 0).image)
    noise = np.random.default_rng(1).normal(120, 12, (360, 640, 3))
    cv2.imwrite(str(path / "sky.png"), np.clip(noise, 0, 255).astype(np.uint8))
    cv2.imwrite(str(path / "black.png"), np.zeros((360, 640, 3), np.uint8))
    return path


@pytest.fixture(scope="module")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("settings") / "robot.toml"
    c = robot_camera()
    path.write_text(
        f"[front_camera]\nmount = {{ width_px = 640, height_px = 360, fx = {c.fx}, fy = {c.fy}, cx = 320.0, "
        f"cy = 180.0, x = {c.x}, y = 0.0, z = {c.z}, pitch = {c.pitch} }}\n"
    )
    return path


def seen(*arguments: object) -> list[dict[str, Any]]:
    result = runner.invoke(app, ["see", "--json", *map(str, arguments)])
    assert result.exit_code == 0, result.stderr
    records: list[dict[str, Any]] = json.loads(result.stdout)
    return records


def pixels(path: Path) -> np.ndarray:
    image = cv2.imread(str(path))
    assert image is not None
    return np.asarray(image)


def direction(line: list[list[float]]) -> float:
    """Of an image line, deg in [0, 180)."""
    (u0, v0), (u1, v1) = line
    return math.degrees(math.atan2(v1 - v0, u1 - u0)) % 180.0


def test_with_the_camera_told_the_row_is_known_in_metres(folder: Path, settings: Path) -> None:
    [record] = seen(folder / "row.png", "--camera", settings)
    assert record["row"]["offset_m"] == pytest.approx(-OFFSET_M, abs=0.1)  # m; the middle lies on the right
    assert record["camera"]["told"] is True
    assert {"class", "box", "confidence"} == set(record["objects"][0])


def test_without_a_camera_the_same_lines_are_found_and_nothing_is_told_in_m(folder: Path, settings: Path) -> None:
    [told], [guessed] = seen(folder / "row.png", "--camera", settings), seen(folder / "row.png")
    for side in ("left", "right"):
        assert direction(guessed["row"][side]) == pytest.approx(direction(told["row"][side]), abs=5.0)  # deg
    assert guessed["row"]["vanishing_point"] == pytest.approx(told["row"]["vanishing_point"], abs=30.0)  # px
    assert "offset_m" not in guessed["row"]
    assert guessed["camera"]["told"] is False


@pytest.mark.parametrize(("name", "word"), [("sky.png", "no trunk or post"), ("black.png", "black")])
def test_a_picture_without_a_row_says_why(folder: Path, name: str, word: str) -> None:
    [record] = seen(folder / name)
    assert record["row"] is None
    assert word in record["reason"]


def test_a_folder_is_all_its_pictures_and_each_is_drawn(folder: Path, tmp_path: Path) -> None:
    result = runner.invoke(app, ["see", str(folder), "--out", str(tmp_path)])
    assert result.exit_code == 0, result.stderr
    assert "row.png: row, quality" in result.stdout
    assert "sky.png: no row" in result.stdout
    assert sorted(p.name for p in tmp_path.iterdir()) == ["black.jpg", "row.jpg", "sky.jpg"]
    change = pixels(folder / "row.png").astype(int) - pixels(tmp_path / "row.jpg")
    assert np.abs(change).max() > 150


def test_pictures_of_the_same_name_do_not_overwrite_each_other(folder: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    (other / "sky.png").write_bytes((folder / "sky.png").read_bytes())
    out = tmp_path / "out"
    runner.invoke(app, ["see", str(folder / "sky.png"), str(other / "sky.png"), "--out", str(out)])
    assert sorted(p.name for p in out.iterdir()) == ["sky-2.jpg", "sky.jpg"]


def test_a_video_is_looked_at_frame_by_frame_and_drawn_as_a_video(folder: Path, tmp_path: Path) -> None:
    picture = pixels(folder / "row.png")
    writer = cv2.VideoWriter(str(tmp_path / "drive.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 5.0, (640, 360))
    for _ in range(3):
        writer.write(picture)
    writer.release()
    records = seen(tmp_path / "drive.avi", "--out", tmp_path / "out")
    assert [r["frame"] for r in records] == [0, 1, 2]
    assert all(r["row"] for r in records)
    drawing = cv2.VideoCapture(str(tmp_path / "out" / "drive.mp4"))
    assert drawing.get(cv2.CAP_PROP_FRAME_COUNT) == 3


def test_what_cannot_be_read_is_said_and_the_rest_is_seen(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "torn.png").write_bytes((folder / "row.png").read_bytes()[:300])
    (tmp_path / "notes.txt").write_text("no picture")
    wrong = [tmp_path / "torn.png", tmp_path / "notes.txt", tmp_path / "none.png"]
    result = runner.invoke(app, ["see", "--json", *map(str, wrong), str(folder / "row.png")])
    assert result.exit_code == 2
    assert len(json.loads(result.stdout)) == 1
    for name, word in zip(wrong, ("damaged", "neither a picture nor a video", "There is no"), strict=True):
        assert any(name.name in line and word in line for line in result.stderr.splitlines()), result.stderr


def test_a_picture_of_another_size_than_the_settings_is_refused(folder: Path, settings: Path, tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "small.png"), np.full((100, 100, 3), 90, np.uint8))
    result = runner.invoke(app, ["see", str(tmp_path / "small.png"), "--camera", str(settings), "--json"])
    assert result.exit_code == 2
    assert "small.png is 100x100, the settings are for 640x360" in result.stderr


def test_settings_that_are_none_are_refused(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "robot.toml").write_text("[front_camera\n")
    result = runner.invoke(app, ["see", str(folder / "row.png"), "--camera", str(tmp_path / "robot.toml")])
    assert result.exit_code == 2
    assert "Cannot read the settings" in result.stderr


def test_ground_lines_of_real_vineyards_are_seen_and_none_where_there_is_no_row(shared_data: Path) -> None:
    frames = shared_data / "frames"
    labels = {frames / label["file"]: label for label in json.loads((frames / "labels.json").read_text())}
    records = dict(zip(labels, seen(*labels), strict=True))
    in_row = [path for path, label in labels.items() if label["in_row"] is True]
    good = [path for path in in_row if _lines_agree(records[path]["row"], labels[path])]
    assert len(good) >= 6, good
    assert not [path for path, label in labels.items() if label["in_row"] is False and records[path]["row"]]


def _lines_agree(row: dict[str, Any] | None, label: dict[str, Any]) -> bool:
    """Both within 5 deg."""
    off = (abs(direction(row[k]) - direction(label[k])) if row else 90.0 for k in ("left", "right"))
    return all(min(d, 180.0 - d) <= 5.0 for d in off)

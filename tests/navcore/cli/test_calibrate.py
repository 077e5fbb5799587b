"""`rowpilot calibrate`: from folders of pictures and scans to a version that is kept."""

from __future__ import annotations

import json
import math
import shutil
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.calibration.board import Board
from navcore.calibration.calibration_file import load_version, transform
from navcore.calibration.extrinsics import rough_mount
from navcore.cli import app
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from navcore.sim.board_poses import BoardPoseParams, BoardPoses
from navcore.sim.board_scans import BoardScanParams, BoardScans
from tests.navcore.calibration.boards import CAMERA, LENS

runner = CliRunner()
BOARD = Board()
MOUNT = rough_mount(0.075, 0.029, -0.096, math.radians(2.0))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """lens/: 14 pictures. both/: 14 with their scans. Rendered by seed 5."""
    path = tmp_path_factory.mktemp("boards")
    rng = np.random.default_rng(5)
    camera = BoardPictures(CAMERA, LENS, BOARD, BoardPictureParams())
    near = BoardPoses(CAMERA, LENS, BOARD, BoardPoseParams(nearest=0.2, furthest=0.5, turn_deg=90.0, spread=1.0))
    held = BoardPoses(CAMERA, LENS, BOARD, BoardPoseParams(nearest=0.45, furthest=0.9, tilt_deg=40.0, turn_deg=60.0))
    lidar = BoardScans(BOARD, BoardScanParams(turns=3))
    (path / "lens").mkdir()
    (path / "both").mkdir()
    for k in range(14):
        cv2.imwrite(str(path / "lens" / f"a{k:02}.png"), camera.render(near.draw(rng), rng))
        T = held.draw_before_lidar(rng, np.asarray(np.linalg.inv(MOUNT), np.float64), 0.04)
        cv2.imwrite(str(path / "both" / f"b{k:02}.png"), camera.render(T, rng))
        angles, distances = lidar.scan(MOUNT @ T, rng)
        rows = (f"{math.degrees(a):.4f},{d:.4f}" for a, d in zip(angles, distances, strict=True))
        (path / "both" / f"b{k:02}.csv").write_text("angle_deg,distance_m\n" + "\n".join(rows) + "\n")
    return path


@pytest.fixture(scope="module")
def camera_file(folder: Path) -> Path:
    kept = folder / "camera.json"
    called("camera", folder / "lens", "--out", kept, "--by", "Ana", "--robot", "north")
    return kept


def called(*arguments: object, code: int = 0) -> str:
    """What it printed, or what it complained."""
    result = runner.invoke(app, ["calibrate", *map(str, arguments)])
    assert result.exit_code == code, (result.stdout, result.stderr, result.exception)
    return result.stdout if code == 0 else result.stderr


def test_the_camera_comes_back_with_its_errors_and_is_kept(camera_file: Path) -> None:
    version = load_version(camera_file, robot="north", size=CAMERA.size)
    assert version.intrinsics.fx == pytest.approx(CAMERA.fx, rel=0.005)
    assert (version.made_by, version.pictures) == ("Ana", 14)
    assert version.left_out_px < 0.2  # px


def test_json_has_every_picture_and_the_plot_is_drawn(folder: Path, tmp_path: Path) -> None:
    plot = tmp_path / "plot.png"
    record: dict[str, Any] = json.loads(called("camera", folder / "lens", "--json", "--plot", plot))
    assert len(record["pictures"]) == 14
    assert {v["name"]: v["unit"] for v in record["values"]}["fx"] == "px"
    assert any("Take 20 pictures" in wish for wish in record["missing"])
    drawn = cv2.imread(str(plot))
    assert drawn is not None
    assert drawn.std() > 5.0


def test_the_mount_comes_back_and_is_kept_on_the_robot(folder: Path, camera_file: Path, tmp_path: Path) -> None:
    told = called(
        "lidar", folder / "both", "--camera", camera_file, "--lidar-at", "0,0,0.25,0", "--out", tmp_path,
        "--plot", tmp_path / "boards.png",
    )  # fmt: skip
    assert "yaw" in told
    [kept] = tmp_path.glob("*.json")
    version = load_version(kept, robot="north")
    assert version.T_lidar_camera is not None
    assert version.T_base_camera is not None
    assert transform(version.T_lidar_camera)[:3, 3] == pytest.approx(MOUNT[:3, 3], abs=0.01)  # m
    assert version.T_base_camera[11] == pytest.approx(version.T_lidar_camera[11] + 0.25)
    assert cv2.imread(str(tmp_path / "boards.png")) is not None


def test_a_version_is_not_overwritten(folder: Path, camera_file: Path) -> None:
    assert "is there already" in called("camera", folder / "lens", "--out", camera_file, code=2)


def test_another_robots_camera_is_refused(folder: Path, camera_file: Path) -> None:
    told = called("lidar", folder / "both", "--camera", camera_file, "--robot", "south", code=2)
    assert "of robot north, not of south" in told


def test_a_half_empty_folder_says_what_each_lacks(folder: Path, camera_file: Path, tmp_path: Path) -> None:
    half = tmp_path / "half"
    shutil.copytree(folder / "both", half)
    (half / "b00.csv").unlink()
    (half / "b01.png").unlink()
    (half / "b02.png").write_bytes(b"no picture")
    (half / "b03.csv").write_text("angle_deg,distance_m\n0,nan\n")
    (half / "b04.csv").write_text("1,2\n")
    told = called("lidar", half, "--camera", camera_file)
    for words in ("b00.png: There is no b00.csv", "b01.csv: It has no picture", "b02.png: The file is damaged",
                  "b03.png: A ray of the scan is NaN", "b04.png: b04.csv does not begin"):  # fmt: skip
        assert words in told
    for path in half.glob("b[01]*.csv"):
        path.unlink()
    assert "6 are needed" in called("lidar", half, "--camera", camera_file, code=2)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--board", "7x6"), "of 8 x 5 inner corners is seen, not of 7 x 6"),
        (("--board", "many"), "as 8x5, not many"),
        (("--square-mm", "0"), "2 mm to 1 m"),
        (("--charuco",), "No marker"),
        (("--plot", "/nowhere/plot.png"), "cannot be written"),
    ],
)
def test_what_does_not_fit_is_refused_in_words(folder: Path, arguments: tuple[str, ...], words: str) -> None:
    assert words in called("camera", folder / "lens", *arguments, code=2)


def test_an_empty_folder_and_none_are_refused(tmp_path: Path) -> None:
    assert "no picture" in called("camera", tmp_path, code=2)
    assert "There is no folder" in called("camera", tmp_path / "none", code=2)


@pytest.mark.parametrize("place", ["1,2,3", "a,b,c,d", "nan,0,0,0"])
def test_a_place_that_is_none_is_refused(folder: Path, camera_file: Path, place: str) -> None:
    told = called("lidar", folder / "both", "--camera", camera_file, "--camera-at", place, code=2)
    assert "--camera-at must be" in told

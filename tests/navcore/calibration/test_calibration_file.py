"""Calibrations are kept as versions, and what is not this robot's is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from navcore.calibration.calibration_file import (
    CalibrationVersion,
    camera_on_robot,
    load_version,
    new_id,
    numbers_of,
    save_version,
    versions,
)
from navcore.errors import CalibrationError, InputError
from navcore.geometry.pinhole import R_BASE_OPTICAL, rotation_from_rpy, rpy_from_rotation
from tests.navcore.calibration.boards import CAMERA, LENS

MOUNT = np.eye(4)
MOUNT[:3, :3] = rotation_from_rpy(0.01, 0.1, -0.05) @ R_BASE_OPTICAL
MOUNT[:3, 3] = 0.5, 0.02, 0.8
VERSION = CalibrationVersion(
    id="20260301T101500Z", made_utc="2026-03-01T10:15:00Z", made_by="Ana", robot="north", camera="D455 7", rms_px=0.1,
    intrinsics=CAMERA, lens=LENS, camera_std={"fx": 0.3}, left_out_px=0.11, pictures=20,
    T_lidar_camera=numbers_of(MOUNT), T_base_camera=numbers_of(MOUNT), mount_std=(0.001,) * 6, lidar_poses=25,
)  # fmt: skip


def written(tmp_path: Path, **changes: Any) -> Path:
    """A file whose JSON was changed by hand."""
    save_version(VERSION, path := tmp_path / "v.json")
    tree = json.loads(path.read_text()) | changes
    path.write_text(json.dumps(tree))
    return path


def test_a_version_comes_back_as_it_was_kept(tmp_path: Path) -> None:
    save_version(VERSION, path := tmp_path / "robots" / "v.json")
    assert load_version(path, robot="north", size=(640, 360)) == VERSION


def test_a_version_is_never_overwritten(tmp_path: Path) -> None:
    save_version(VERSION, path := tmp_path / "v.json")
    before = path.read_bytes()
    with pytest.raises(CalibrationError, match="is there already"):
        save_version(replace(VERSION, made_by="Ben"), path)
    assert path.read_bytes() == before


def test_versions_of_one_second_have_names_of_their_own_and_the_newest_is_first(tmp_path: Path) -> None:
    for moment in ("2026-03-01T10:15:00Z", "2026-03-01T10:15:00Z", "2026-02-01T10:15:00.123+00:00"):
        name = new_id(moment, tmp_path)
        save_version(replace(VERSION, id=name), tmp_path / f"{name}.json")
    assert [p.stem for p in versions(tmp_path)] == ["20260301T101500Z-2", "20260301T101500Z", "20260201T101500"]


def test_the_camera_on_the_robot_is_where_the_version_says() -> None:
    camera = camera_on_robot(VERSION)
    assert (camera.x, camera.y, camera.z) == pytest.approx((0.5, 0.02, 0.8))
    assert camera.R_base_camera() == pytest.approx(MOUNT[:3, :3], abs=1e-12)
    with pytest.raises(CalibrationError, match="does not tell where the camera sits"):
        camera_on_robot(replace(VERSION, T_base_camera=None))


def test_roll_pitch_and_yaw_come_back() -> None:
    assert rpy_from_rotation(rotation_from_rpy(0.2, -0.7, 3.0)) == pytest.approx((0.2, -0.7, 3.0))


def test_another_robots_calibration_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CalibrationError, match="this calibration is of robot north, not of south"):
        load_version(written(tmp_path), robot="south")


def test_another_picture_size_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CalibrationError, match="is for 640x360 pictures, the camera gives 1280x720"):
        load_version(written(tmp_path), size=(1280, 720))


@pytest.mark.parametrize(
    "change",
    [
        {"rms_px": -1.0}, {"rms_px": None}, {"mount_std": [-1.0]}, {"T_lidar_camera": [0.0] * 16},
        {"T_base_camera": [1.0] * 3}, {"id": "../../etc"}, {"intrinsics": {"fx": 0.0}}, {"pictures": "many"},
        {"lens": {"k1": None}}, {"camera_std": {"fx": None}},
    ],
)  # fmt: skip
def test_a_file_changed_into_nonsense_is_refused(tmp_path: Path, change: dict[str, Any]) -> None:
    with pytest.raises(CalibrationError, match=r"v\.json"):
        load_version(written(tmp_path, **change))


@pytest.mark.parametrize("text", ["", "{", "NaN", '{"id": NaN}', "[]", "\xff"])
def test_what_is_no_calibration_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "v.json"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(CalibrationError, match="no calibration, or a damaged one"):
        load_version(path)


def test_a_file_that_is_not_there_or_too_large_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CalibrationError, match="cannot be read"):
        load_version(tmp_path / "none.json")
    (tmp_path / "large.json").write_bytes(b" " * 1_000_001)
    with pytest.raises(CalibrationError, match="too large"):
        load_version(tmp_path / "large.json")


def test_nan_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        save_version(replace(VERSION, rms_px=float("nan")), tmp_path / "v.json")
    assert list(tmp_path.iterdir()) == []

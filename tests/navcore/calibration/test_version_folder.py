"""Versions are kept side by side, and a pointer tells which is in use."""

from __future__ import annotations

from pathlib import Path

import pytest

from navcore.calibration.version_folder import POINTER, VersionFolder
from navcore.errors import CalibrationError
from navcore.messages import CameraName
from tests.navcore.calibration.test_calibration_file import VERSION

FRONT, REAR = CameraName.FRONT, CameraName.REAR


def test_a_new_version_is_not_in_use_until_it_is_chosen(tmp_path: Path) -> None:
    folder = VersionFolder(tmp_path, "north")
    version = folder.add(FRONT, VERSION)
    assert folder.load_in_use(FRONT) is None
    folder.use(FRONT, version.id)
    assert folder.load_in_use(FRONT) == version
    assert folder.load_in_use(REAR) is None
    folder.use(FRONT, None)
    assert folder.load_in_use(FRONT) is None


def test_choosing_an_older_one_leaves_every_version_as_it_was(tmp_path: Path) -> None:
    folder = VersionFolder(tmp_path, "north")
    first, second = folder.add(FRONT, VERSION), folder.add(FRONT, VERSION)
    assert first.id != second.id
    before = {path: path.read_bytes() for path in tmp_path.rglob("*.json")}
    folder.use(FRONT, second.id)
    folder.use(FRONT, first.id)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*.json")} == before
    assert [stored.id for stored in folder.stored(FRONT)] == [second.id, first.id]


def test_what_cannot_be_used_is_not_chosen_and_the_old_one_stays(tmp_path: Path) -> None:
    folder = VersionFolder(tmp_path, "north")
    good = folder.add(FRONT, VERSION)
    folder.use(FRONT, good.id)
    (tmp_path / "front" / "bad.json").write_text("{}")
    for version_id in ("bad", "missing", "../../etc/passwd", ""):
        with pytest.raises(CalibrationError):
            folder.use(FRONT, version_id)
    assert folder.in_use(FRONT) == good.id
    assert [bool(stored.problem) for stored in folder.stored(FRONT)] == [True, False]


def test_a_pointer_to_nothing_is_refused_and_not_guessed_at(tmp_path: Path) -> None:
    folder = VersionFolder(tmp_path, "north")
    folder.add(FRONT, VERSION)
    (tmp_path / "front" / POINTER).write_text("gone\n")
    with pytest.raises(CalibrationError, match="There is no calibration 'gone'"):
        folder.load_in_use(FRONT)
    (tmp_path / "front" / POINTER).write_bytes(b"\xff\xfe")
    with pytest.raises(CalibrationError, match="Choose one again"):
        folder.load_in_use(FRONT)

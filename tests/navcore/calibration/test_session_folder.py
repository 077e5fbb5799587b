"""A session's folder: one session at a time, and what is damaged says so."""

from __future__ import annotations

from pathlib import Path

import pytest

from navcore.calibration.session.session_folder import SessionFolder
from navcore.errors import CalibrationError
from tests.navcore.calibration.rehearsed import (
    SETUP,
)


def test_only_one_session_is_begun_in_a_folder(tmp_path: Path) -> None:
    folder = SessionFolder(tmp_path / "s")
    folder.begin(SETUP)
    with pytest.raises(CalibrationError, match="under way"):
        folder.begin(SETUP)
    assert folder.setup() == SETUP
    folder.throw_away()
    assert folder.setup() is None


def test_a_damaged_session_says_so(tmp_path: Path) -> None:
    (tmp_path / "setup.json").write_text('{"id": 7}')
    with pytest.raises(CalibrationError, match="Throw it away"):
        SessionFolder(tmp_path).setup()

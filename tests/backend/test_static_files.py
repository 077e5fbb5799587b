"""The built front end: what a browser may keep, and what it must ask for again."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.headers import add
from backend.static_files import answer


@pytest.mark.parametrize(
    ("path", "kept"),
    [
        ("assets/index-B6s2vX3k.js", "public, max-age=31536000, immutable"),
        ("favicon.svg", "no-cache"),
        ("drive", "no-cache"),
    ],
)
def test_only_files_with_a_digest_in_their_name_are_kept(tmp_path: Path, path: str, kept: str) -> None:
    (tmp_path / "assets").mkdir()
    for name in ("assets/index-B6s2vX3k.js", "favicon.svg", "index.html"):
        (tmp_path / name).write_text("built")
    response = answer(path, tmp_path)
    add(response.headers, f"/{path}")
    assert response.headers["cache-control"] == kept

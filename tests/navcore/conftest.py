"""A station's sockets in a short temporary directory (socket paths end at 107 bytes)."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from navcore.transport.endpoints import Endpoints


@pytest.fixture
def endpoints() -> Iterator[Endpoints]:
    with tempfile.TemporaryDirectory(prefix="rp") as directory:
        endpoints = Endpoints(Path(directory) / "run")
        endpoints.prepare()
        yield endpoints

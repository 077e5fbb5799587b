"""Fixtures that every test may use."""

from __future__ import annotations

from pathlib import Path

import pytest

SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


# Rooms whose files take longest: begun first, so that no process is left alone with one of them at the end.
LONG_ROOMS = frozenset({"missions", "training", "bench", "backend"})


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The long rooms first, else in the order in which they were found."""
    here = Path(__file__).parent
    items.sort(key=lambda item: LONG_ROOMS.isdisjoint(item.path.relative_to(here).parts))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real recordings made by others; tests that need it are skipped where it is missing."""
    if not SHARED_DATA.is_dir():
        pytest.skip(f"no real recordings at {SHARED_DATA}")
    return SHARED_DATA

"""The house holds: nobody imports upward, the guard stands alone, time is always an argument."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest
from importlinter.cli import EXIT_STATUS_SUCCESS, lint_imports

ROOT = Path(__file__).resolve().parents[2]
ALGORITHM_ROOMS = ("geometry", "maps", "perception", "localization", "planning", "control", "mission", "sim")
CLOCKS = {"time", "time_ns", "monotonic", "monotonic_ns", "perf_counter", "perf_counter_ns"}


def test_floors_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert lint_imports(config_filename="pyproject.toml", no_cache=True) == EXIT_STATUS_SUCCESS


def clock_calls(source: str) -> list[int]:
    """Line numbers at which a clock of the `time` module is read."""
    return [
        node.lineno
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "time"
        and node.attr in CLOCKS
    ]


def test_algorithms_never_read_a_clock() -> None:
    files = [f for room in ALGORITHM_ROOMS for f in (ROOT / "navcore" / room).glob("*.py")]
    files.append(ROOT / "navcore" / "navigator.py")
    assert {str(f): clock_calls(f.read_text()) for f in files if clock_calls(f.read_text())} == {}


def test_a_clock_would_be_found() -> None:
    assert clock_calls("import time\nnow = time.monotonic_ns()") == [2]


def test_algorithm_rooms_exist() -> None:
    assert all((ROOT / "navcore" / room).is_dir() for room in ALGORITHM_ROOMS)

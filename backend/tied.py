"""Processes of the station that end with it, however it ends: an orphan would keep a core from a driving robot."""

from __future__ import annotations

import sys

TIED = "navcore.runtime.tied"


def tied(module: str, *arguments: str) -> list[str]:
    """Command line of a Python module that ends with the thread that starts it, which has to live as long."""
    return [sys.executable, "-m", TIED, module, *arguments]

"""Processes of the station that end with it, however it ends: an orphan would keep a core from a driving robot."""

from __future__ import annotations

import os
import sys

TIED = "navcore.runtime.tied"


def tied(module: str, *arguments: str) -> list[str]:
    """Command line, for this process to start, of a Python module that ends with the thread that starts it, which has
    to live as long.
    """
    return [sys.executable, "-m", TIED, str(os.getpid()), module, *arguments]

"""Exports of run logs, made once and kept beside the log."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from threading import Lock

from backend.errors import StationError
from backend.exit_status import UNREADABLE
from backend.schemas import LogFormat
from navcore.errors import LogError

LONGEST_S = 300


class ExportStore:
    """One export at a time: each keeps a processor core busy."""

    def __init__(self) -> None:
        self._one_export = Lock()

    def download(self, log: Path, form: LogFormat) -> Path:
        """The log itself or an export of it. Raises LogError."""
        return log if form is LogFormat.MCAP else self._exported(log, form.value)

    def track(self, log: Path) -> Path:
        """File with the JSON of `RunTrack`. Raises LogError."""
        return self._exported(log, "track")

    def trunks(self, log: Path) -> Path:
        """File with the JSON of the `TrunkMap` that the run saw. Raises LogError."""
        return self._exported(log, "trunks")

    def _exported(self, log: Path, form: str) -> Path:
        target = log.with_suffix(f".{form}")
        with self._one_export:
            if not is_fresh(target, log):
                make(log, form, target)
        return target


def is_fresh(export: Path, log: Path) -> bool:
    """Whether the log has not grown since."""
    return export.is_file() and export.stat().st_mtime_ns > log.stat().st_mtime_ns


def make(log: Path, form: str, target: Path) -> None:
    """Run the export process to its end."""
    command = [sys.executable, "-m", "backend.run_export", str(log), form, str(target)]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=LONGEST_S, check=False)
    except subprocess.TimeoutExpired as error:
        raise LogError("This log is too long to be exported here. Download it as MCAP.") from error
    if done.returncode == UNREADABLE:
        raise LogError(done.stdout.decode())
    if done.returncode != 0:
        raise StationError(f"export of {log.name} ended with {done.returncode}: {done.stderr.decode()[-2000:]}")

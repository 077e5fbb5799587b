"""A calibration under way on disk, so that nothing is lost when the process that works on it ends.

`setup.json` tells what was asked for. Each pose has `<name>.json`, and `<name>.jpg` to be looked at.
"""

from __future__ import annotations

import math
import shutil
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_run import PlainScan
from navcore.calibration.session.state import SessionSetup, Taken
from navcore.disk import write_durably
from navcore.errors import CalibrationError

SETUP = "setup.json"


@dataclass(frozen=True, slots=True, kw_only=True)
class _StoredPose:
    """`Taken` as JSON. edge_px: None where not measured. step: of the scan, None without one."""

    width_px: int
    height_px: int
    ids: list[int]
    pixels: list[tuple[float, float]]
    edge_px: float | None
    kept: bool
    angles: list[float]
    distances: list[float]
    step: float | None


class SessionFolder:
    """One calibration. For one writer."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def begin(self, setup: SessionSetup) -> None:
        """Write down what is asked for. Raises CalibrationError if another one is under way."""
        if self.setup() is not None:
            raise CalibrationError(("A calibration is under way. Accept it or throw it away first.",))
        self._folder.mkdir(parents=True, exist_ok=True)
        self._write(SETUP, msgspec.json.encode(setup))

    def setup(self) -> SessionSetup | None:
        """What was asked for; None if nothing is under way. Raises CalibrationError for a damaged file."""
        path = self._folder / SETUP
        try:
            return msgspec.json.decode(path.read_bytes(), type=SessionSetup)
        except FileNotFoundError:
            return None
        except (OSError, msgspec.MsgspecError, ValueError) as error:
            raise CalibrationError((f"The calibration under way is damaged ({error}). Throw it away.",)) from error

    def save(self, taken: Taken, jpeg: bytes | None = None) -> None:
        """A new pose with its picture, or one that has changed."""
        if jpeg is not None:
            self._write(f"{taken.name}.jpg", jpeg)
        self._write(f"{taken.name}.json", msgspec.json.encode(_stored(taken)))

    def taken(self, board: Board) -> tuple[list[Taken], list[str]]:
        """All poses in the order in which they were taken, and the names of files that cannot be read."""
        poses, lost = list[Taken](), list[str]()
        for path in sorted(self._folder.glob("*.json")):
            if path.name == SETUP:
                continue
            try:
                poses.append(_taken(path.stem, msgspec.json.decode(path.read_bytes(), type=_StoredPose), board))
            except (OSError, msgspec.MsgspecError, ValueError, IndexError):
                lost.append(path.name)
        return poses, lost

    def next_name(self) -> str:
        """One that no pose has had."""
        numbers = [int(path.stem) for path in self._folder.glob("*.json") if path.stem.isdecimal()]
        return f"{max(numbers, default=0) + 1:03d}"

    def picture(self, name: str) -> Path | None:
        """The file of a pose's picture; None if there is none."""
        path = self._folder / f"{name}.jpg"
        return path if name.isdecimal() and path.is_file() else None

    def throw_away(self) -> None:
        """All of it."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _write(self, name: str, data: bytes) -> None:
        """Whole or not at all, whenever the process or the power fails."""
        try:
            write_durably(self._folder / name, data)
        except OSError as error:
            raise CalibrationError((f"{name} cannot be written: {error.strerror}. Look at the disk.",)) from error


def _stored(taken: Taken) -> _StoredPose:
    s, scan = taken.sighting, taken.scan
    return _StoredPose(
        width_px=s.width_px, height_px=s.height_px, ids=s.ids.tolist(), pixels=s.pixels.tolist(),
        edge_px=s.edge_px if math.isfinite(s.edge_px) else None, kept=taken.kept,
        angles=[] if scan is None else scan.angles.tolist(),
        distances=[] if scan is None else scan.distances.tolist(), step=None if scan is None else scan.step,
    )  # fmt: skip


def _taken(name: str, stored: _StoredPose, board: Board) -> Taken:
    """Raises ValueError, IndexError for what is no pose of that board."""
    ids, pixels = np.array(stored.ids, dtype=np.int64), np.array(stored.pixels, dtype=np.float64).reshape(-1, 2)
    if len(ids) != len(pixels) or len(ids) < 4 or len(stored.angles) != len(stored.distances):
        raise ValueError(name)
    scan = None
    if stored.step is not None:
        scan = PlainScan(angles=np.array(stored.angles), distances=np.array(stored.distances), step=stored.step)
    sighting = BoardSighting(
        name=name, width_px=stored.width_px, height_px=stored.height_px, ids=ids, points=board.corners()[ids],
        pixels=pixels, edge_px=math.nan if stored.edge_px is None else stored.edge_px,
    )  # fmt: skip
    return Taken(sighting=sighting, scan=scan, kept=stored.kept)

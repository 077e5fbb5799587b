"""3D maps drawn from above, made when somebody first looks and kept beside the map."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np

from backend.errors import ConflictError, NotFoundError, StationError
from backend.exit_status import UNREADABLE
from backend.height_colours import HIGHEST, height_colours
from backend.map3d_files import FACTS, GROUND, PICTURE, REPORT
from backend.map3d_ground import read_ground
from backend.map3d_store import NONE, NOT_ON_EARTH, Map3dStore, damaged
from backend.schemas import HeightColour, Map3dPicture
from backend.settings import Settings
from backend.tied import tied

if TYPE_CHECKING:
    from navcore.mapping.trellis.ground_model import GroundModel

LONGEST_S = 600
TOO_LONG = "it needs too much time to be drawn."
# Steps of the legend, m: browsers blend what lies between.
STEP = 0.25


class Map3dPictures:
    """One at a time: each keeps a processor core busy. Safe for many threads."""

    def __init__(self, store: Map3dStore, settings: Settings) -> None:
        self._store, self._settings = store, settings
        self._one_drawing = Lock()

    def get(self, site_id: str, run_id: str) -> Map3dPicture:
        """What the browser needs to know to lay it on the map.

        Raises NotFoundError for a map that is not there, ConflictError for one without a place on the Earth, and
        CloudError for one whose files are damaged.
        """
        made = self._store.get(site_id, run_id)
        if made is None:
            raise NotFoundError(NONE)
        if not made.georeferenced:
            raise ConflictError(NOT_ON_EARTH)
        folder = self._store.folder(site_id, run_id)
        with self._one_drawing:
            if not is_fresh(folder):
                self._draw(folder)
        return Map3dPicture.model_validate(
            {**json.loads((folder / FACTS).read_bytes()), "made": made.made, "legend": legend()}
        )

    def png(self, site_id: str, run_id: str) -> Path:
        """Its pixels. Raises as `get` does."""
        self.get(site_id, run_id)
        return self._store.folder(site_id, run_id) / PICTURE

    def ground(self, site_id: str, run_id: str) -> GroundModel:
        """The ground under it, in `map`. Raises as `get` does."""
        self.get(site_id, run_id)
        return read_ground(self._store.folder(site_id, run_id) / GROUND)

    def _draw(self, folder: Path) -> None:
        command = tied(
            "backend.map3d_drawing", f"--memory-bytes={self._settings.map_memory_bytes}",
            f"--cpu-s={self._settings.import_cpu_s}", "--", str(folder),
        )  # fmt: skip
        try:
            done = subprocess.run(
                command, stdin=subprocess.DEVNULL, capture_output=True, timeout=LONGEST_S, check=False
            )
        except subprocess.TimeoutExpired as error:
            raise damaged(TOO_LONG) from error
        if done.returncode == UNREADABLE:
            raise damaged(done.stdout.decode())
        if not folder.is_dir():  # thrown away meanwhile
            raise NotFoundError(NONE)
        if done.returncode != 0:
            told = done.stderr.decode()[-2000:]
            raise StationError(f"drawing of {folder.name} ended with {done.returncode}: {told}")


def is_fresh(folder: Path) -> bool:
    """Whether all of the drawing is there, and of the map as it is now."""
    made_ns = (folder / REPORT).stat().st_mtime_ns
    drawn = [folder / name for name in (PICTURE, GROUND, FACTS)]
    return all(file.is_file() and file.stat().st_mtime_ns >= made_ns for file in drawn)


def legend() -> list[HeightColour]:
    """From the ground up."""
    heights = np.arange(0.0, HIGHEST + STEP / 2, STEP)
    colours = height_colours(heights)
    return [
        HeightColour(height=float(h), colour=f"#{r:02x}{g:02x}{b:02x}")
        for h, (r, g, b) in zip(heights, colours.tolist(), strict=True)
    ]

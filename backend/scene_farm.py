"""Which farm the 3D view shows: the one that the robot knows."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

from backend.scene_cells import Cells, read_cells
from backend.shown_trunks import shown_file
from backend.supervisor import SupervisorClient
from navcore.errors import InputError
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import TrunkMap
from navcore.transport.codec import decode

ASK_S = 2.0


@dataclass(frozen=True, slots=True)
class ShownFarm:
    """What stands still in the view."""

    site: SiteMap
    trunks: TrunkMap
    cells: Cells | None


class FarmWatch:
    """Asks the supervisor now and then; the maps are the files that the station laid down."""

    def __init__(self, supervisor: SupervisorClient, site_dir: Path) -> None:
        self._supervisor = supervisor
        self._site_dir = site_dir
        self._asked_s = float("-inf")
        self._shown: tuple[object, ...] | None = None

    def news(self) -> ShownFarm | None:
        """The farm, once when it or its trunks are new or were loaded again; else None."""
        if time.monotonic() - self._asked_s < ASK_S:
            return None
        self._asked_s = time.monotonic()
        status = self._supervisor.status()
        if status is None or status.site_id is None:
            return None
        return self._read(status.site_id)

    def _read(self, site_id: str) -> ShownFarm | None:
        path, trunks = self._site_dir / f"{site_id}.json", shown_file(self._site_dir, site_id)
        map3d = self._site_dir / f"{site_id}.ndt"
        try:
            found = (site_id, path.stat().st_mtime_ns, _changed_ns(trunks), _changed_ns(map3d))
            if found == self._shown:
                return None
            site = decode(SiteMap, path.read_bytes())
            known = decode(TrunkMap, trunks.read_bytes()) if trunks.exists() else TrunkMap()
        except (OSError, InputError):  # without a farm the robot is still worth seeing
            return None
        self._shown = found
        return ShownFarm(site, known, read_cells(map3d) if map3d.exists() else None)


def _changed_ns(path: Path) -> int:
    return path.stat().st_mtime_ns if path.exists() else 0

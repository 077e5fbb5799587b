"""Which farm the 3D view shows: the one that the robot knows."""

from __future__ import annotations

import time
from pathlib import Path

from backend.supervisor import SupervisorClient
from navcore.errors import InputError
from navcore.maps.site_map import SiteMap
from navcore.transport.codec import decode

ASK_S = 2.0


class FarmWatch:
    """Asks the supervisor now and then; the maps are the files that the robot got (`SupervisorClient.place`)."""

    def __init__(self, supervisor: SupervisorClient, site_dir: Path) -> None:
        self._supervisor = supervisor
        self._site_dir = site_dir
        self._asked_s = float("-inf")
        self._shown: tuple[str, int] | None = None

    def news(self) -> SiteMap | None:
        """The farm, once when it is new or was loaded again; else None."""
        if time.monotonic() - self._asked_s < ASK_S:
            return None
        self._asked_s = time.monotonic()
        status = self._supervisor.status()
        if status is None or status.site_id is None:
            return None
        return self._read(status.site_id)

    def _read(self, site_id: str) -> SiteMap | None:
        path = self._site_dir / f"{site_id}.json"
        try:
            found = (site_id, path.stat().st_mtime_ns)
            site = decode(SiteMap, path.read_bytes()) if found != self._shown else None
        except (OSError, InputError):  # without a farm the robot is still worth seeing
            return None
        self._shown = found
        return site

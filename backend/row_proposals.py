"""What was found in 3D maps and waits for somebody to accept it or to throw it away: one proposal a site."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

from backend.import_jobs import ImportKind
from backend.settings import Settings
from backend.sites import SiteStore
from navcore.errors import CloudError
from navcore.maps.site_map import Datum
from navcore.transport.codec import decode

if TYPE_CHECKING:
    from navcore.mapping.row_map.row_map import RowMap

# Proposals are small, but a station runs for months.
MOST_KEPT = 50
BROKEN = (
    "No rows were found: the map needed too much time or memory. Thin it out to a point every 5 cm, or cut it to one "
    "block, and try again."
)


class RowProposals:
    """Since the start of the station; nothing of the site changes before one is accepted. Safe for many threads."""

    def __init__(self, sites: SiteStore) -> None:
        self._sites = sites
        self._lock = Lock()
        self._found: dict[str, tuple[str, RowMap]] = {}

    def get(self, site_id: str) -> tuple[str, RowMap] | None:
        """Name of the file, and what was found in it; None if nothing waits."""
        with self._lock:
            return self._found.get(site_id)

    def forget(self, site_id: str) -> None:
        """It was accepted or thrown away; also right if there is none."""
        with self._lock:
            self._found.pop(site_id, None)

    def put(self, site_id: str, file_name: str, found: RowMap) -> None:
        """In the place of the one before it. Raises NotFoundError if the site is gone."""
        # Here and below, because what finds rows loads scipy and shapely: the station is up without them.
        from navcore.mapping.row_map.row_map import fitted

        fitting = fitted(self._sites.get(site_id).site, found)
        with self._lock:
            self._found.pop(site_id, None)
            self._found[site_id] = (file_name, fitting)
            while len(self._found) > MOST_KEPT:
                del self._found[next(iter(self._found))]

    def taker(self, site_id: str, file_name: str) -> Callable[[Path, dict[str, Any]], str]:
        """What to do with what the process found."""

        def finish(_: Path, found: dict[str, Any]) -> str:
            from navcore.mapping.row_map.row_map import RowMap

            self.put(site_id, file_name, decode(RowMap, json.dumps(found).encode()))
            return site_id

        return finish


def rows_in_a_map(name: str, datum: Datum) -> ImportKind:
    """The job that finds rows in a file of points of that name, at a site of that datum."""

    def command(source: Path, _: Path, settings: Settings) -> list[str]:
        place = (f"--lat-deg={datum.lat_deg!r}", f"--lon-deg={datum.lon_deg!r}", f"--height-m={datum.height_m!r}")
        limits = (f"--memory-bytes={settings.map_memory_bytes}", f"--cpu-s={settings.import_cpu_s}")
        return [sys.executable, "-m", "backend.row_import", *place, *limits, "--", str(source), name]

    return ImportKind(command=command, error=CloudError, broken=BROKEN, done="Rows found")

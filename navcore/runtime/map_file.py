"""The 3D map of the farm that the robot stands on: a file beside the farm's own, which may come and change later."""

from __future__ import annotations

from pathlib import Path

from navcore.errors import InputError
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.ndt.ndt_file import read_ndt_map
from navcore.maps.site_map import Datum

NONE_YET = "this farm has no 3D map yet: make one from a run, on the Runs page"


def map_beside(site: Path) -> Path:
    """Where the map of a farm's file lies."""
    return site.with_suffix(".ndt")


class MapFile:
    """Looks at the file now and then.

    Attributes:
        localizer: on the map that is there, None without a usable one. reason: why there is none, else empty.
    """

    def __init__(self, path: Path, datum: Datum) -> None:
        self._path, self._datum = path, datum
        self._seen_ns: int | None = None
        self.localizer: MapLocalizer | None = None
        self.reason = NONE_YET
        self.look()

    def look(self) -> None:
        """Read the file if it is another one than before."""
        try:
            changed_ns = self._path.stat().st_mtime_ns
        except OSError:
            self._seen_ns, self.localizer, self.reason = None, None, NONE_YET
            return
        if changed_ns == self._seen_ns:
            return
        self._seen_ns = changed_ns
        self.localizer, self.reason = self._read()

    def _read(self) -> tuple[MapLocalizer | None, str]:
        try:
            ndt_map = read_ndt_map(self._path)
        except InputError as error:
            return None, str(error).rstrip(".")
        if ndt_map.datum != self._datum:
            return None, "the 3D map is of another farm: make one from a run on this farm"
        return MapLocalizer(ndt_map), ""

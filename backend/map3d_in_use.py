"""Which of a site's 3D maps the robot drives by: a copy beside the farm's file, which the scan worker looks at."""

from __future__ import annotations

from pathlib import Path

from backend.errors import ConflictError, NotFoundError
from backend.map3d_files import NDT
from backend.map3d_store import NONE, Map3dStore
from navcore.disk import write_durably

NOT_ON_EARTH = "This map has no place on the Earth, so the robot cannot drive by it. Map a run that had RTK."


class Map3dInUse:
    """The robot takes another map within some seconds, and goes on without one where there is none."""

    def __init__(self, store: Map3dStore, robot_dir: Path) -> None:
        self._store, self._robot_dir = store, robot_dir

    def run_id(self, site_id: str) -> str | None:
        """Of the run whose map is in use."""
        try:
            return self._name(site_id).read_text(encoding="utf-8") if self._map(site_id).is_file() else None
        except OSError:
            return None

    def use(self, site_id: str, run_id: str) -> None:
        """Raises NotFoundError for a map that is not there, ConflictError for one without a place on the Earth."""
        made = self._store.get(site_id, run_id)
        if made is None:
            raise NotFoundError(NONE)
        if not made.georeferenced:
            raise ConflictError(NOT_ON_EARTH)
        write_durably(self._map(site_id), self._store.file(site_id, run_id, NDT).read_bytes())
        write_durably(self._name(site_id), run_id.encode())

    def stop(self, site_id: str) -> None:
        """Drive by none."""
        self._map(site_id).unlink(missing_ok=True)
        self._name(site_id).unlink(missing_ok=True)

    def forget(self, site_id: str, run_id: str) -> None:
        """Drive by none if it was this one, which is thrown away."""
        if self.run_id(site_id) == run_id:
            self.stop(site_id)

    def _map(self, site_id: str) -> Path:
        return self._robot_dir / f"{site_id}.ndt"

    def _name(self, site_id: str) -> Path:
        return self._robot_dir / f"{site_id}.ndt.run"

"""3D maps on disk: for each site a folder, in it one for each run that was mapped."""

from __future__ import annotations

import json
import shutil
from datetime import UTC, datetime
from pathlib import Path

from backend.errors import ConflictError, NotFoundError
from backend.map3d_files import FILES, KEYFRAMES, NDT, REPORT
from backend.schemas import Map3dDocument, Map3dFile
from navcore.errors import CloudError, NdtMapError
from navcore.maps.site_map import Datum

NONE = "There is no such 3D map any more. Load the page again."
NOT_ON_EARTH = (
    "This map has no place on the Earth, so nobody knows where on the farm it lies. Map a run that had RTK."
)


class Map3dStore:
    """Ids are checked by the routes; names of files are ours."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def folder(self, site_id: str, run_id: str) -> Path:
        """Where a run's map is, or will be."""
        return self._folder / site_id / run_id

    def all(self, site_id: str) -> list[Map3dDocument]:
        """Of a site, the newest first."""
        made = [m for path in (self._folder / site_id).glob("*") if (m := self.get(site_id, path.name))]
        return sorted(made, key=lambda m: m.made, reverse=True)

    def get(self, site_id: str, run_id: str) -> Map3dDocument | None:
        """None if it is not made yet."""
        folder = self.folder(site_id, run_id)
        try:
            report = json.loads((folder / REPORT).read_bytes())
            made = datetime.fromtimestamp((folder / REPORT).stat().st_mtime, UTC)
        except (OSError, ValueError):
            return None
        files = [Map3dFile(name=n, size_bytes=(folder / n).stat().st_size) for n in FILES if (folder / n).is_file()]
        return Map3dDocument.model_validate({**report, "run_id": run_id, "made": made, "files": files})

    def datum(self, site_id: str, run_id: str) -> Datum:
        """Origin of a map's frame.

        Raises NotFoundError, ConflictError for a map without a place on the Earth, CloudError for a damaged one.
        """
        # Here, because it loads a compiler: a station whose farms have no 3D map is up without it.
        from navcore.maps.ndt.ndt_file import ndt_datum_of

        made = self.get(site_id, run_id)
        if made is None:
            raise NotFoundError(NONE)
        try:
            datum = ndt_datum_of(self.file(site_id, run_id, NDT).read_bytes(), NDT)
        except NdtMapError as error:
            raise damaged(str(error)) from None
        if datum is None or not made.georeferenced:
            raise ConflictError(NOT_ON_EARTH)
        return datum

    def placed(self, site_id: str, datum: Datum, preferred: str | None) -> str | None:
        """Run of the site's map that lies in the frame of `datum`: of the preferred one if it does, else the newest.

        None where there is no such map. Raises CloudError for a damaged one.
        """
        runs = [made.run_id for made in self.all(site_id) if made.georeferenced]
        ordered = sorted(runs, key=lambda run_id: run_id != preferred)
        return next((run_id for run_id in ordered if self.datum(site_id, run_id) == datum), None)

    def begun(self, site_id: str, run_id: str) -> bool:
        """Whether keyframes of an interrupted mapping are there."""
        return (self.folder(site_id, run_id) / KEYFRAMES).is_dir()

    def file(self, site_id: str, run_id: str, name: str) -> Path:
        """One of its files. Raises NotFoundError."""
        path = self.folder(site_id, run_id) / name
        if name not in FILES or not path.is_file():
            raise NotFoundError(NONE)
        return path

    def delete(self, site_id: str, run_id: str) -> None:
        """Raises NotFoundError if there is nothing."""
        folder = self.folder(site_id, run_id)
        if not folder.is_dir():
            raise NotFoundError(NONE)
        (folder / REPORT).unlink(missing_ok=True)
        shutil.rmtree(folder, ignore_errors=True)

    def delete_site(self, site_id: str) -> None:
        """All of a site that is deleted itself."""
        shutil.rmtree(self._folder / site_id, ignore_errors=True)


def damaged(why: str) -> CloudError:
    """What is wrong with a map's files, a sentence, and what to do."""
    return CloudError(f"This 3D map cannot be used: {why} Throw it away on the page of its run, and make it again.")

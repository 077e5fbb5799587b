"""Trunk maps in the database: one a site, grown by its runs, each run once."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from sqlalchemy.orm import Session

from backend import documents
from backend.database import Database
from backend.errors import NotFoundError
from backend.models import Site
from backend.models import TrunkMap as TrunkMapRow
from backend.schemas import TrunksMapped
from backend.shown_trunks import shown_file
from navcore.disk import write_durably
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import TrunkMap, trunks_of_row
from navcore.transport.codec import decode, encode


class TrunkMapStore:
    """What is known of the farms' trunks."""

    def __init__(self, database: Database, shown_dir: Path) -> None:
        """`shown_dir` is where the 3D view finds the maps: only the station reads the database."""
        self._database = database
        self._shown_dir = shown_dir

    def get(self, site_id: str) -> tuple[TrunkMap, int]:
        """The site's map, empty before the first run, and the number of runs in it. Raises NotFoundError."""
        with self._database.read() as session:
            documents.find(session, Site, site_id)
            row = session.get(TrunkMapRow, site_id)
            return of_site(session, site_id), len(row.run_ids.split()) if row else 0

    def add(self, site_id: str, run_id: str, seen: TrunkMap) -> TrunksMapped:
        """Take in what a run saw. Raises NotFoundError, and SiteError where the run fits in two ways."""
        # Here, because it loads scipy's trees, which a station needs at the end of a run and not for its start.
        from navcore.mapping.merged_runs import merged

        with self._database.write() as session:
            documents.find(session, Site, site_id)
            row = session.get(TrunkMapRow, site_id)
            known = decode(TrunkMap, row.document) if row else TrunkMap()
            if row and run_id in row.run_ids.split():
                return _told("This run is in the trunk map already.", seen, known, known)
            if not seen.trunks:
                return _told("This run saw no trunks: it drove no row with a 2D LiDAR.", seen, known, known)
            both = merged(known, seen)
            _store(session, site_id, both, run_id)
        self._show(site_id, both)
        added = len(both.trunks) - len(known.trunks)
        again = len(seen.trunks) - added
        return _told(f"{added} new trunks, {again} seen again. The map has {len(both.trunks)}.", seen, known, both)

    def put(self, site_id: str, trunk_map: TrunkMap) -> None:
        """Replace the site's map; the runs that were in it count as in the new one. Raises NotFoundError."""
        with self._database.write() as session:
            documents.find(session, Site, site_id)
            _store(session, site_id, trunk_map)
        self._show(site_id, trunk_map)

    def remove(self, site_id: str, trunk_id: str) -> None:
        """Take one trunk off. Raises NotFoundError if there is none of this id."""
        with self._database.write() as session:
            known = of_site(session, site_id)
            kept = tuple(trunk for trunk in known.trunks if trunk.id != trunk_id)
            if len(kept) == len(known.trunks):
                raise NotFoundError("This trunk is not on the map any more. Load the page again.")
            _store(session, site_id, TrunkMap(trunks=kept))
        self._show(site_id, TrunkMap(trunks=kept))

    def delete(self, site_id: str) -> None:
        """Throw the site's map away. Raises NotFoundError if there is no such site."""
        with self._database.write() as session:
            documents.find(session, Site, site_id)
            row = session.get(TrunkMapRow, site_id)
            if row is not None:
                session.delete(row)
        self._show(site_id, TrunkMap())

    def _show(self, site_id: str, trunk_map: TrunkMap) -> None:
        write_durably(shown_file(self._shown_dir, site_id), encode(trunk_map))


def trunk_name(trunk_map: TrunkMap, site: SiteMap, row_id: str, trunk_id: str) -> str:
    """As people say it, "left trunk 30 of 52". Raises NotFoundError if the row has no such trunk."""
    for row in site.rows:
        for placed in trunks_of_row(trunk_map, row) if row.id == row_id else ():
            if placed.trunk.id == trunk_id:
                return placed.name
    raise NotFoundError("This row has no such trunk any more. Load the page again and choose a trunk on the map.")


def of_site(session: Session, site_id: str) -> TrunkMap:
    """The site's map, empty before the first run."""
    row = session.get(TrunkMapRow, site_id)
    return decode(TrunkMap, row.document) if row else TrunkMap()


def _store(session: Session, site_id: str, trunk_map: TrunkMap, run_id: str = "") -> None:
    row = session.get(TrunkMapRow, site_id)
    run_ids = f"{row.run_ids if row else ''} {run_id}".strip()
    session.merge(
        TrunkMapRow(site_id=site_id, document=encode(trunk_map), run_ids=run_ids, updated=datetime.now(UTC))
    )


def _told(message: str, seen: TrunkMap, known: TrunkMap, both: TrunkMap) -> TrunksMapped:
    added = len(both.trunks) - len(known.trunks)
    return TrunksMapped(message=message, seen=len(seen.trunks), added=added, total=len(both.trunks))

"""Sites in the database."""

from __future__ import annotations

from datetime import UTC, datetime

from sqlalchemy import func, select

from backend import documents
from backend.database import Database
from backend.ids import new_id
from backend.models import Mission, Orthophoto, Site
from backend.schemas import OrthophotoInfo, SiteDocument, SiteSummary
from navcore.maps.site_map import SiteMap
from navcore.transport.codec import decode, encode


class SiteStore:
    """The farms."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def all(self) -> list[SiteSummary]:
        """Every site, by name."""
        counts = select(Mission.site_id, func.count()).group_by(Mission.site_id)
        with self._database.read() as session:
            missions: dict[str, int] = {row[0]: row[1] for row in session.execute(counts)}
            sites = session.scalars(select(Site).order_by(Site.name, Site.id)).all()
        return [_summary(site, missions.get(site.id, 0)) for site in sites]

    def get(self, site_id: str) -> SiteDocument:
        """Raises NotFoundError."""
        with self._database.read() as session:
            return _document(documents.find(session, Site, site_id))

    def create(self, site: SiteMap, orthophoto: Orthophoto | None = None) -> SiteDocument:
        """Store a new site, with its picture if it has one, in one transaction."""
        row = Site(
            id=new_id(), name=site.name, document=encode(site), updated=datetime.now(UTC), orthophoto=orthophoto
        )
        with self._database.write() as session:
            session.add(row)
        return _document(row)

    def update(self, site_id: str, version: int, site: SiteMap) -> SiteDocument:
        """Replace the map. Raises ConflictError if `version` is not the stored one."""
        return _document(documents.change(self._database, Site, site_id, version, site))

    def set_orthophoto(self, site_id: str, orthophoto: Orthophoto) -> str | None:
        """Put a picture under a site. Returns the id of the picture that lay there before."""
        with self._database.write() as session:
            row = documents.find(session, Site, site_id)
            before = row.orthophoto
            row.orthophoto, row.updated = orthophoto, datetime.now(UTC)
            if before is not None:
                session.delete(before)
        return before.id if before is not None else None

    def delete(self, site_id: str) -> str | None:
        """Delete a site and its missions; runs keep their own copies. Returns the id of its picture."""
        with self._database.write() as session:
            row = documents.find(session, Site, site_id)
            picture = row.orthophoto
            session.delete(row)
            if picture is not None:
                session.delete(picture)
        return picture.id if picture is not None else None

    def orthophoto_ids(self) -> set[str]:
        """Pictures that belong to a site."""
        with self._database.read() as session:
            return set(session.scalars(select(Orthophoto.id)))


def site_map(row: Site) -> SiteMap:
    """The map of a site's row."""
    return decode(SiteMap, row.document)


def orthophoto_info(row: Orthophoto) -> OrthophotoInfo:
    """What the browser needs to know of a picture."""
    return OrthophotoInfo(
        id=row.id,
        file_name=row.file_name,
        crs=row.crs,
        width_px=row.width_px,
        height_px=row.height_px,
        resolution=row.resolution,
        bounds_deg=(row.west_deg, row.south_deg, row.east_deg, row.north_deg),
        bounds_3857=(row.west_3857, row.south_3857, row.east_3857, row.north_3857),
        min_zoom=row.min_zoom,
        max_zoom=row.max_zoom,
    )


def _document(row: Site) -> SiteDocument:
    return SiteDocument(
        id=row.id,
        version=row.version,
        name=row.name,
        site=site_map(row),
        orthophoto=orthophoto_info(row.orthophoto) if row.orthophoto else None,
        updated=row.updated,
    )


def _summary(row: Site, missions: int) -> SiteSummary:
    site = site_map(row)
    return SiteSummary(
        id=row.id,
        version=row.version,
        name=row.name,
        rows=len(site.rows),
        lanes=len(site.lanes),
        missions=missions,
        orthophoto=orthophoto_info(row.orthophoto) if row.orthophoto else None,
        updated=row.updated,
    )

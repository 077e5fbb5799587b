"""Missions in the database. A running mission is a copy of its own (`backend.runs`), so editing is always free."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

from sqlalchemy import select
from sqlalchemy.orm import Session
from sqlalchemy.orm.exc import StaleDataError

from backend import sites
from backend.database import Database
from backend.errors import ConflictError, NotFoundError
from backend.models import Mission as MissionRow
from backend.schemas import MissionDocument
from navcore.maps.mission import Mission
from navcore.transport.codec import decode, encode


class MissionStore:
    """The missions of all sites."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def of_site(self, site_id: str) -> list[MissionDocument]:
        """All missions of a site, by name. Raises NotFoundError."""
        with self._database.read() as session:
            sites.find(session, site_id)
            query = select(MissionRow).where(MissionRow.site_id == site_id)
            return [_document(row) for row in session.scalars(query.order_by(MissionRow.name, MissionRow.id))]

    def get(self, mission_id: str) -> MissionDocument:
        """Raises NotFoundError."""
        with self._database.read() as session:
            return _document(find(session, mission_id))

    def create(self, site_id: str, mission: Mission) -> MissionDocument:
        """Store a new mission under an id of our own. Raises NotFoundError if the site is gone."""
        own = replace(mission, id=sites.new_id())
        row = MissionRow(id=own.id, site_id=site_id, name=own.name, document=encode(own), updated=datetime.now(UTC))
        with self._database.write() as session:
            sites.find(session, site_id)
            session.add(row)
        return _document(row)

    def update(self, mission_id: str, version: int, mission: Mission) -> MissionDocument:
        """Replace the mission. Raises ConflictError if `version` is not the stored one."""
        own = replace(mission, id=mission_id)
        try:
            with self._database.write() as session:
                row = find(session, mission_id)
                if row.version != version:
                    raise _stale()
                row.name, row.document, row.updated = own.name, encode(own), datetime.now(UTC)
        except StaleDataError as error:
            raise _stale() from error
        return _document(row)

    def delete(self, mission_id: str) -> None:
        """Delete a mission; its runs stay. Raises NotFoundError."""
        with self._database.write() as session:
            session.delete(find(session, mission_id))


def find(session: Session, mission_id: str) -> MissionRow:
    """The row of a mission. Raises NotFoundError."""
    row = session.get(MissionRow, mission_id)
    if row is None:
        raise NotFoundError("There is no such mission. It may have been deleted: go back to the list of missions.")
    return row


def mission(row: MissionRow) -> Mission:
    """The mission of a row."""
    return decode(Mission, row.document)


def _document(row: MissionRow) -> MissionDocument:
    return MissionDocument(
        id=row.id,
        site_id=row.site_id,
        version=row.version,
        name=row.name,
        mission=mission(row),
        updated=row.updated,
    )


def _stale() -> ConflictError:
    return ConflictError("The mission was changed elsewhere meanwhile. Load it again and repeat your change.")

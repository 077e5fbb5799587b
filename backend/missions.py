"""Missions in the database. A running mission is a copy of its own (`backend.runs`), so editing is always free."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

from sqlalchemy import select

from backend import documents
from backend.database import Database
from backend.ids import new_id
from backend.models import Mission as MissionRow
from backend.models import Site
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
            documents.find(session, Site, site_id)
            query = select(MissionRow).where(MissionRow.site_id == site_id)
            return [_document(row) for row in session.scalars(query.order_by(MissionRow.name, MissionRow.id))]

    def get(self, mission_id: str) -> MissionDocument:
        """Raises NotFoundError."""
        with self._database.read() as session:
            return _document(documents.find(session, MissionRow, mission_id))

    def create(self, site_id: str, mission: Mission) -> MissionDocument:
        """Store a new mission under an id of our own. Raises NotFoundError if the site is gone."""
        own = replace(mission, id=new_id())
        row = MissionRow(id=own.id, site_id=site_id, name=own.name, document=encode(own), updated=datetime.now(UTC))
        with self._database.write() as session:
            documents.find(session, Site, site_id)
            session.add(row)
        return _document(row)

    def update(self, mission_id: str, version: int, mission: Mission) -> MissionDocument:
        """Replace the mission. Raises ConflictError if `version` is not the stored one."""
        own = replace(mission, id=mission_id)
        return _document(documents.change(self._database, MissionRow, mission_id, version, own))

    def delete(self, mission_id: str) -> None:
        """Delete a mission; its runs stay. Raises NotFoundError."""
        with self._database.write() as session:
            session.delete(documents.find(session, MissionRow, mission_id))


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

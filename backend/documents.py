"""What people edit, a site or a mission: found by its id, and changed from its newest version only."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TypeVar

from sqlalchemy.orm import Session
from sqlalchemy.orm.exc import StaleDataError

from backend.database import Database
from backend.errors import ConflictError, NotFoundError
from backend.models import Mission as MissionRow
from backend.models import Site as SiteRow
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.transport.codec import encode

Row = TypeVar("Row", SiteRow, MissionRow)


def find(session: Session, table: type[Row], row_id: str) -> Row:
    """The row of a document. Raises NotFoundError."""
    row = session.get(table, row_id)
    if row is None:
        word = table.__tablename__
        raise NotFoundError(f"There is no such {word}. It may have been deleted: go back to the list of {word}s.")
    return row


def change(database: Database, table: type[Row], row_id: str, version: int, document: SiteMap | Mission) -> Row:
    """Replace a document. Raises NotFoundError, and ConflictError if `version` is not the stored one."""
    try:
        with database.write() as session:
            row = find(session, table, row_id)
            if row.version != version:
                raise _changed_elsewhere(table)
            row.name, row.document, row.updated = document.name, encode(document), datetime.now(UTC)
    except StaleDataError as error:
        raise _changed_elsewhere(table) from error
    return row


def _changed_elsewhere(table: type[SiteRow] | type[MissionRow]) -> ConflictError:
    word = table.__tablename__
    return ConflictError(f"The {word} was changed elsewhere meanwhile. Load it again and repeat your change.")

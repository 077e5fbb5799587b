"""The record of what operators asked for."""

from __future__ import annotations

from datetime import UTC, datetime

from backend.database import Database
from backend.logins import Login
from backend.models import AuditRecord

SHOWN_DIGEST = 12  # characters: enough to tell logins apart, useless as a secret


class AuditBook:
    """Written before the answer leaves, and on disk then."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def write(self, login: Login | None, action: str, subject: str, outcome: str) -> None:
        """One line: who, what, of which thing, and how it went."""
        record = AuditRecord(
            at=datetime.now(UTC),
            login=login.digest[:SHOWN_DIGEST] if login else "",
            action=action,
            subject=subject,
            outcome=outcome,
        )
        with self._database.write() as session:
            session.add(record)

"""Who is logged in: one-time addresses, cookies, and their end."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from threading import Lock

from sqlalchemy import delete, select

from backend.database import Database
from backend.models import Login as LoginRow

TOKEN_BYTES = 32
INVITATION_LIFE = timedelta(minutes=30)
SEEN_STEP = timedelta(minutes=1)


@dataclass(frozen=True, slots=True)
class Login:
    """A logged-in browser. `digest` stands for its cookie in the database and in the audit record."""

    digest: str
    created: datetime
    last_seen: datetime


def utc_now() -> datetime:
    """Wall clock, for people and for the life of logins; nothing that moves depends on it."""
    return datetime.now(UTC)


def digest(token: str) -> str:
    """What is kept of a secret: SHA-256, enough for 256 random bits."""
    return hashlib.sha256(token.encode()).hexdigest()


class LoginBook:
    """All logins and open invitations. Safe for many threads; reading one never waits for the disk."""

    def __init__(
        self, database: Database, idle: timedelta, absolute: timedelta, now: Callable[[], datetime] = utc_now
    ) -> None:
        """A login ends after `idle` without a request, and `absolute` after it began."""
        self._database = database
        self._idle = idle
        self._absolute = absolute
        self._now = now
        self._lock = Lock()
        self._invitations: dict[str, datetime] = {}
        self._logins = self._load()

    def _load(self) -> dict[str, Login]:
        with self._database.read() as session:
            rows = session.scalars(select(LoginRow)).all()
        return {row.digest: Login(row.digest, row.created, row.last_seen) for row in rows}

    def invite(self, life: timedelta | None = INVITATION_LIFE) -> str:
        """A one-time token; `life` None: until it is used or the station ends."""
        token = secrets.token_urlsafe(TOKEN_BYTES)
        with self._lock:
            self._invitations[digest(token)] = self._now() + life if life else datetime.max.replace(tzinfo=UTC)
        return token

    def enter(self, token: str) -> str | None:
        """Exchange a one-time token for a cookie's value; None if it is unknown, used or too old."""
        with self._lock:
            expires = self._invitations.pop(digest(token), None)
        if expires is None or expires < self._now():
            return None
        return self._open()

    def _open(self) -> str:
        cookie, now = secrets.token_urlsafe(TOKEN_BYTES), self._now()
        login = Login(digest(cookie), now, now)
        with self._database.write() as session:
            session.execute(delete(LoginRow).where(LoginRow.created < now - self._absolute))
            session.add(LoginRow(digest=login.digest, created=now, last_seen=now))
        with self._lock:
            self._logins[login.digest] = login
        return cookie

    def find(self, cookie: str | None) -> Login | None:
        """The live login of a cookie."""
        login = self._logins.get(digest(cookie)) if cookie else None
        return login if login and self.alive(login) else None

    def alive(self, login: Login) -> bool:
        """Whether a login that was found earlier still counts."""
        newest, now = self._logins.get(login.digest), self._now()
        return newest is not None and now < self.ends(newest)

    def ends(self, login: Login) -> datetime:
        """When it ends if nothing more is heard of it."""
        return min(login.last_seen + self._idle, login.created + self._absolute)

    def seen(self, login: Login) -> None:
        """Note that it was used; at most once a minute on disk."""
        now = self._now()
        if now - login.last_seen < SEEN_STEP:
            return
        with self._lock:
            if login.digest not in self._logins:
                return
            self._logins[login.digest] = replace(login, last_seen=now)
        with self._database.write() as session:
            row = session.get(LoginRow, login.digest)
            if row is not None:
                row.last_seen = now

    def leave(self, login: Login) -> None:
        """End a login at once, everywhere."""
        with self._lock:
            self._logins.pop(login.digest, None)
        with self._database.write() as session:
            session.execute(delete(LoginRow).where(LoginRow.digest == login.digest))

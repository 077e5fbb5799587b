"""Logging in."""

from __future__ import annotations

from datetime import datetime

from backend.schemas.base import Sent


class SessionDocument(Sent):
    """Whether the browser is logged in. `ends` is wall-clock UTC."""

    authenticated: bool
    ends: datetime | None


class Invitation(Sent):
    """A one-time address by which another browser logs in."""

    path: str
    expires_s: int

"""What routes ask for: the station's parts, the login, and ids that cannot be anything but ids."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Path
from starlette.requests import HTTPConnection

from backend.errors import ForbiddenError
from backend.logins import Login
from backend.schemas import ErrorDocument
from backend.station import Station

ERRORS: dict[int | str, dict[str, Any]] = {"default": {"model": ErrorDocument, "description": "Any error"}}


async def get_station(connection: HTTPConnection) -> Station:
    """The one station of this app."""
    station: Station = connection.app.state.station
    return station


async def get_login(connection: HTTPConnection) -> Login:
    """The login that the gate found. Raises ForbiddenError without one."""
    login: Login | None = connection.scope.get("rowpilot.login")
    if login is None:
        raise ForbiddenError("Please log in with the address that the station printed at its start.")
    return login


TheStation = Annotated[Station, Depends(get_station)]
TheLogin = Annotated[Login, Depends(get_login)]
PathId = Annotated[str, Path(pattern=r"^[0-9a-f]{16}$")]

"""Logging in by the one-time address, and out again."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import RedirectResponse, Response

from backend.deps import ERRORS, TheLogin, TheStation
from backend.errors import ForbiddenError
from backend.logins import INVITATION_LIFE, Login
from backend.schemas import Invitation, SessionDocument

router = APIRouter(tags=["session"], responses=ERRORS)


@router.get("/enter", response_class=RedirectResponse, status_code=303)
def enter(station: TheStation, token: Annotated[str, Query(max_length=200)]) -> Response:
    """Exchange the one-time token for a cookie and go to the start page, so that no token stays in the address."""
    cookie = station.logins.enter(token)
    if cookie is None:
        raise ForbiddenError("This address was used already or is too old. Start the station again for a new one.")
    response = RedirectResponse("/", status_code=303)
    response.set_cookie(
        station.settings.cookie_name,
        cookie,
        max_age=station.settings.session_absolute_s,
        httponly=True,
        samesite="strict",
    )
    return response


@router.get("/api/session")
def session(station: TheStation, request: Request) -> SessionDocument:
    """Whether this browser is logged in."""
    login: Login | None = request.scope.get("rowpilot.login")
    return SessionDocument(authenticated=login is not None, ends=station.logins.ends(login) if login else None)


@router.post("/api/session/logout", status_code=204)
def logout(station: TheStation, login: TheLogin, response: Response) -> None:
    """End this login; its live feeds close within a second."""
    station.logins.leave(login)
    station.audit.write(login, "logout", "", "done")
    response.delete_cookie(station.settings.cookie_name, httponly=True, samesite="strict")


@router.post("/api/session/invitations", status_code=201)
def invite(station: TheStation, login: TheLogin) -> Invitation:
    """A one-time address for another browser."""
    token = station.logins.invite()
    station.audit.write(login, "invite", "", "done")
    return Invitation(path=f"/enter?token={token}", expires_s=int(INVITATION_LIFE.total_seconds()))

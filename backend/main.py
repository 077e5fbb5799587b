"""The app factory: settings in, an ASGI app out. Nothing happens at import."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.metadata import version

from fastapi import FastAPI

from backend import error_answers, permissions
from backend.body_limits import BodyLimit
from backend.gate import Gate
from backend.headers import SecurityHeaders
from backend.routes import (
    calibration,
    frontend,
    lanelets,
    live,
    maps3d,
    missions,
    orthophotos,
    robot,
    rows,
    runs,
    scene,
    session,
    sites,
    trunks,
)
from backend.settings import Settings
from backend.station import Station, open_station

ROOMS = (
    session,
    sites,
    lanelets,
    rows,
    trunks,
    maps3d,
    orthophotos,
    missions,
    robot,
    runs,
    live,
    calibration,
    scene,
    frontend,
)  # the last one takes what is left


def create_app(settings: Settings) -> FastAPI:
    """The station, opened. It listens to the robot while the app runs. Raises ContractError for an open route."""
    app = bare_app()
    station = open_station(settings)
    app.state.station = station
    app.router.lifespan_context = lambda _: listening(station)
    app.add_middleware(BodyLimit)
    app.add_middleware(Gate, settings=settings, logins=station.logins, routes=app.router.routes)
    app.add_middleware(SecurityHeaders)  # the outermost: refusals carry the headers too
    return app


def bare_app() -> FastAPI:
    """Routes and errors without a station, enough for the OpenAPI text."""
    app = FastAPI(
        title="Rowpilot",
        version=version("rowpilot"),
        docs_url=None,
        redoc_url=None,
        openapi_url=None,
        separate_input_output_schemas=False,
    )
    error_answers.install(app)
    for room in ROOMS:
        app.router.routes.extend(room.router.routes)  # flat, so that every route can be seen and checked
    permissions.check(app.router.routes)
    return app


@asynccontextmanager
async def listening(station: Station) -> AsyncIterator[None]:
    """The life of the app."""
    station.start(asyncio.get_running_loop())
    try:
        yield
    finally:
        await asyncio.to_thread(station.close)

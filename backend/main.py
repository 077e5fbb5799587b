"""The app factory: settings in, an ASGI app out. Nothing happens at import."""

from __future__ import annotations

from importlib.metadata import version

from fastapi import FastAPI

from backend import errors, permissions
from backend.routes import frontend, live, missions, orthophotos, robot, runs, scene, session, sites
from backend.settings import Settings

ROOMS = (session, sites, orthophotos, missions, robot, runs, live, scene, frontend)  # the last one takes what is left


def create_app(settings: Settings) -> FastAPI:
    """The station's app. Raises ContractError if a route has no permission."""
    app = FastAPI(
        title="Rowpilot",
        version=version("rowpilot"),
        docs_url=None,
        redoc_url=None,
        openapi_url=None,
        separate_input_output_schemas=False,
    )
    errors.install(app)
    for module in ROOMS:
        app.router.routes.extend(module.router.routes)  # flat, so that every route can be seen and checked
    permissions.check(app.routes)
    return app

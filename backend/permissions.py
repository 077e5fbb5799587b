"""Who may call what. A route that is not in this table keeps the station from starting."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

from starlette.routing import BaseRoute

from navcore.errors import ContractError


class Permission(Enum):
    """PUBLIC: anyone who reaches the port. LOGIN: a logged-in browser."""

    PUBLIC = "public"
    LOGIN = "login"


PUBLIC, LOGIN = Permission.PUBLIC, Permission.LOGIN

PERMISSIONS: dict[str, Permission] = {
    "GET /enter": PUBLIC,
    "GET /api/session": PUBLIC,
    "POST /api/session/logout": LOGIN,
    "POST /api/session/invitations": LOGIN,
    "GET /api/sites": LOGIN,
    "POST /api/sites": LOGIN,
    "POST /api/sites/import": LOGIN,
    "GET /api/sites/{site_id}": LOGIN,
    "PUT /api/sites/{site_id}": LOGIN,
    "DELETE /api/sites/{site_id}": LOGIN,
    "GET /api/sites/{site_id}/geojson": LOGIN,
    "POST /api/sites/import/osm": LOGIN,
    "GET /api/sites/{site_id}/osm": LOGIN,
    "POST /api/sites/{site_id}/found-rows": LOGIN,
    "POST /api/sites/{site_id}/found-rows/of-run/{run_id}": LOGIN,
    "GET /api/sites/{site_id}/found-rows": LOGIN,
    "DELETE /api/sites/{site_id}/found-rows": LOGIN,
    "GET /api/sites/{site_id}/trunks": LOGIN,
    "DELETE /api/sites/{site_id}/trunks": LOGIN,
    "GET /api/sites/{site_id}/trunks/geojson": LOGIN,
    "PUT /api/sites/{site_id}/trunks/geojson": LOGIN,
    "DELETE /api/sites/{site_id}/trunks/{trunk_id}": LOGIN,
    "GET /api/sites/{site_id}/trunks/csv": LOGIN,
    "POST /api/runs/{run_id}/trunks": LOGIN,
    "GET /api/runs/{run_id}/map3d": LOGIN,
    "POST /api/runs/{run_id}/map3d": LOGIN,
    "DELETE /api/runs/{run_id}/map3d/job": LOGIN,
    "GET /api/sites/{site_id}/maps3d": LOGIN,
    "GET /api/sites/{site_id}/map3d/in_use": LOGIN,
    "PUT /api/sites/{site_id}/map3d/in_use": LOGIN,
    "DELETE /api/sites/{site_id}/maps3d/{run_id}": LOGIN,
    "GET /api/sites/{site_id}/maps3d/{run_id}/files/{name}": LOGIN,
    "GET /api/sites/{site_id}/maps3d/{run_id}/picture": LOGIN,
    "GET /api/sites/{site_id}/maps3d/{run_id}/picture.png": LOGIN,
    "POST /api/orthophotos": LOGIN,
    "POST /api/sites/{site_id}/orthophoto": LOGIN,
    "GET /api/jobs/{job_id}": LOGIN,
    "GET /api/sites/{site_id}/tiles/{z}/{x}/{y}.png": LOGIN,
    "GET /api/sites/{site_id}/missions": LOGIN,
    "POST /api/sites/{site_id}/missions": LOGIN,
    "POST /api/sites/{site_id}/missions/for-row": LOGIN,
    "POST /api/sites/{site_id}/missions/import": LOGIN,
    "POST /api/sites/{site_id}/preview": LOGIN,
    "GET /api/missions/{mission_id}": LOGIN,
    "PUT /api/missions/{mission_id}": LOGIN,
    "DELETE /api/missions/{mission_id}": LOGIN,
    "GET /api/missions/{mission_id}/geojson": LOGIN,
    "GET /api/robot": LOGIN,
    "POST /api/robot/site": LOGIN,
    "POST /api/robot/place": LOGIN,
    "GET /api/drive/nonce": LOGIN,
    "GET /api/runs": LOGIN,
    "POST /api/runs": LOGIN,
    "POST /api/runs/current/stop": LOGIN,
    "POST /api/runs/current/{action}": LOGIN,
    "GET /api/runs/{run_id}": LOGIN,
    "GET /api/runs/{run_id}/track": LOGIN,
    "GET /api/runs/{run_id}/camera": LOGIN,
    "GET /api/runs/{run_id}/download": LOGIN,
    "GET /api/calibration": LOGIN,
    "POST /api/calibration": LOGIN,
    "DELETE /api/calibration": LOGIN,
    "POST /api/calibration/take": LOGIN,
    "PUT /api/calibration/pictures/{name}": LOGIN,
    "GET /api/calibration/pictures/{name}": LOGIN,
    "POST /api/calibration/accept": LOGIN,
    "GET /api/calibration/versions": LOGIN,
    "PUT /api/calibration/versions": LOGIN,
    "GET /api/calibration/board": LOGIN,
    "GET /api/live/latest": LOGIN,
    "WEBSOCKET /api/live": LOGIN,
    "WEBSOCKET /scene": LOGIN,
    "GET /scene/{path:path}": LOGIN,
    "GET /{path:path}": LOGIN,
}


def keys(route: BaseRoute) -> list[str]:
    """A route's names in the table: method and path, one for each method."""
    path = getattr(route, "path", None)
    if path is None:
        return [f"UNKNOWN {type(route).__name__}"]
    methods: Iterable[str] = getattr(route, "methods", None) or ("WEBSOCKET",)
    return [f"{method} {path}" for method in sorted(methods) if method != "HEAD"]


def check(routes: Iterable[BaseRoute]) -> None:
    """Raises ContractError, naming every route without a permission."""
    undeclared = [key for route in routes for key in keys(route) if key not in PERMISSIONS]
    if undeclared:
        raise ContractError(f"No permission is declared for {', '.join(undeclared)}: add it to PERMISSIONS.")

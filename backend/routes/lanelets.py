"""Sites as Lanelet2 OSM: import and export."""

from __future__ import annotations

import logging

from fastapi import APIRouter, Request, Response
from fastapi.concurrency import run_in_threadpool

from backend.deps import ERRORS, PathId, TheLogin, TheStation
from backend.drawn import check_site
from backend.schemas import ImportedSite
from backend.station import Station
from navcore.errors import RowpilotError
from navcore.mapping.row_map.u_turns import u_turns
from navcore.maps.site_map import Datum
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.lanelet_export import GroundHeight, vector_map_to_osm
from navcore.maps.vector_map.lanelet_import import import_lanelets
from navcore.maps.vector_map.to_site import site_of

log = logging.getLogger("rowpilot.station")
router = APIRouter(prefix="/api/sites", tags=["sites"], responses=ERRORS)
MEDIA_TYPE = "application/xml"
FILE = {
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
    }
}


@router.post("/import/osm", status_code=201, openapi_extra=FILE)
async def import_osm(station: TheStation, login: TheLogin, request: Request) -> ImportedSite:
    """A new site from Lanelet2 OSM (the body is the file), with what was noticed on the way."""
    data = await request.body()
    return await run_in_threadpool(_import, station, data)


@router.get("/{site_id}/osm", response_class=Response, responses={200: {"content": {MEDIA_TYPE: {}}}})
def export_osm(station: TheStation, site_id: PathId) -> Response:
    """The site as Lanelet2 OSM, with the turns that its headlands allow this robot, and heights where a 3D map of the
    farm knows the ground; the first time such a map is asked for them takes some seconds.
    """
    site = station.sites.get(site_id).site
    data = vector_map_to_osm(
        vector_map_of(site, u_turns(site, station.vehicle)), _ground(station, site_id, site.datum)
    )
    disposition = f'attachment; filename="site-{site_id}.osm"'
    return Response(data, media_type=MEDIA_TYPE, headers={"Content-Disposition": disposition})


def _ground(station: Station, site_id: str, datum: Datum) -> GroundHeight:
    """Of the map that is driven by, else of the newest that lies in the site's frame; a broken one knows nothing."""
    try:
        run_id = station.maps3d.placed(site_id, datum, station.map3d_in_use.run_id(site_id))
        ground = None if run_id is None else station.map3d_pictures.ground(site_id, run_id)
    except RowpilotError as error:
        log.warning("no heights for site %s: %s", site_id, error)
        ground = None
    return (lambda _: None) if ground is None else ground.seen_at


def _import(station: Station, data: bytes) -> ImportedSite:
    imported = import_lanelets(data)
    document = station.sites.create(check_site(site_of(imported.vector_map)))
    return ImportedSite(**document.model_dump(exclude={"site"}), site=document.site, notes=list(imported.notes))

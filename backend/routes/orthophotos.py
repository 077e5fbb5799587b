"""Orthophotos: upload, progress of the import, tiles."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool

from backend.deps import ERRORS, PathId, TheLogin, TheStation
from backend.schemas import Job, JobStarted
from backend.uploads import receive

router = APIRouter(prefix="/api", tags=["orthophotos"], responses=ERRORS)
FileName = Annotated[str, Query(max_length=200, description="Name of the file, for people")]
FILE = {
    "requestBody": {
        "required": True,
        "content": {
            "application/octet-stream": {"schema": {"type": "string", "format": "binary"}},
            "image/tiff": {"schema": {"type": "string", "format": "binary"}},
        },
    }
}
Tile = Annotated[int, Path(ge=0, le=2**24)]


@router.post("/orthophotos", status_code=202, openapi_extra=FILE)
async def upload_new_site(
    station: TheStation, login: TheLogin, request: Request, name: FileName = "orthophoto.tif"
) -> JobStarted:
    """Import a GeoTIFF (the body is the file) as the ground of a new site."""
    path = await receive(request, station.settings)
    return JobStarted(job_id=station.jobs.start(path, station.picture_sites.new_site(name)))


@router.post("/sites/{site_id}/orthophoto", status_code=202, openapi_extra=FILE)
async def upload_for_site(
    station: TheStation, login: TheLogin, request: Request, site_id: PathId, name: FileName = "orthophoto.tif"
) -> JobStarted:
    """Import a GeoTIFF (the body is the file) as the ground of a site that is there already."""
    await run_in_threadpool(station.sites.get, site_id)
    path = await receive(request, station.settings)
    return JobStarted(job_id=station.jobs.start(path, station.picture_sites.for_site(site_id, name)))


@router.get("/jobs/{job_id}")
def read_job(station: TheStation, job_id: PathId) -> Job:
    """How an import goes."""
    return station.jobs.get(job_id)


@router.get(
    "/sites/{site_id}/tiles/{z}/{x}/{y}.png",
    response_class=Response,
    responses={200: {"content": {"image/png": {}}}},
)
def tile(station: TheStation, site_id: PathId, z: Annotated[int, Path(ge=0, le=24)], x: Tile, y: Tile) -> Response:
    """A map tile, 256 px, EPSG:3857 XYZ, transparent outside of the picture."""
    png = station.pictures.tile(station.sites.get(site_id).orthophoto, z, x, y)
    return Response(png, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})

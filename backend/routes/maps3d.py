"""3D maps: made of a run, listed for its site, taken home, thrown away."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path
from fastapi.responses import FileResponse

from backend.deps import ERRORS, PathId, TheStation
from backend.errors import ConflictError, NotFoundError
from backend.schemas import Map3dChoice, Map3dDocument, Map3dPicture, RunMap3d
from backend.station import Station
from navcore.recording.message_count import message_count
from navcore.topics import LIDAR3D_CLOUD

router = APIRouter(prefix="/api", tags=["3D maps"], responses=ERRORS)
FileName = Annotated[str, Path(pattern=r"^[0-9a-z.]{1,40}$")]


@router.get("/runs/{run_id}/map3d")
def read_run_map3d(station: TheStation, run_id: PathId) -> RunMap3d:
    """Whether the run can be mapped, how it goes, and what came of it."""
    site_id, clouds = station.runs.get(run_id).site_id, _clouds(station, run_id)
    if site_id is None:
        return RunMap3d(clouds=clouds, begun=False, job=None, map=None)
    return RunMap3d(
        clouds=clouds, begun=station.maps3d.begun(site_id, run_id), job=station.map3d_jobs.get(run_id),
        map=station.maps3d.get(site_id, run_id),
    )  # fmt: skip


@router.post("/runs/{run_id}/map3d", status_code=202)
def start_map3d(station: TheStation, run_id: PathId) -> RunMap3d:
    """Make the 3D map of a run that has ended, or go on with it; 409 while another one is made."""
    run = station.runs.get(run_id)
    if run.ended is None:
        raise ConflictError("This run is still driving. Make its map when it has ended.")
    station.map3d_jobs.start(_site_of(station, run_id), run_id, station.runs.log_path(run_id))
    return read_run_map3d(station, run_id)


@router.delete("/runs/{run_id}/map3d/job", status_code=204)
def stop_map3d(station: TheStation, run_id: PathId) -> None:
    """Stop making it; what was done is kept."""
    station.map3d_jobs.stop(run_id)


@router.get("/sites/{site_id}/maps3d")
def list_maps3d(station: TheStation, site_id: PathId) -> list[Map3dDocument]:
    """The 3D maps of a site, the newest first."""
    station.sites.get(site_id)
    return station.maps3d.all(site_id)


@router.delete("/sites/{site_id}/maps3d/{run_id}", status_code=204)
def delete_map3d(station: TheStation, site_id: PathId, run_id: PathId) -> None:
    """Throw a map away, or what was begun of one; the run stays and can be mapped again."""
    station.map3d_jobs.forget(run_id)
    station.map3d_in_use.forget(site_id, run_id)
    station.maps3d.delete(site_id, run_id)


@router.get("/sites/{site_id}/map3d/in_use")
def read_in_use(station: TheStation, site_id: PathId) -> Map3dChoice:
    """Which map the robot drives by on this site."""
    return Map3dChoice(run_id=station.map3d_in_use.run_id(site_id))


@router.put("/sites/{site_id}/map3d/in_use")
def use_map3d(station: TheStation, site_id: PathId, body: Map3dChoice) -> Map3dChoice:
    """Drive by the map of a run, or by none."""
    station.sites.get(site_id)
    if body.run_id is None:
        station.map3d_in_use.stop(site_id)
    else:
        station.map3d_in_use.use(site_id, body.run_id)
    return read_in_use(station, site_id)


@router.get("/sites/{site_id}/maps3d/{run_id}/files/{name}", response_class=FileResponse)
def download_map3d(station: TheStation, site_id: PathId, run_id: PathId, name: FileName) -> FileResponse:
    """map.ndt, cloud.laz, cloud.pcd or report.json."""
    path = station.maps3d.file(site_id, run_id, name)
    return FileResponse(path, filename=f"{run_id}-{name}", content_disposition_type="attachment")


@router.get("/sites/{site_id}/maps3d/{run_id}/picture")
def read_picture(station: TheStation, site_id: PathId, run_id: PathId) -> Map3dPicture:
    """Where the map lies, seen from above; drawn when it is first asked for, which takes some seconds."""
    return station.map3d_pictures.get(site_id, run_id)


@router.get(
    "/sites/{site_id}/maps3d/{run_id}/picture.png",
    response_class=FileResponse,
    responses={200: {"content": {"image/png": {}}}},
)
def read_pixels(station: TheStation, site_id: PathId, run_id: PathId) -> FileResponse:
    """The map seen from above, coloured by height above the ground, see-through where nothing was seen."""
    path = station.map3d_pictures.png(site_id, run_id)
    return FileResponse(path, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})


def _clouds(station: Station, run_id: str) -> int | None:
    """None where the log cannot tell; 0 without a log."""
    try:
        return message_count(station.runs.log_path(run_id), LIDAR3D_CLOUD.name)
    except NotFoundError:
        return 0


def _site_of(station: Station, run_id: str) -> str:
    site_id = station.runs.get(run_id).site_id
    if site_id is None:
        raise NotFoundError("The site of this run was deleted, so its map would belong nowhere.")
    return site_id

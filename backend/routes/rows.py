"""Rows found in a 3D map, sent or of a run: proposed, thrown away.

Accepting is drawing: the browser adds them to its site.
"""

from __future__ import annotations

from pathlib import PurePath
from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.concurrency import run_in_threadpool

from backend.deps import ERRORS, PathId, TheLogin, TheStation
from backend.errors import ConflictError
from backend.map3d_files import CLOUD
from backend.row_proposals import rows_in_a_map
from backend.schemas import JobStarted, RowProposal
from backend.uploads import lent, receive
from navcore.errors import CloudError
from navcore.maps.cloud_files.cloud_endings import CLOUD_ENDINGS

router = APIRouter(prefix="/api/sites/{site_id}/found-rows", tags=["rows"], responses=ERRORS)
FileName = Annotated[str, Query(max_length=200, description="Name of the file; its ending tells its form")]
FILE = {
    "requestBody": {
        "required": True,
        "content": {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}},
    }
}
MOVED = "The farm’s middle was moved after this map was made. Choose the map of a newer run."
# KITTI's .bin is one scan in the sensor's frame, never a map.
ENDINGS = tuple(ending for ending in CLOUD_ENDINGS if ending != ".bin")


@router.post("", status_code=202, openapi_extra=FILE)
async def find_rows(
    station: TheStation, login: TheLogin, request: Request, site_id: PathId, name: FileName
) -> JobStarted:
    """Look for rows in a 3D map (the body is the file); what is found waits as a proposal."""
    site = (await run_in_threadpool(station.sites.get, site_id)).site
    ending = PurePath(name).suffix.lower()
    if ending not in ENDINGS:
        raise CloudError(f"“{name[:80]}” is no 3D map. Choose a file that ends in {', '.join(ENDINGS)}.")
    received = await receive(request, station.settings)
    source = received.rename(received.with_suffix(ending))
    kind = rows_in_a_map(PurePath(name).name, site.datum)
    return JobStarted(job_id=station.jobs.start(source, station.row_proposals.taker(site_id, name), kind))


@router.post("/of-run/{run_id}", status_code=202)
def find_rows_of_run(station: TheStation, site_id: PathId, run_id: PathId) -> JobStarted:
    """Look for rows in the 3D map that was made of a run of this farm; nothing is sent."""
    site = station.sites.get(site_id).site
    if station.maps3d.datum(site_id, run_id) != site.datum:
        raise ConflictError(MOVED)
    name = f"The 3D map of “{station.runs.get(run_id).mission_name}”"
    source = lent(station.maps3d.file(site_id, run_id, CLOUD), station.settings)
    kind = rows_in_a_map(name, site.datum)
    return JobStarted(job_id=station.jobs.start(source, station.row_proposals.taker(site_id, name), kind))


@router.get("")
def read_found_rows(station: TheStation, site_id: PathId) -> RowProposal | None:
    """What was found last and is neither accepted nor thrown away; null if there is nothing."""
    proposal = station.row_proposals.get(site_id)
    if proposal is None:
        return None
    file_name, found = proposal
    return RowProposal(
        file_name=file_name, rows=list(found.rows), lanes=list(found.lanes), zones=list(found.zones),
        plants=list(found.plants), notes=list(found.notes),
    )  # fmt: skip


@router.delete("", status_code=204)
def forget_found_rows(station: TheStation, site_id: PathId) -> None:
    """The proposal was accepted or thrown away."""
    station.row_proposals.forget(site_id)

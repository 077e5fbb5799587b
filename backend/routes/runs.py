"""Runs: start with everything checked, stop past everything, look back."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, BackgroundTasks, Query, Response
from fastapi.responses import FileResponse

from backend.deps import ERRORS, PathId, TheLogin, TheStation
from backend.growing_file import GrowingFileResponse
from backend.run_camera import picture_at
from backend.schemas import (
    ActionResult,
    LogFormat,
    Nonce,
    OperatorAction,
    RunDetail,
    RunDocument,
    RunStart,
    RunTrack,
    StopResult,
)

router = APIRouter(prefix="/api", tags=["runs"], responses=ERRORS)
LATER = 7 * 24 * 3600.0  # s, longer than any run


@router.get("/drive/nonce")
def nonce(station: TheStation, login: TheLogin) -> Nonce:
    """A number for one start, from the page that the operator looks at."""
    return station.nonces.issue(login.digest)


@router.get("/runs")
def list_runs(station: TheStation, limit: Annotated[int, Query(ge=1, le=500)] = 100) -> list[RunDocument]:
    """The newest runs, newest first."""
    return station.runs.newest(limit)


@router.post("/runs", status_code=201)
def start_run(station: TheStation, login: TheLogin, body: RunStart) -> RunDocument:
    """Start a stored mission; 409 with every reason if it cannot start."""
    station.nonces.use(body.nonce, login.digest)
    return station.starter.start(login, body.mission_id, body.link_loss)


@router.post("/runs/current/stop")
async def stop(station: TheStation, login: TheLogin, tasks: BackgroundTasks) -> StopResult:
    """Stop now: to the guard by the short way, and to the navigator. Nothing else is asked first."""
    result = await station.stopper.stop()
    tasks.add_task(station.audit.write, login, "stop", "", result.message)
    return result


@router.post("/runs/current/{action}")
def act(station: TheStation, login: TheLogin, action: OperatorAction) -> ActionResult:
    """Pause, resume, or acknowledge what happened."""
    station.starter.act(login, action)
    return ActionResult(accepted=True)


@router.get("/runs/{run_id}")
def read_run(station: TheStation, run_id: PathId) -> RunDetail:
    """One run with its own site, mission and plan."""
    return station.runs.detail(run_id)


@router.get("/runs/{run_id}/track", response_model=RunTrack)
def track(station: TheStation, run_id: PathId) -> FileResponse:
    """The run in columns, for replay."""
    return FileResponse(station.exports.track(station.runs.log_path(run_id)), media_type="application/json")


@router.get(
    "/runs/{run_id}/camera",
    response_class=Response,
    responses={200: {"content": {"image/jpeg": {}}, "headers": {"X-Camera-View": {"schema": {"type": "string"}}}}},
)
def camera(station: TheStation, run_id: PathId, t_s: Annotated[float, Query(ge=0, le=LATER)]) -> Response:
    """The picture shown at `t_s`; what was seen in it is in the header X-Camera-View, as JSON."""
    view, jpeg = picture_at(station.runs.log_path(run_id), t_s)
    return Response(jpeg, media_type="image/jpeg", headers={"X-Camera-View": view})


@router.get("/runs/{run_id}/download", response_class=FileResponse)
def download(station: TheStation, run_id: PathId, format: LogFormat = LogFormat.MCAP) -> FileResponse:  # noqa: A002
    """The run log, or one of its exports."""
    path = station.exports.download(station.runs.log_path(run_id), format)
    return GrowingFileResponse(path, filename=f"run-{run_id}.{format}", content_disposition_type="attachment")

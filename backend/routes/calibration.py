"""Calibration: a person with a board before the live camera, and the versions that came of it."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Response

from backend.calibrator.requests import CalibratorRequest, CalibratorRequestKind
from backend.deps import ERRORS, TheLogin, TheStation
from backend.schemas import (
    CalibrationAccept,
    CalibrationAccepted,
    CalibrationDocument,
    CalibrationStart,
    PoseChange,
    VersionChoice,
    VersionDocument,
)
from navcore.calibration.board import Board
from navcore.calibration.board_print import board_svg

router = APIRouter(prefix="/api/calibration", tags=["calibration"], responses=ERRORS)
PoseName = Annotated[str, Path(pattern=r"^[0-9]{1,6}$")]


@router.get("")
def read_calibration(station: TheStation) -> CalibrationDocument:
    """The calibration under way, if there is one. Asking keeps its process running."""
    return station.calibrator.document()


@router.post("", status_code=201)
def begin_calibration(station: TheStation, login: TheLogin, body: CalibrationStart) -> CalibrationDocument:
    """Begin one; refused while a mission or another one is under way."""
    document = station.calibrator.begin(body)
    station.audit.write(login, "calibrate", f"{body.camera} {body.job}", "rehearsal" if body.rehearsal else "begun")
    return document


@router.delete("", status_code=204)
def throw_calibration_away(station: TheStation, login: TheLogin) -> None:
    """Throw away all that was taken."""
    station.calibrator.throw_away()
    station.audit.write(login, "calibrate", "", "thrown away")


@router.post("/take")
def take_picture(station: TheStation) -> CalibrationDocument:
    """Take the next picture that shows the board."""
    return station.calibrator.change(CalibratorRequest(kind=CalibratorRequestKind.TAKE))


@router.put("/pictures/{name}")
def keep_picture(station: TheStation, name: PoseName, body: PoseChange) -> CalibrationDocument:
    """Throw a picture out of the result, or bring it back."""
    request = CalibratorRequest(kind=CalibratorRequestKind.KEEP, name=name, kept=body.kept)
    return station.calibrator.change(request)


@router.get(
    "/pictures/{name}", response_class=Response, responses={200: {"content": {"image/jpeg": {}}}}
)  # fmt: skip
def picture(station: TheStation, name: PoseName) -> Response:
    """A picture that was taken."""
    return Response(station.calibrator.picture(name), media_type="image/jpeg")


@router.post("/accept")
def accept_calibration(station: TheStation, login: TheLogin, body: CalibrationAccept) -> CalibrationAccepted:
    """Keep the result as a version and put it in use; refused while a mission is under way."""
    version_id = station.calibrator.accept(body.made_by, body.camera)
    station.audit.write(login, "calibrate", version_id, f"accepted by {body.made_by}")
    return CalibrationAccepted(version_id=version_id)


@router.get("/versions")
def list_versions(station: TheStation) -> list[VersionDocument]:
    """All that are kept."""
    return station.calibrations.all()


@router.put("/versions")
def use_version(station: TheStation, login: TheLogin, body: VersionChoice) -> list[VersionDocument]:
    """Put a version in use; the robot's eyes start again with it, within seconds."""
    station.calibrations.use(body)
    station.audit.write(login, "use calibration", body.id or "settings", body.camera)
    return station.calibrations.all()


@router.get("/board", response_class=Response, responses={200: {"content": {"image/svg+xml": {}}}})
def board(
    columns: Annotated[int, Query(ge=3, le=20)] = 8,
    rows: Annotated[int, Query(ge=3, le=20)] = 5,
    square_mm: Annotated[float, Query(ge=2.0, le=1000.0, allow_inf_nan=False)] = 27.0,
    *,
    charuco: bool = False,
) -> Response:
    """The board to print at its true size, as SVG."""
    svg = board_svg(Board(columns=columns, rows=rows, square=square_mm / 1000.0, charuco=charuco))
    name = f"board-{columns}x{rows}-{square_mm:g}mm.svg"
    return Response(svg, media_type="image/svg+xml", headers={"Content-Disposition": f'inline; filename="{name}"'})

"""Missions: edit, one click on a row, preview by the code that drives."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Body, Response

from backend import planner
from backend.deps import ERRORS, PathId, TheStation
from backend.drawn import check_mission
from backend.schemas import (
    MissionCreate,
    MissionDocument,
    MissionEdit,
    Preview,
    PreviewRequest,
    RowMissionRequest,
)
from backend.site_files import check_text
from backend.trunk_maps import trunk_name
from navcore.maps import geojson
from navcore.maps.mission import Mission, RowExit
from navcore.planning.mission_planner import mission_for_row

router = APIRouter(prefix="/api", tags=["missions"], responses=ERRORS)
GeoJson = Annotated[dict[str, Any], Body(description="GeoJSON FeatureCollection")]


@router.get("/sites/{site_id}/missions")
def list_missions(station: TheStation, site_id: PathId) -> list[MissionDocument]:
    """All missions of a site, by name."""
    return station.missions.of_site(site_id)


@router.post("/sites/{site_id}/missions", status_code=201)
def create_mission(station: TheStation, site_id: PathId, body: MissionCreate) -> MissionDocument:
    """Store a mission."""
    return station.missions.create(site_id, check_mission(body.mission))


@router.post("/sites/{site_id}/missions/for-row")
def row_mission(station: TheStation, site_id: PathId, body: RowMissionRequest) -> Mission:
    """The whole mission to a row, or to a trunk in it, and back along the lanes; not saved."""
    site = station.sites.get(site_id).site
    if body.stop_at is None:
        return mission_for_row(site, body.row_id, body.exit)
    name = trunk_name(station.trunk_maps.get(site_id)[0], site, body.row_id, body.stop_at)
    mission = mission_for_row(site, body.row_id, RowExit.REVERSE)
    visits = tuple(replace(visit, stop_at=body.stop_at) for visit in mission.visits)
    return replace(mission, name=f"{mission.name}, {name}", visits=visits)


@router.post("/sites/{site_id}/missions/import", status_code=201)
def import_mission(station: TheStation, site_id: PathId, body: GeoJson) -> MissionDocument:
    """Store a mission from GeoJSON."""
    site = station.sites.get(site_id).site
    imported = geojson.mission_from_geojson(check_text(body), site)
    return station.missions.create(site_id, check_mission(imported))


@router.post("/sites/{site_id}/preview")
def preview_mission(station: TheStation, site_id: PathId, body: PreviewRequest) -> Preview:
    """What would be driven, or every reason why it cannot be."""
    site, (trunks, _) = station.sites.get(site_id).site, station.trunk_maps.get(site_id)
    return planner.preview(site, check_mission(body.mission), station.vehicle, trunks)


@router.get("/missions/{mission_id}")
def read_mission(station: TheStation, mission_id: PathId) -> MissionDocument:
    """One mission."""
    return station.missions.get(mission_id)


@router.put("/missions/{mission_id}")
def update_mission(station: TheStation, mission_id: PathId, body: MissionEdit) -> MissionDocument:
    """Replace the mission; 409 if it was changed since `version`. A running copy is not touched."""
    return station.missions.update(mission_id, body.version, check_mission(body.mission))


@router.delete("/missions/{mission_id}", status_code=204)
def delete_mission(station: TheStation, mission_id: PathId) -> None:
    """Delete a mission. Its runs stay."""
    station.missions.delete(mission_id)


@router.get("/missions/{mission_id}/geojson", response_model=dict[str, Any])
def export_mission(station: TheStation, mission_id: PathId, response: Response) -> dict[str, Any]:
    """The mission as GeoJSON."""
    document = station.missions.get(mission_id)
    response.headers["Content-Disposition"] = f'attachment; filename="mission-{mission_id}.geojson"'
    return geojson.mission_to_geojson(document.mission, station.sites.get(document.site_id).site)

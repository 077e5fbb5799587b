"""The trunk map of a site: shown, taken home, thrown away, and grown by a run."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Path, Response

from backend.deps import ERRORS, PathId, TheStation
from backend.schemas import TrunkAddress, TrunkDocument, TrunkMapDocument, TrunksMapped
from backend.site_files import check_text
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_export import trunks_to_csv, trunks_to_geojson
from navcore.maps.trunk_import import import_trunks
from navcore.maps.trunk_map import TrunkMap, trunks_of_row

router = APIRouter(prefix="/api", tags=["trunks"], responses=ERRORS)
TrunkId = Annotated[str, Path(pattern=r"^[\w .:+-]{1,200}$")]
GeoJson = Annotated[dict[str, Any], Body(description="GeoJSON FeatureCollection of points")]


@router.get("/sites/{site_id}/trunks")
def read_trunks(station: TheStation, site_id: PathId) -> TrunkMapDocument:
    """All trunks known of a site, with their addresses in its rows; none before the first run with a 2D LiDAR."""
    trunk_map, runs = station.trunk_maps.get(site_id)
    return _document(trunk_map, station.sites.get(site_id).site, runs)


@router.delete("/sites/{site_id}/trunks", status_code=204)
def delete_trunks(station: TheStation, site_id: PathId) -> None:
    """Throw the trunk map away; runs can be mapped again."""
    station.trunk_maps.delete(site_id)


@router.get("/sites/{site_id}/trunks/geojson", response_model=dict[str, Any])
def export_geojson(station: TheStation, site_id: PathId, response: Response) -> dict[str, Any]:
    """The trunk map as GeoJSON."""
    response.headers["Content-Disposition"] = f'attachment; filename="trunks-{site_id}.geojson"'
    return trunks_to_geojson(station.trunk_maps.get(site_id)[0], station.sites.get(site_id).site)


@router.put("/sites/{site_id}/trunks/geojson")
def import_geojson(station: TheStation, site_id: PathId, body: GeoJson) -> TrunkMapDocument:
    """Put a GeoJSON file in the place of the trunk map; every problem at once, and then nothing is changed."""
    site = station.sites.get(site_id).site
    station.trunk_maps.put(site_id, import_trunks(check_text(body), site))
    return read_trunks(station, site_id)


@router.delete("/sites/{site_id}/trunks/{trunk_id}", status_code=204)
def delete_trunk(station: TheStation, site_id: PathId, trunk_id: TrunkId) -> None:
    """Take one trunk off the map: a stake, or a tree that was felled."""
    station.trunk_maps.remove(site_id, trunk_id)


@router.get("/sites/{site_id}/trunks/csv", response_class=Response, responses={200: {"content": {"text/csv": {}}}})
def export_csv(station: TheStation, site_id: PathId) -> Response:
    """The trunk map as CSV."""
    text = trunks_to_csv(station.trunk_maps.get(site_id)[0], station.sites.get(site_id).site)
    disposition = f'attachment; filename="trunks-{site_id}.csv"'
    return Response(text, media_type="text/csv", headers={"Content-Disposition": disposition})


@router.post("/runs/{run_id}/trunks")
def map_trunks(station: TheStation, run_id: PathId) -> TrunksMapped:
    """Take what a run saw into its site's trunk map; each run counts once."""
    return station.mapper.map(run_id)


def _document(trunk_map: TrunkMap, site: SiteMap, runs: int) -> TrunkMapDocument:
    addresses: dict[str, list[TrunkAddress]] = {}
    for row in site.rows:
        for t in trunks_of_row(trunk_map, row):
            address = TrunkAddress(
                row_id=row.id, row_name=row.name or row.id, name=t.name, side=t.side, number=t.number, of=t.of
            )
            addresses.setdefault(t.trunk.id, []).append(address)
    trunks = [
        TrunkDocument(
            id=t.id, x=t.x, y=t.y, std=t.std, diameter=t.diameter, times_seen=t.times_seen,
            addresses=addresses.get(t.id, []),
        )
        for t in trunk_map.trunks
    ]  # fmt: skip
    return TrunkMapDocument(trunks=trunks, runs=runs)

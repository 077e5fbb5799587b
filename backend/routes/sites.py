"""Sites: list, draw, import, export."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Body, Response

from backend.deps import ERRORS, PathId, TheStation
from backend.drawn import check_site
from backend.schemas import ImportedSite, SiteCreate, SiteDocument, SiteEdit, SiteSummary
from backend.site_files import check_text
from navcore.maps import geojson

router = APIRouter(prefix="/api/sites", tags=["sites"], responses=ERRORS)
GeoJson = Annotated[dict[str, Any], Body(description="GeoJSON FeatureCollection")]


@router.get("")
def list_sites(station: TheStation) -> list[SiteSummary]:
    """All sites, by name."""
    return station.sites.all()


@router.post("", status_code=201)
def create_site(station: TheStation, body: SiteCreate) -> SiteDocument:
    """A new site without a picture."""
    return station.sites.create(check_site(body.site))


@router.post("/import", status_code=201)
def import_site(station: TheStation, body: GeoJson) -> ImportedSite:
    """A new site from GeoJSON, with what was noticed and put right on the way."""
    imported = geojson.import_site(check_text(body))
    document = station.sites.create(check_site(imported.site))
    return ImportedSite(**document.model_dump(exclude={"site"}), site=document.site, notes=list(imported.notes))


@router.get("/{site_id}")
def read_site(station: TheStation, site_id: PathId) -> SiteDocument:
    """One site."""
    return station.sites.get(site_id)


@router.put("/{site_id}")
def update_site(station: TheStation, site_id: PathId, body: SiteEdit) -> SiteDocument:
    """Replace the site map; 409 if it was changed since `version`."""
    return station.sites.update(site_id, body.version, check_site(body.site))


@router.delete("/{site_id}", status_code=204)
def delete_site(station: TheStation, site_id: PathId) -> None:
    """Delete a site, its missions, its picture and its 3D maps. Runs stay."""
    picture = station.sites.delete(site_id)
    station.map3d_jobs.stop_site(site_id)
    station.map3d_in_use.stop(site_id)
    station.maps3d.delete_site(site_id)
    if picture is not None:
        station.pictures.delete(picture)


@router.get("/{site_id}/geojson", response_model=dict[str, Any])
def export_site(station: TheStation, site_id: PathId, response: Response) -> dict[str, Any]:
    """The site as GeoJSON."""
    response.headers["Content-Disposition"] = f'attachment; filename="site-{site_id}.geojson"'
    return geojson.site_to_geojson(station.sites.get(site_id).site)

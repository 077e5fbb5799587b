"""`rowpilot vectormap`: rows, headlands, lanes and turns of a 3D map, as the site map that missions use."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.mapping.row_map.row_map import RowMap
    from navcore.mapping.trellis.ground_model import GroundModel
    from navcore.maps.site_map import SiteMap
    from navcore.maps.vector_map.vector_map import VectorMap

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("vectormap")(vectormap)


def vectormap(
    maps: Annotated[
        list[Path],
        typer.Argument(metavar="MAP...", help="3D maps of one block (.pcd, .ply, .las, .laz), the newest last."),
    ],
    site: Annotated[
        Path | None, typer.Option(help="Farm (.geojson, or a site as JSON) that the findings are added to.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Write the map: .geojson for a site, .osm for Lanelet2.")] = None,
    vehicle: Annotated[str, typer.Option(help="Robot whose turns are drawn.")] = "paper_a",
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """Find rows, headlands, lanes and U turns in a 3D map, or in several of different seasons."""
    from navcore.errors import InputError

    try:
        farm = _site(site, out)
        found, vector_map, ground = _found(maps, farm, vehicle)
        if out is not None:
            _write(out, vector_map, ground)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    typer.echo(_json(found, vector_map) if as_json else _table(found, vector_map))


def _site(path: Path | None, out: Path | None) -> SiteMap | None:
    import json

    from navcore.errors import InputError, SiteError
    from navcore.maps.geojson import import_site
    from navcore.runtime.site_file import read_site

    if path is None:
        if out is not None:
            raise InputError("A map file needs a place on the Earth: give the farm with --site.")
        return None
    if path.suffix.lower() != ".geojson":
        return read_site(path)
    try:
        return import_site(json.loads(path.read_bytes())).site
    except OSError as error:
        raise SiteError(f"The site {path.name} cannot be read: {error.strerror}.") from error
    except ValueError as error:
        raise SiteError(f"The site {path.name} is no JSON. Choose a GeoJSON file.") from error


def _found(maps: list[Path], farm: SiteMap | None, vehicle: str) -> tuple[RowMap, VectorMap, GroundModel]:
    from dataclasses import replace

    from navcore.errors import ConfigError
    from navcore.mapping.row_map.cloud_in_map import read_seen_cloud
    from navcore.mapping.row_map.map_rows import map_rows
    from navcore.mapping.row_map.row_map import added
    from navcore.mapping.row_map.u_turns import u_turns
    from navcore.maps.site_map import Datum, SiteMap
    from navcore.maps.vector_map.from_site import vector_map_of
    from navcore.vehicle import PROFILES

    if vehicle not in PROFILES:
        raise ConfigError(f"There is no vehicle {vehicle}. Choose one of {', '.join(sorted(PROFILES))}.")
    datum = farm.datum if farm else None
    clouds, notes = zip(*(read_seen_cloud(path, datum) for path in maps), strict=True)
    found, trellis = map_rows(clouds, tell=lambda line: typer.echo(line, err=True))
    found = replace(found, notes=(*found.notes, *notes))
    nowhere = SiteMap(name="Mapped farm", datum=Datum(lat_deg=0.0, lon_deg=0.0, height_m=0.0))
    site = added(farm or nowhere, found)
    return found, vector_map_of(site, u_turns(site, PROFILES[vehicle])), trellis.ground


def _write(out: Path, vector_map: VectorMap, ground: GroundModel) -> None:
    import json

    from navcore.errors import InputError
    from navcore.maps.vector_map.lanelet_export import vector_map_to_osm
    from navcore.maps.vector_map.vector_geojson import vector_map_to_geojson

    if out.suffix.lower() == ".osm":
        data = vector_map_to_osm(vector_map, ground.seen_at)
    elif out.suffix.lower() in (".geojson", ".json"):
        data = json.dumps(vector_map_to_geojson(vector_map), allow_nan=False).encode()
    else:
        raise InputError(f"{out} must end in .geojson or in .osm.")
    try:
        out.write_bytes(data)
    except OSError as error:
        raise InputError(f"{out} cannot be written: {error.strerror}.") from error


def _json(found: RowMap, vector_map: VectorMap) -> str:
    import dataclasses
    import json

    from navcore.maps.vector_map.to_site import turns_of

    turns = [dataclasses.asdict(turn) for turn in turns_of(vector_map)]
    return json.dumps({**dataclasses.asdict(found), "u_turns": turns}, indent=1, allow_nan=False)


def _table(found: RowMap, vector_map: VectorMap) -> str:
    import math

    from navcore.maps.vector_map.vector_map import LaneKind

    lines = [*found.notes]
    lines += [
        f"  {row.name:<10} {math.dist(row.start, row.end):6.2f} m long, {row.width:.2f} m wide, a post every "
        f"{row.post_spacing:.2f} m"
        for row in found.rows
    ]
    lines.append(
        f"{len(found.zones)} headlands and zones, {len(found.lanes)} lanes, "
        f"{len(vector_map.of_kind(LaneKind.U_TURN))} U turns."
    )
    return "\n".join(lines)

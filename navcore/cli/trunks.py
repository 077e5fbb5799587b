"""`rowpilot trunks`: the trunk map of a run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.maps.site_map import SiteMap
    from navcore.maps.trunk_map import TrunkMap

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("trunks")(trunks)


def trunks(
    log: Annotated[Path, typer.Argument(metavar="RUN", help="Log of a run (.mcap).")],
    site: Annotated[
        Path | None,
        typer.Option(help="Site as JSON; else the one that the log says the run was started with."),
    ] = None,
    known: Annotated[Path | None, typer.Option(help="Trunk map (GeoJSON) that the run's is added to.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
    csv: Annotated[Path | None, typer.Option(help="Write the map as CSV.")] = None,
    geojson: Annotated[Path | None, typer.Option(help="Write the map as GeoJSON.")] = None,
) -> None:
    """Map the trunks and posts that a run with a 2D LiDAR saw along its rows."""
    from navcore.errors import InputError

    try:
        farm = _site(log, site)
        found = _map(log, farm, known)
        _write(found, farm, csv, geojson)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    typer.echo(_json(found, farm) if as_json else _table(found, farm))


def _site(log: Path, site: Path | None) -> SiteMap:
    from navcore.recording.reader import read_farm
    from navcore.runtime.site_file import read_site

    return read_farm(log) if site is None else read_site(site)


def _map(log: Path, farm: SiteMap, known: Path | None) -> TrunkMap:
    import json

    from navcore.errors import SiteError
    from navcore.mapping.merged_runs import merged
    from navcore.mapping.trunks_seen import trunks_seen
    from navcore.maps.trunk_import import import_trunks

    if known is None:
        return trunks_seen(log, farm.rows)
    try:
        document = json.loads(known.read_bytes())
    except OSError as error:
        raise SiteError(f"The trunk map {known.name} cannot be read: {error.strerror}.") from error
    except ValueError as error:
        raise SiteError(f"The trunk map {known.name} is no JSON. Choose a GeoJSON file of trunks.") from error
    return merged(import_trunks(document, farm), trunks_seen(log, farm.rows))


def _write(found: TrunkMap, farm: SiteMap, csv: Path | None, geojson: Path | None) -> None:
    import json

    from navcore.errors import InputError
    from navcore.maps.trunk_export import trunks_to_csv, trunks_to_geojson

    try:
        if csv is not None:
            csv.write_text(trunks_to_csv(found, farm))
        if geojson is not None:
            geojson.write_text(json.dumps(trunks_to_geojson(found, farm), allow_nan=False))
    except OSError as error:
        raise InputError(f"The trunk map cannot be written: {error.strerror}.") from error


def _json(found: TrunkMap, farm: SiteMap) -> str:
    import dataclasses
    import json

    from navcore.maps.trunk_map import trunks_of_row

    rows = {row.id: [dataclasses.asdict(t) for t in trunks_of_row(found, row)] for row in farm.rows}
    return json.dumps({"trunks": len(found.trunks), "rows": rows}, indent=1, allow_nan=False)


def _table(found: TrunkMap, farm: SiteMap) -> str:
    from navcore.maps.trunk_map import trunks_of_row

    if not found.trunks:
        return "No trunks: the run saw no row with a 2D LiDAR."
    lines = [f"{len(found.trunks)} trunks and posts"]
    for row in farm.rows:
        placed = trunks_of_row(found, row)
        lines += [f"{row.name or row.id}: {len(placed)}"] if placed else []
        lines += [
            f"  {t.name:<24} {t.along:7.2f} m along, {100 * t.trunk.diameter:4.1f} cm, +-{100 * t.trunk.std:.0f} cm, "
            f"seen in {t.trunk.times_seen} run{'s' if t.trunk.times_seen > 1 else ''}"
            for t in placed
        ]
    return "\n".join(lines)

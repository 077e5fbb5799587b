"""`rowpilot scan`: what the LiDAR's part of row perception makes of any recorded scan."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from navcore.cli.scan_files import RecordedScan
    from navcore.perception.scan.scan_clusters import ScanClusters, ScanTrunks
    from navcore.perception.scan.walls import Wall

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("scan")(scan)


def scan(
    file: Annotated[
        Path,
        typer.Argument(
            help="CSV of rays (angle_deg,distance_m), JSON of points by sensor, or 3D points (PCD, PLY, LAS, LAZ) "
            "and captured packets, of which one ring is taken."
        ),
    ],
    elevation: Annotated[float, typer.Option(min=-60.0, max=60.0, help="Of that ring, deg.")] = 0.0,
    far: Annotated[float, typer.Option(min=0.5, max=100.0, help="Things further away are passed over, m.")] = 12.0,
    thickest: Annotated[float, typer.Option(min=0.05, max=2.0, help="Of a trunk or a post, m.")] = 0.4,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON list, an object for each scan.")] = False,
    out: Annotated[
        Path | None, typer.Option(help="Folder for a drawing of each scan from above, made if there is none.")
    ] = None,
) -> None:
    """Look for trunks, posts and straight walls in a recorded scan, without a station."""
    import json

    from navcore.cli.scan_files import scans_in
    from navcore.errors import InputError
    from navcore.perception.scan.scan_clusters import ScanClusterParams, ScanClusters

    clusters, records = ScanClusters(ScanClusterParams(far=far, thickest=thickest)), []
    try:
        for number, found in enumerate(scans_in(file, math.radians(elevation)), start=1):
            records.append(_record(found, clusters, _picture(out, number)))
            if not as_json:
                typer.echo("\n".join(_lines(records[-1])))
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    if as_json:
        typer.echo(json.dumps(records, indent=1, allow_nan=False))


def _picture(folder: Path | None, number: int) -> Path | None:
    from navcore.errors import InputError

    if folder is None:
        return None
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The drawings cannot be put into {folder}: {error.strerror}.") from error
    return folder / f"scan-{number:04d}.png"


def _record(found: RecordedScan, clusters: ScanClusters, picture: Path | None) -> dict[str, Any]:
    from navcore.cli.scan_drawing import draw_scan
    from navcore.perception.scan.walls import walls

    straight = walls(found.angles, found.distances)
    trunks = clusters.find(found.angles, found.distances)
    if picture is not None:
        draw_scan(picture, found, straight, trunks)
    return {
        "scan": found.name, "rays": len(found.angles), "walls": [_wall(wall) for wall in straight],
        "uprights": _uprights(trunks),
    }  # fmt: skip


def _wall(wall: Wall) -> dict[str, Any]:
    ends = [[round(v, 4) for v in end] for end in wall.ends]
    return {"ends_m": ends, "length_m": round(wall.length, 3), "points": wall.points, "rms_m": round(wall.rms, 4)}


def _uprights(trunks: ScanTrunks) -> list[dict[str, Any]]:
    """Nearest first."""
    rows = zip(
        trunks.bearing, trunks.range, trunks.diameter, trunks.diameter_std, trunks.rays, trunks.cut, strict=True
    )
    return [
        {
            "x_m": round(float(away * math.cos(bearing)), 4), "y_m": round(float(away * math.sin(bearing)), 4),
            "diameter_m": round(float(thick), 4), "diameter_std_m": round(float(std), 4), "rays": int(rays),
            "partly_hidden": bool(cut),
        }
        for bearing, away, thick, std, rays, cut in sorted(rows, key=lambda row: float(row[1]))
    ]  # fmt: skip


def _lines(record: dict[str, Any]) -> Iterator[str]:
    yield f"{record['scan']}: {record['rays']} rays came back"
    for wall in record["walls"]:
        (x0, y0), (x1, y1) = wall["ends_m"]
        yield (
            f"  wall {wall['length_m']:6.2f} m long, from ({x0:6.2f}, {y0:6.2f}) to ({x1:6.2f}, {y1:6.2f}) m, "
            f"{wall['points']} points within {100 * wall['rms_m']:.1f} cm RMS"
        )
    for thing in record["uprights"]:
        hidden = ", partly hidden" if thing["partly_hidden"] else ""
        yield (
            f"  upright {100 * thing['diameter_m']:5.1f} cm thick at ({thing['x_m']:6.2f}, {thing['y_m']:6.2f}) m, "
            f"{thing['rays']} rays{hidden}"
        )
    if not record["walls"] and not record["uprights"]:
        yield "  nothing straight, and nothing of the size of a trunk or a post"

"""`rowpilot map`: the 3D map of a run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.mapping.lidar3d.map_maker import MadeMap
    from navcore.mapping.lidar3d.map_report import MapReport

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("map")(make_map)


def make_map(
    log: Annotated[Path, typer.Argument(metavar="RUN", help="Log of a run with a 3D LiDAR (.mcap).")],
    out: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Where the map goes; else beside the log, as RUN-map.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
    progress_json: Annotated[bool, typer.Option(help="Progress as a line of JSON each, for programs.")] = False,
    gently: Annotated[bool, typer.Option(help="Only with what other programs leave of the processor.")] = False,
) -> None:
    """Make one NDT map and one cloud of a run's 3D LiDAR. Killed, it goes on where it was when called again."""
    import os

    from navcore.errors import RowpilotError

    if gently:
        os.nice(19)
    folder = out or log.with_name(f"{log.stem}-map")
    try:
        made, written = _make(log, folder, _told_as_json if progress_json else _told())
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    except KeyboardInterrupt:
        typer.echo("\nStopped. Call it again to go on.", err=True)
        raise typer.Exit(130) from None
    typer.echo(_json(made.report, written) if as_json else _words(made.report, written))


def _make(log: Path, folder: Path, tell: Callable[[float, str], None]) -> tuple[MadeMap, list[Path]]:
    from navcore.mapping.lidar3d.log_drive import log_drive
    from navcore.mapping.lidar3d.map_maker import MapMaker, MapMakerParams
    from navcore.mapping.lidar3d.map_output import write_map
    from navcore.mapping.lidar3d.work_folder import WorkFolder

    drive, params = log_drive(log), MapMakerParams()
    work = WorkFolder(folder / "keyframes", drive.name, repr((drive.rig, drive.datum, params.keyframes)))
    made = MapMaker(drive, work, params, tell).make()
    written = write_map(folder, made)
    work.delete()
    return made, written


def _told() -> Callable[[float, str], None]:
    """One line that is written anew; only what changed is, so that a file of it stays short."""
    last = ""

    def tell(share: float, words: str) -> None:
        nonlocal last
        line = f"{share:4.0%}  {words}"
        if line != last:
            typer.echo(f"\r{line:<78}", err=True, nl=share >= 1.0)
            last = line

    return tell


def _told_as_json(share: float, words: str) -> None:
    import json

    typer.echo(json.dumps({"progress": round(share, 3), "message": words}), err=True)


def _json(report: MapReport, written: list[Path]) -> str:
    import dataclasses
    import json

    return json.dumps({**dataclasses.asdict(report), "files": [str(p) for p in written]}, indent=1, allow_nan=False)


def _words(r: MapReport, written: list[Path]) -> str:
    georeferenced = "georeferenced" if r.georeferenced else "not georeferenced"
    fixes = "" if r.fix_rms is None else f", fixes fit within {100 * r.fix_rms:.1f} cm (RMS)"
    loops = "" if r.loop_rms is None else f" and fit within {100 * r.loop_rms:.1f} cm (RMS)"
    refused = ", ".join(f"{n} {why}" for why, n in r.loops_refused.items())
    lines = [
        f"{r.drive}: {r.driven:.0f} m, {r.turns} turns, {r.keyframes} keyframes, {r.hectares:.2f} ha",
        f"The map is {georeferenced}",
        f"RTK at {r.rtk_share:.0%} of the keyframes{fixes}; {r.fixes_doubted} fixes not believed",
        f"Passed twice: {r.loops_taken} loops believed{loops}; refused: {refused or 'none'}",
        f"Map: {r.cells} cells, {r.map_bytes / 1e6:.1f} MB in memory; cloud: {r.points} points",
        *(f"! {doubt}" for doubt in r.doubts),
        *(str(path) for path in written),
    ]
    return "\n".join(lines)

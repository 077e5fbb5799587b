"""`rowpilot decode rplidar`: what the driver makes of an RPLIDAR's recorded bytes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.cli.decode import BAD_INPUT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from navcore.drivers.rplidar.rays import Rays
    from navcore.drivers.rplidar.revolutions import Revolution
    from navcore.drivers.rplidar.stream import RplidarStream

PORTION = 65_536


def register(decode_app: typer.Typer) -> None:
    """Add the verb."""
    decode_app.command("rplidar")(decode_rplidar)


def decode_rplidar(
    file: Annotated[Path, typer.Argument(help="Bytes of its port, from before its scan was started.")],
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, with every ray of every turn.")] = False,
) -> None:
    """One row per turn of the sensor: rays, those with an echo, nearest and furthest distance; then the device's
    answers, and what was passed over and why."""
    from navcore.drivers.rplidar.stream import RplidarStream

    stream = RplidarStream()
    try:
        turns = list(_turns(file, stream))
    except OSError as error:
        typer.echo(f"{file} cannot be read: {error.strerror or error}.", err=True)
        raise typer.Exit(BAD_INPUT) from None
    if stream.kind is None and not turns and stream.info is None and stream.health is None:
        typer.echo(
            f"{file} holds no answer of an RPLIDAR: record its port from before the scan is started.", err=True
        )
        raise typer.Exit(BAD_INPUT)
    for line in _json(turns, stream) if as_json else _table(turns, stream):
        typer.echo(line)


def _turns(file: Path, stream: RplidarStream) -> Iterator[Revolution]:
    from navcore.drivers.rplidar.revolutions import Revolutions

    gathered = Revolutions()
    with file.open("rb") as source:
        while data := source.read(PORTION):
            for rays in stream.feed(data):
                yield from gathered.add(rays, 0)


def _json(turns: list[Revolution], stream: RplidarStream) -> Iterator[str]:
    import json
    from dataclasses import asdict

    rest = {
        "turns": [_rays(turn.rays) for turn in turns],
        "format": stream.kind.name.lower() if stream.kind else None,
        "info": asdict(stream.info) if stream.info else None,
        "health": asdict(stream.health) if stream.health else None,
        "refused": {str(reason): count for reason, count in stream.refused.items()},
    }
    yield json.dumps(rest, allow_nan=False)


def _rays(rays: Rays) -> dict[str, list[float]]:
    return {
        "angle_rad": rays.angle.round(6).tolist(), "distance_m": rays.distance.round(5).tolist(),
        "quality": rays.quality.tolist(),
    }  # fmt: skip


def _table(turns: list[Revolution], stream: RplidarStream) -> Iterator[str]:
    yield f"{'turn':>6}  {'rays':>6}  {'echoes':>6}  {'nearest (m)':>11}  {'furthest (m)':>12}"
    for number, turn in enumerate(turns, start=1):
        met = turn.rays.distance[turn.rays.distance > 0.0]
        span = f"{met.min():11.3f}  {met.max():12.3f}" if len(met) else f"{'-':>11}  {'-':>12}"
        yield f"{number:6d}  {len(turn.rays.angle):6d}  {len(met):6d}  {span}"
    kind = f"format {stream.kind.name.lower()}" if stream.kind else "no rays stream at its end"
    yield f"{len(turns)} whole turns, {kind}"
    if stream.info:
        major, minor = stream.info.firmware
        yield f"model {stream.info.model}, firmware {major}.{minor}, serial number {stream.info.serial}"
    if stream.health:
        yield stream.health.words
    for reason, count in stream.refused.items():
        yield f"passed over: {count}: {reason}"

"""`rowpilot decode lidar3d`: what the driver makes of a 3D LiDAR's captured packets."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.cli.decode import BAD_INPUT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from navcore.drivers.lidar3d.capture_turns import CaptureTurns
    from navcore.drivers.lidar3d.models import LidarModel
    from navcore.drivers.lidar3d.turns import Turn


def register(decode_app: typer.Typer) -> None:
    """Add the verb."""
    decode_app.command("lidar3d")(decode_lidar3d)


def decode_lidar3d(
    file: Annotated[Path, typer.Argument(help="Capture of its UDP packets: pcap or pcapng.")],
    model: Annotated[
        str, typer.Option(help="vlp16, c16 or c16-fine; needed for a C16 whose device packets were not captured.")
    ] = "",
    sender: Annotated[str, typer.Option(help="Address of the LiDAR, where the capture holds several.")] = "",
    output: Annotated[
        Path | None, typer.Option(help="New folder for the turns' points, one PCD file each, in the sensor's frame.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, with the same figures.")] = False,
) -> None:
    """One row per turn of the head: when it ended, how long it took, points, nearest and furthest distance, lost
    packets; then what the LiDAR tells of itself, and what was passed over and why."""
    from navcore.drivers.lidar3d.capture_turns import CaptureTurns
    from navcore.errors import InputError

    try:
        folder = _new_folder(output)
        capture = CaptureTurns(file, _model(model), sender, incomplete=True)
        figures = _figures(capture, folder)
        for line in _json(capture, figures) if as_json else _table(capture, figures):
            typer.echo(line)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None


def _model(name: str) -> LidarModel | None:
    from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams

    return Lidar3dParams(model=name).lidar_model() if name else None


def _new_folder(output: Path | None) -> Path | None:
    """Raises LogError for one that holds something already."""
    from navcore.errors import LogError

    try:
        if output is not None:
            output.mkdir(parents=True, exist_ok=True)
            if any(output.iterdir()):
                raise LogError(f"{output} holds files already; name a new folder.")
    except OSError as error:
        raise LogError(f"{output} cannot be written to: {error.strerror or error}.") from error
    return output


def _figures(capture: CaptureTurns, folder: Path | None) -> list[dict[str, float]]:
    """Of each turn, whose points are not kept."""
    from navcore.maps.cloud_files.cloud_file import write_cloud

    found: list[dict[str, float]] = []
    for number, turn in enumerate(capture.turns(), start=1):
        found.append(_figures_of(turn))
        if folder is not None:
            write_cloud(folder / f"turn-{number:06d}.pcd", turn.cloud)
    return found


def _figures_of(turn: Turn) -> dict[str, float]:
    import numpy as np

    far = np.linalg.norm(turn.cloud.points, axis=1)
    found = {"stamp_ns": turn.stamp_ns, "period_s": round(turn.period_s, 6), "points": len(far), "lost": turn.lost,
             "whole": turn.whole}  # fmt: skip
    if len(far):
        found |= {"nearest_m": round(float(far.min()), 4), "furthest_m": round(float(far.max()), 4)}
    return found


def _json(capture: CaptureTurns, figures: list[dict[str, float]]) -> Iterator[str]:
    import json
    from dataclasses import asdict

    stream, device = capture.stream, capture.stream.device
    assert stream.model is not None
    rest = {
        "model": stream.model.name, "sender": capture.sender, "turns": figures, "packets": stream.packets,
        "lost": stream.lost, "refused": {str(reason): count for reason, count in stream.refused.items()},
        "device": asdict(device) | {"utc": str(device.utc or "")} if device else None,
        "position": asdict(stream.position) if stream.position else None, "utc": str(stream.utc or ""),
        "contradiction": stream.contradiction, "others": capture.file.others, "broken": capture.file.broken,
    }  # fmt: skip
    yield json.dumps(rest, allow_nan=False)


def _table(capture: CaptureTurns, figures: list[dict[str, float]]) -> Iterator[str]:
    yield (
        f"{'turn':>6}  {'time (UTC)':>23}  {'took (ms)':>9}  {'points':>6}  {'nearest (m)':>11}  {'furthest (m)':>12}"
        f"  {'lost':>4}"
    )
    for number, turn in enumerate(figures, start=1):
        met = f"{turn['nearest_m']:11.3f}  {turn['furthest_m']:12.3f}" if turn["points"] else f"{'-':>11}  {'-':>12}"
        yield (
            f"{number:6d}  {_moment(int(turn['stamp_ns'])):>23}  {turn['period_s'] * 1e3:9.2f}  {turn['points']:6d}  "
            f"{met}  {turn['lost']:4d}" + ("" if turn["whole"] else "  incomplete")
        )
    whole = sum(1 for turn in figures if turn["whole"])
    yield from _summary(capture, whole, len(figures) - whole)


def _moment(stamp_ns: int) -> str:
    from datetime import UTC, datetime

    return datetime.fromtimestamp(stamp_ns // 1_000_000 / 1000.0, UTC).isoformat(sep=" ", timespec="milliseconds")[
        :23
    ]


def _summary(capture: CaptureTurns, whole: int, incomplete: int) -> Iterator[str]:
    stream = capture.stream
    assert stream.model is not None
    yield (
        f"{whole} whole turns and {incomplete} incomplete ones of a {stream.model.title} at {capture.sender}, "
        f"{stream.packets} packets, {stream.lost} lost"
    )
    if stream.device:
        clock = f"its clock at {stream.device.utc:%Y-%m-%d %H:%M:%S}" if stream.device.utc else "its clock not set"
        yield f"set to {stream.device.rpm} rpm, {clock}"
    if stream.position:
        yield f"GPS: {stream.position.pps}; {stream.position.sentence or 'no sentence'}"
    for reason, count in stream.refused.items():
        yield f"passed over: {count}: {reason}"
    if stream.contradiction:
        yield stream.contradiction
    if capture.file.others:
        yield f"besides: {capture.file.others} packets of other kinds"
    if capture.file.broken:
        yield "the capture is damaged or breaks off; what stands behind that place is not read"

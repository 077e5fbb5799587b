"""`rowpilot decode`: what the parsers make of a recorded log."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.drivers.gnss_log import GnssLog
    from navcore.drivers.nmea_stream import Refusal
    from navcore.messages import GnssFix

decode_app = typer.Typer(help="Show what the parsers make of a recorded log.", no_args_is_help=True)
BAD_INPUT = 2
COLUMNS = (
    "time (UTC)", "lat (deg)", "lon (deg)", "height (m)", "quality", "heading (deg)", "accuracy (m)",
)  # fmt: skip
WIDTHS = (24, 14, 15, 10, 15, 13, 12)


@decode_app.callback()
def verbs() -> None:
    """Keeps `gnss` a verb of its own while it is the only one."""


@decode_app.command("gnss")
def decode_gnss(
    file: Annotated[
        Path, typer.Argument(help="Log of a receiver: NMEA or Unicore text, other bytes in between allowed.")
    ],
    as_json: Annotated[bool, typer.Option("--json", help='One JSON object with "epochs" and "refused".')] = False,
) -> None:
    """One row per epoch: time, latitude, longitude, ellipsoidal height, quality, heading clockwise from true north,
    horizontal accuracy (1 sigma); then what was refused and why."""
    from navcore.drivers.gnss_log import read_gnss_log
    from navcore.errors import InputError

    try:
        log = read_gnss_log(file)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    typer.echo(_json(log) if as_json else _table(log))


def _json(log: GnssLog) -> str:
    import json

    return json.dumps(
        {
            "epochs": [_epoch(fix) for fix in log.epochs],
            "refused": [_refused(refusal) for refusal in log.refused],
            "unused": log.unused,
        },
        indent=1,
        allow_nan=False,
    )


def _epoch(fix: GnssFix) -> dict[str, object]:
    from navcore.drivers.epoch import bearing_of_yaw

    return {
        "time": _time(fix),
        "lat": fix.lat_deg,
        "lon": fix.lon_deg,
        "height": _rounded(fix.height_m, 4),
        "quality": int(fix.quality),
        "heading": None if fix.heading_rad is None else round(bearing_of_yaw(fix.heading_rad), 4) % 360.0,
        "accuracy": _rounded(_accuracy(fix), 4),
        "std_east": fix.std_east_m,
        "std_north": fix.std_north_m,
        "std_up": fix.std_up_m,
        "speed": _rounded(fix.speed, 4),
        "course": None if fix.course_rad is None else round(bearing_of_yaw(fix.course_rad), 4) % 360.0,
        "hdop": fix.hdop,
        "satellites": fix.satellites,
        "correction_age": fix.correction_age_s,
    }


def _refused(refusal: Refusal) -> dict[str, object]:
    return {"reason": str(refusal.reason), "offset": refusal.offset, "text": refusal.text}


def _time(fix: GnssFix) -> str | None:
    from datetime import UTC, datetime

    if fix.utc_s is None:
        return None
    moment = datetime.fromtimestamp(round(fix.utc_s, 3), UTC)
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")


def _accuracy(fix: GnssFix) -> float | None:
    """Horizontal 1 sigma: root of the sum of both variances, as receivers' 2D accuracy."""
    import math

    if fix.std_east_m is None or fix.std_north_m is None:
        return None
    return math.hypot(fix.std_east_m, fix.std_north_m)


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)


def _table(log: GnssLog) -> str:
    rows = [_aligned(COLUMNS), *(_row(_epoch(fix)) for fix in log.epochs)]
    return "\n".join([*rows, "", *_summary(log)])


def _row(epoch: dict[str, object]) -> str:
    from navcore.messages import FixQuality

    def shown(key: str, digits: int) -> str:
        value = epoch[key]
        return f"{value:.{digits}f}" if isinstance(value, float) else "-"

    quality = FixQuality(int(str(epoch["quality"]))).name.lower().replace("_", " ")
    return _aligned(
        (
            str(epoch["time"] or "-"), shown("lat", 9), shown("lon", 9), shown("height", 3),
            f"{epoch['quality']} {quality}", shown("heading", 3), shown("accuracy", 3),
        )
    )  # fmt: skip


def _aligned(cells: tuple[str, ...]) -> str:
    return "  ".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS, strict=True))


def _summary(log: GnssLog) -> list[str]:
    lines = [f"{len(log.epochs)} epochs, {len(log.refused)} refused"]
    lines += [f"  refused at byte {r.offset}: {r.reason}: {r.text}" for r in log.refused]
    if log.unused:
        kinds = ", ".join(f"{kind} {count}" for kind, count in log.unused.items())
        lines.append(f"valid but not needed: {kinds}")
    return lines

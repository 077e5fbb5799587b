"""`rowpilot decode`: what the parsers make of a recorded log."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from navcore.drivers.gnss_log import GnssLog, LoggedEpoch
    from navcore.drivers.nmea_stream import Refusal
    from navcore.messages import GnssFix

decode_app = typer.Typer(help="Show what the parsers make of a recorded log.", no_args_is_help=True)
BAD_INPUT = 2
COLUMNS = (
    "time (UTC)", "lat (deg)", "lon (deg)", "height (m)", "quality", "heading (deg)", "accuracy (m)",
)  # fmt: skip
WIDTHS = (24, 14, 15, 10, 15, 13, 12)


@decode_app.command("gnss")
def decode_gnss(
    file: Annotated[
        Path, typer.Argument(help="Log of a receiver: NMEA or Unicore text, other bytes in between allowed.")
    ],
    as_json: Annotated[bool, typer.Option("--json", help='One JSON object with "epochs" and "refused".')] = False,
) -> None:
    """One row per epoch: time, latitude, longitude, ellipsoidal height, quality, heading clockwise from true north,
    horizontal accuracy (1 sigma); then what was refused and why."""
    from navcore.drivers.gnss_log import GnssLog
    from navcore.errors import InputError

    log = GnssLog(file)
    try:
        for line in _json(log) if as_json else _table(log):
            typer.echo(line)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None


def _json(log: GnssLog) -> Iterator[str]:
    """Line by line, so that memory does not grow with the log; nothing before it is known to be one."""
    head = '{"epochs": ['
    for epoch in log.epochs():
        yield head + _dumped(_epoch(epoch))
        head = ","
    yield (head if head != "," else "") + "],"
    rest = {
        "refused": [_refused(refusal) for refusal in log.refused],
        "refused_counts": {str(reason): count for reason, count in log.refused_counts.items()},
        "unused": log.unused,
    }
    yield _dumped(rest).removeprefix("{")


def _dumped(value: object) -> str:
    import json

    return json.dumps(value, allow_nan=False)


def _epoch(epoch: LoggedEpoch) -> dict[str, object]:
    import math

    from navcore.drivers.epoch import bearing_of_yaw

    fix = epoch.fix
    return {
        "time": _time(epoch),
        "lat": fix.lat_deg,
        "lon": fix.lon_deg,
        "height": _rounded(fix.height_m, 4),
        "quality": int(fix.quality),
        "heading": None if fix.heading_rad is None else round(bearing_of_yaw(fix.heading_rad), 4) % 360.0,
        "heading_std": None if fix.heading_std_rad is None else round(math.degrees(fix.heading_std_rad), 4),
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


def _time(epoch: LoggedEpoch) -> str | None:
    """Date and time, of a log without a date the time of day alone."""
    from datetime import UTC, datetime

    if epoch.fix.utc_s is not None:
        moment = datetime.fromtimestamp(round(epoch.fix.utc_s, 3), UTC)
        return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")
    if epoch.clock_ns is None:
        return None
    seconds, ms = divmod(epoch.clock_ns // 1_000_000, 1000)
    return f"{seconds // 3600:02d}:{seconds // 60 % 60:02d}:{seconds % 60:02d}.{ms:03d}Z"


def _accuracy(fix: GnssFix) -> float | None:
    """Horizontal 1 sigma: root of the sum of both variances, as receivers' 2D accuracy."""
    import math

    if fix.std_east_m is None or fix.std_north_m is None:
        return None
    return math.hypot(fix.std_east_m, fix.std_north_m)


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else round(value, digits)


def _table(log: GnssLog) -> Iterator[str]:
    count = 0
    for count, epoch in enumerate(log.epochs(), start=1):
        if count == 1:
            yield _aligned(COLUMNS)
        yield _row(_epoch(epoch))
    yield from ("", *_summary(log, count)) if count else _summary(log, count)


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


def _summary(log: GnssLog, count: int) -> Iterator[str]:
    yield f"{count} epochs, {log.refused_counts.total()} refused"
    if not count:
        yield "no sentence that is sound tells a time, a position or a heading"
    for refusal in log.refused:
        yield f"  refused at byte {refusal.offset}: {refusal.reason}: {refusal.text}"
    if log.refused_counts.total() > len(log.refused):
        reasons = ", ".join(f"{reason} {number}" for reason, number in log.refused_counts.items())
        yield f"  and more; in all: {reasons}"
    if log.unused:
        kinds = ", ".join(f"{kind} {number}" for kind, number in log.unused.items())
        yield f"valid but not needed: {kinds}"

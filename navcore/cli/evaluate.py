"""`rowpilot evaluate`: what a run was worth."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.bench.evaluate.evaluate import Deviation, Evaluation

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("evaluate")(evaluate_run)


def evaluate_run(
    log: Annotated[Path, typer.Argument(metavar="RUN", help="Log of a run (.mcap).")],
    truth: Annotated[
        Path | None,
        typer.Option(help="True track as CSV: stamp_ns or utc_s; x, y or lat_deg, lon_deg; yaw if known."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
) -> None:
    """Score a run against the truth: of the simulator, as logged, or of a survey given with --truth."""
    from navcore.bench.evaluate.evaluate import evaluate
    from navcore.bench.evaluate.log import read_record
    from navcore.errors import InputError

    try:
        result = evaluate(read_record(log, truth))
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    typer.echo(_json(result) if as_json else _table(result))


def _json(result: Evaluation) -> str:
    import dataclasses
    import json

    return json.dumps(dataclasses.asdict(result), indent=1, allow_nan=False)


def _table(result: Evaluation) -> str:
    line = "true centre line" if result.rows_are_true else "centre line as drawn"
    rows = [
        ("mission", f"{result.state}, {result.duration_s:.0f} s, {result.driven_m:.0f} m"),
        ("on GNSS, from the path", _shown(result.gnss_whole, "m", 3)),
        ("  after the first 10 m", _shown(result.gnss_steady, "m", 3)),
        (f"in rows, from the {line}", _shown(result.row_lateral, "m", 3)),
        ("  heading on the ground", _shown(result.row_heading_deg, "deg", 2)),
        ("  heading in the picture", _shown(result.image_heading_deg, "deg", 2)),
        ("at row entrances", ", ".join(f"{e:.3f} m" for e in result.entry_errors) or "-"),
        ("wrong rows entered", ", ".join(result.wrong_rows) or "none"),
        ("things touched", ", ".join(result.contacts) or "none"),
    ]
    rows += [(f"{s.before} -> {s.after}", _switch(s.lateral_m, s.seconds, s.reason)) for s in result.switches]
    width = max(len(name) for name, _ in rows)
    return "\n".join(f"{name:<{width}}  {value}" for name, value in rows)


def _shown(value: Deviation | None, unit: str, digits: int) -> str:
    if value is None:
        return "-"
    return (
        f"mean {value.mean:.{digits}f} {unit}, 95 % {value.p95:.{digits}f}, largest {value.largest:.{digits}f} "
        f"({value.samples} poses)"
    )


def _switch(lateral_m: float | None, seconds: float | None, reason: str) -> str:
    lateral = "-" if lateral_m is None else f"{lateral_m:.3f} m within 2 m"
    return f"{lateral}, {'no command' if seconds is None else f'{seconds:.2f} s'}: {reason}"

"""`rowpilot bench tracking`: how closely a robot keeps to its path."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from navcore.cli.figure_drawing import draw, drawable
from navcore.cli.figure_lines import lines, report


def register(bench_app: typer.Typer) -> None:
    """Add the verb."""
    bench_app.command("tracking")(bench_tracking)


def bench_tracking(
    quick: Annotated[bool, typer.Option("--quick", help="Two seeds and three controllers: 3 minutes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    resume: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Keep the drives here, and go on with what is here.")
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.svg", callback=drawable, help="Draw the drives: how far off the path along the way."
        ),
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=64, help="Drives side by side.")] = 2,
) -> None:
    """Straight and bent rows and a headland turn at 0.5 to 1.5 m/s: pure pursuit as published, ours, LQR."""
    import tempfile

    from navcore.bench.provenance import commit, machine
    from navcore.bench.tracking.cases import QUICK, Localization, TrackingCaseParams, tracking_cases
    from navcore.bench.tracking.figures import tracking_figures
    from navcore.bench.tracking.plot import tracking_plot
    from navcore.bench.tracking.tracking import drive_all

    folder = resume or Path(tempfile.mkdtemp(prefix="rowpilot-tracking-"))
    typer.echo(f"Drives are kept in {folder}", err=True)
    cases = tracking_cases(QUICK if quick else TrackingCaseParams())
    drives = drive_all(cases, folder, processes, lambda line: typer.echo(line, err=True))
    if plot is not None:
        draw(plot, tracking_plot(drives, Localization.RTK))
    figures, made = tracking_figures(drives), (commit(), machine())
    typer.echo(report(figures, *made) if as_json else lines(figures, *made))

"""`rowpilot bench localization`: where the robot is on a 3D map, in every season."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from navcore.cli.figure_drawing import draw, drawable
from navcore.cli.figure_lines import lines, report


def register(bench_app: typer.Typer) -> None:
    """Add the verb."""
    bench_app.command("localization")(bench_localization)


def bench_localization(
    quick: Annotated[bool, typer.Option("--quick", help="One small block.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    plot: Annotated[
        Path | None,
        typer.Option(metavar="FILE.svg", callback=drawable, help="Draw the errors at the fixed points as box plots."),
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=64, help="Drives side by side.")] = 2,
) -> None:
    """Fixed points by RTK, by a 3D map and by both, winter to full leaf; restarts without GNSS."""
    from navcore.bench.lidar3d.localization import QUICK, LocalizationBenchParams, run_bench
    from navcore.bench.provenance import commit, machine

    found = run_bench(
        QUICK if quick else LocalizationBenchParams(), lambda line: typer.echo(line, err=True), processes
    )
    if plot is not None:
        draw(plot, found.boxes)
    figures = found.figures
    typer.echo(report(figures, commit(), machine()) if as_json else lines(figures, commit(), machine()))

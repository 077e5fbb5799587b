"""`rowpilot bench localization`: where the robot is on a 3D map, in every season."""

from __future__ import annotations

from typing import Annotated

import typer

from navcore.cli.figure_lines import lines, report


def register(bench_app: typer.Typer) -> None:
    """Add the verb."""
    bench_app.command("localization")(bench_localization)


def bench_localization(
    quick: Annotated[bool, typer.Option("--quick", help="One small block.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
) -> None:
    """Fixed points by RTK, by a 3D map and by both, winter to full leaf; restarts without GNSS."""
    from navcore.bench.lidar3d.localization import QUICK, LocalizationBenchParams, run_bench
    from navcore.bench.provenance import commit, machine

    figures = run_bench(QUICK if quick else LocalizationBenchParams(), lambda line: typer.echo(line, err=True))
    typer.echo(report(figures, commit(), machine()) if as_json else lines(figures, commit(), machine()))

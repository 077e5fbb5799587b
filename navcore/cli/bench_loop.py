"""`rowpilot bench loop`: the whole station in real time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.cli.figure_lines import lines, report

if TYPE_CHECKING:
    from navcore.bench.loop.loop import LoopParams, Phase


def register(bench_app: typer.Typer) -> None:
    """Add the verb."""
    bench_app.command("loop")(bench_loop)


def bench_loop(
    quick: Annotated[bool, typer.Option("--quick", help="Two minutes instead of eleven.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    minutes: Annotated[float | None, typer.Option(min=1, help="Of driving, both phases together.")] = None,
    browsers: Annotated[int, typer.Option(min=0, max=8, help="Headless browsers on Drive.")] = 2,
    imports: Annotated[bool, typer.Option(help="Import an orthophoto all the while.")] = True,
    lidar3d: Annotated[
        bool, typer.Option("--lidar3d", help="And once more with a 3D LiDAR and a map in use: twice as long.")
    ] = False,
) -> None:
    """The whole station in real time: ticks, lateness, from picture to CAN frame, from stop click to zero."""
    from dataclasses import replace

    from navcore.bench.loop.loop import QUICK, LoopParams
    from navcore.errors import RowpilotError

    params = replace(QUICK if quick else LoopParams(), browsers=browsers, imports=imports)
    if minutes is not None:
        params = replace(params, phase_s=minutes * 30)
    try:
        _measure(params, as_json, lidar3d=lidar3d)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from None


def _measure(params: LoopParams, as_json: bool, *, lidar3d: bool) -> None:
    import tempfile
    from dataclasses import replace

    from navcore.bench.loop.figures import lidar3d_figures, loop_figures
    from navcore.bench.provenance import commit, machine

    folder = Path(tempfile.mkdtemp(prefix="rowpilot-loop-"))
    typer.echo(f"Database and logs are kept in {folder}", err=True)
    phases = _driven_loop(folder / "plain", params)
    figures = loop_figures(phases)
    if lidar3d:
        figures += lidar3d_figures(_driven_loop(folder / "lidar3d", replace(params, lidar3d=True)), phases)
    typer.echo(report(figures, commit(), machine()) if as_json else lines(figures, commit(), machine()))


def _driven_loop(folder: Path, params: LoopParams) -> tuple[Phase, ...]:
    from contextlib import closing

    from navcore.bench.loop.loop import LoopBench

    with closing(LoopBench(folder, params, lambda line: typer.echo(line, err=True))) as bench:
        return bench.run()

"""`rowpilot bench fusion`: camera and 2D LiDAR, published and ours."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.cli.figure_lines import lines, report

if TYPE_CHECKING:
    from navcore.bench.fusion.segment_cases import Chain

BAD_INPUT = 2


def register(bench_app: typer.Typer) -> None:
    """Add the verb."""
    bench_app.command("fusion")(bench_fusion)


def bench_fusion(
    quick: Annotated[
        bool, typer.Option("--quick", help="Two drives a chain, boxes from the truth (segmentation: pictures).")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    resume: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Keep the drives here, and go on with what is here.")
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=64, help="Drives side by side.")] = 2,
    chain: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help='Drives of this chain alone, as "ours" or "true trunks"; again for more.'),
    ] = None,
) -> None:
    """Camera and 2D LiDAR as in paper B, published and ours: clusters, line fits, trees, drives in its segments."""
    import tempfile
    from dataclasses import replace

    from navcore.bench.fusion.calibration import QUICK, CalibrationBenchParams
    from navcore.bench.fusion.calibration import run_bench as run_calibration
    from navcore.bench.fusion.clusters import RUNS, cluster_figures, runs_of_rays
    from navcore.bench.fusion.figures import drive_figures
    from navcore.bench.fusion.fusion import QUICK_DRIVES, FusionBenchParams, drive_all
    from navcore.bench.fusion.line_fit import line_fit_figures
    from navcore.bench.fusion.look_time import look_time_figures
    from navcore.bench.fusion.segment_cases import Chain, segment_cases
    from navcore.bench.mission.cases import EyeKind
    from navcore.bench.provenance import commit, machine

    def tell(line: str) -> None:
        typer.echo(line, err=True)

    params, chains = FusionBenchParams(processes=processes), _chains(chain)
    if quick:
        params = replace(params, drives=replace(QUICK_DRIVES, eye=EyeKind.TRUTH), scans=60, fits=200)
    folder = resume or Path(tempfile.mkdtemp(prefix="rowpilot-fusion-"))
    tell(f"Drives are kept in {folder}")
    calibrated = run_calibration(QUICK if quick else CalibrationBenchParams(), tell)
    clusters = cluster_figures(rounds=params.scans, others={RUNS: runs_of_rays})
    parts = (*calibrated, *clusters, *line_fit_figures(rounds=params.fits))
    cases = segment_cases(params.drives)
    timed = [case for case in cases if case.chain is Chain.OURS and case.chain in chains]
    looks = look_time_figures(timed[0]) if timed else []
    drives = drive_all([case for case in cases if case.chain in chains], folder, params.processes, tell)
    figures, made = (*parts, *looks, *drive_figures(drives)), (commit(), machine())
    typer.echo(report(figures, *made) if as_json else lines(figures, *made))


def _chains(names: list[str] | None) -> frozenset[Chain]:
    """Those of that name, all if none is given."""
    from navcore.bench.fusion.segment_cases import Chain

    unknown = sorted(set(names or ()) - {str(chain) for chain in Chain})
    if unknown:
        known = ", ".join(f'"{chain}"' for chain in Chain)
        typer.echo(f"There is no chain {', '.join(unknown)}. There are {known}.", err=True)
        raise typer.Exit(BAD_INPUT)
    return frozenset(map(Chain, names)) if names else frozenset(Chain)

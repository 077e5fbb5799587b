"""`rowpilot bench`: figures, each printed by the verb that measures it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from navcore.cli.figure_lines import lines as _lines
from navcore.cli.figure_lines import report as _report

if TYPE_CHECKING:
    from navcore.bench.mission.result import MissionResult

BAD_INPUT = 2
bench_app = typer.Typer(help="Measure the robot.", no_args_is_help=True)


@bench_app.callback()
def verbs() -> None:
    """Keeps each bench a verb of its own."""


@bench_app.command("mission")
def bench_mission(
    quick: Annotated[
        bool, typer.Option("--quick", help="One mission, its ablation, one drive a track: 3 minutes.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    resume: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Keep the missions here, and go on with what is here.")
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=64, help="Missions driven side by side.")] = 2,
    farms: Annotated[
        str, typer.Option(help="scoring, or tuning: farms that parameters may be tuned on.")
    ] = "scoring",
    eye: Annotated[str, typer.Option(help="pixels, or truth: boxes from the truth, faster.")] = "pixels",
) -> None:
    """Whole missions in simulated time on farms unseen in tuning, with everything unkind on, and on GNSS alone."""
    import tempfile

    from navcore.bench.mission.cases import CaseParams, EyeKind, Farms
    from navcore.bench.mission.figures import mission_figures
    from navcore.bench.mission.mission import run_bench
    from navcore.errors import InputError

    try:
        params = CaseParams(source=Farms(farms), eye=EyeKind(eye), quick=quick)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    folder = resume or Path(tempfile.mkdtemp(prefix="rowpilot-bench-"))
    typer.echo(f"Missions are kept in {folder}", err=True)
    try:
        bench = run_bench(params, folder, processes=processes, progress=_progress)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    figures, made = mission_figures(bench.results), (bench.commit, bench.machine)
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


@bench_app.command("detector")
def bench_detector(
    quick: Annotated[bool, typer.Option("--quick", help="A dozen frames per stage and light: 3 minutes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
    variants: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Weights of published detectors: NAME.pt or NAME.onnx.")
    ] = None,
    photographs: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Photographs and labels.json: see those, too.")
    ] = None,
    processes: Annotated[int, typer.Option(min=1, max=64, help="Processes that render.")] = 1,
) -> None:
    """Our detector and the published ones on the same rendered frames of unseen farms, 3 stages x 3 lights."""
    import tempfile
    from dataclasses import replace

    from navcore.bench.detector.detector import QUICK, DetectorBenchParams, run_bench
    from navcore.bench.detector.figures import detector_figures
    from navcore.bench.detector.photographs import photograph_figures
    from navcore.bench.provenance import commit, machine
    from navcore.errors import RowpilotError

    params = QUICK if quick else DetectorBenchParams()
    params = replace(params, variants=variants, frames=replace(params.frames, processes=processes))
    try:
        real = photograph_figures(photographs) if photographs else ()
        with tempfile.TemporaryDirectory(prefix="rowpilot-detector-") as folder:
            result = run_bench(params, Path(folder), lambda line: typer.echo(line, err=True))
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    figures, made = (*detector_figures(result), *real), (commit(), machine())
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


@bench_app.command("rows")
def bench_rows(
    quick: Annotated[bool, typer.Option("--quick", help="A fifth of the frames: a minute or two.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
) -> None:
    """Row fits as published and ours on the same frames: in rows, near their ends, and where there is none."""
    from navcore.bench.provenance import commit, machine
    from navcore.bench.rows.figures import rows_figures
    from navcore.bench.rows.rows import QUICK, RowsBenchParams, run_bench

    result = run_bench(QUICK if quick else RowsBenchParams(), lambda line: typer.echo(line, err=True))
    figures, made = rows_figures(result), (commit(), machine())
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


@bench_app.command("ndt")
def bench_ndt(
    quick: Annotated[bool, typer.Option("--quick", help="One small block, ten scans a season: 3 minutes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
) -> None:
    """A 3D LiDAR's scans laid onto a map of winter: ours, NDT as published and small_gicp, simulated pear blocks."""
    from navcore.bench.lidar3d.ndt import QUICK, NdtBenchParams, run_bench
    from navcore.bench.provenance import commit, machine

    figures = run_bench(QUICK if quick else NdtBenchParams(), lambda line: typer.echo(line, err=True))
    made = (commit(), machine())
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


@bench_app.command("mapping")
def bench_mapping(
    quick: Annotated[bool, typer.Option("--quick", help="One small block: a few minutes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
) -> None:
    """Maps of simulated pear blocks: distances between surveyed posts, scans a second, memory by area."""
    import tempfile

    from navcore.bench.lidar3d.mapping import QUICK, MappingBenchParams, mapping_figures, run_bench
    from navcore.bench.lidar3d.mapping_closure import closure_figures, closures
    from navcore.bench.provenance import commit, machine

    def tell(line: str) -> None:
        typer.echo(line, err=True)

    params = QUICK if quick else MappingBenchParams()
    figures, made = mapping_figures(run_bench(params, tell)), (commit(), machine())
    if params.closure is not None:
        with tempfile.TemporaryDirectory(prefix="rowpilot-closure-") as folder:
            figures += tuple(closure_figures(closures(params.closure, Path(folder), tell)))
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


@bench_app.command("trellis")
def bench_trellis(
    quick: Annotated[bool, typer.Option("--quick", help="A small block, winter and full leaf: two minutes.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="A JSON list, one row a figure.")] = False,
) -> None:
    """Posts, wires and rows found by a 3D LiDAR, season by season, beside the published filters."""
    from navcore.bench.lidar3d.trellis import QUICK, TrellisBenchParams, trellis_figures
    from navcore.bench.provenance import commit, machine

    found = trellis_figures(QUICK if quick else TrellisBenchParams(), lambda line: typer.echo(line, err=True))
    figures, made = tuple(found), (commit(), machine())
    typer.echo(_report(figures, *made) if as_json else _lines(figures, *made))


def _progress(result: MissionResult, left: int) -> None:
    typer.echo(f"{left:4d} left  {result.case.id}: {result.state}{_blemish(result)} {result.why}", err=True)


def _blemish(result: MissionResult) -> str:
    """What spoils a mission that finished."""
    if result.evaluation is None or result.clean:
        return ""
    found = [*result.evaluation.contacts, *(f"wrong row {row}" for row in result.evaluation.wrong_rows)]
    return f" ({', '.join(found)})" if found else ""

"""The `rowpilot` command. Each verb is a thin file over the rooms below."""

from __future__ import annotations

import typer

from navcore.cli import (
    bench_fusion,
    bench_localization,
    bench_loop,
    bench_tracking,
    dataset,
    decode_lidar3d,
    decode_rplidar,
    evaluate,
    export,
    map_run,
    odometry,
    register,
    replay,
    report,
    run,
    scan,
    score,
    see,
    train,
    train_ground,
    trunks,
    vectormap,
)
from navcore.cli.bench import bench_app
from navcore.cli.calibrate import calibrate_app
from navcore.cli.decode import decode_app

app = typer.Typer(
    name="rowpilot", help="Onboard operator station for orchard and vineyard robots.", no_args_is_help=True
)
bench_fusion.register(bench_app)
bench_localization.register(bench_app)
bench_loop.register(bench_app)
bench_tracking.register(bench_app)
app.add_typer(bench_app, name="bench")
app.add_typer(calibrate_app, name="calibrate")
decode_rplidar.register(decode_app)
decode_lidar3d.register(decode_app)
app.add_typer(decode_app, name="decode")
dataset.register(app)
evaluate.register(app)
train.register(app)
train_ground.register(app)
export.register(app)
run.register(app)
replay.register(app)
see.register(app)
scan.register(app)
score.register(app)
report.register(app)
trunks.register(app)
register.register(app)
odometry.register(app)
map_run.register(app)
vectormap.register(app)


@app.callback()
def rowpilot() -> None:
    """Onboard operator station for orchard and vineyard robots."""


def main() -> None:
    """Entry point of the `rowpilot` command."""
    app()

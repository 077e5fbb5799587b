"""`rowpilot odometry`: where a 3D LiDAR went, from its scans alone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from navcore.geometry.point_cloud import PointCloud
    from navcore.geometry.se3 import SE3

BAD_INPUT = 2
_CAPTURES = (".pcap", ".pcapng", ".cap")


class Scan(NamedTuple):
    """A cloud and when its last point was taken, s."""

    seconds: float
    cloud: PointCloud


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("odometry")(odometry)


def odometry(
    scans: Annotated[
        Path, typer.Argument(metavar="FOLDER|PCAP", help="Files of clouds in their order, or a capture.")
    ],
    output: Annotated[Path | None, typer.Option(help="File for the trajectory; printed without.")] = None,
    period: Annotated[float, typer.Option(min=0.01, max=10.0, help="Between two files, s.")] = 0.1,
    model: Annotated[str, typer.Option(help="Of the LiDAR, if its packets do not tell: vlp16, c16, c16-fine.")] = "",
) -> None:
    """A trajectory in TUM form: time, s, position, m, and quaternion x y z w, in the frame of the first scan.

    What could not be matched is told on the error stream; its pose goes on as the ones before.
    """
    from navcore.errors import RowpilotError

    try:
        lines = list(_trajectory(scans, period, model))
        if output is not None:
            output.write_text("\n".join(lines) + "\n")
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    except OSError as error:
        typer.echo(f"{output} cannot be written: {error.strerror or error}.", err=True)
        raise typer.Exit(BAD_INPUT) from None
    if output is None:
        typer.echo("\n".join(lines))


def _trajectory(path: Path, period: float, model: str) -> Iterator[str]:
    from navcore.errors import CloudError
    from navcore.localization.ndt.ndt_odometry import NdtOdometry

    engine, before, unmatched, count = NdtOdometry(), None, 0, 0
    for scan in _capture(path, model) if path.suffix.lower() in _CAPTURES else _folder(path, period):
        step = engine.step(scan.cloud, period if before is None else max(1e-3, scan.seconds - before))
        before, count = scan.seconds, count + 1
        if step.registration is not None and step.registration.reason is not None:
            unmatched += 1
            typer.echo(f"{scan.seconds:.3f} s: {step.registration.reason}", err=True)
        yield _tum(scan.seconds, step.T_odom_lidar)
    if not count:
        raise CloudError(f"{path} holds no scan; give a folder of .pcd, .ply, .las, .laz or .bin files.")
    typer.echo(f"{count} scans, {unmatched} of them not matched", err=True)


def _folder(folder: Path, period: float) -> Iterator[Scan]:
    """Its clouds by name, numbers by their value."""
    import re

    from navcore.errors import CloudError
    from navcore.maps.cloud_files.cloud_endings import CLOUD_ENDINGS
    from navcore.maps.cloud_files.cloud_file import read_cloud

    if not folder.is_dir():
        raise CloudError(f"{folder} is no folder and no capture ({', '.join(_CAPTURES)}); give one of the two.")
    files = [file for file in folder.iterdir() if file.suffix.lower() in CLOUD_ENDINGS]
    parts = {file: [(len(part), part) for part in re.findall(r"\d+|\D+", file.name)] for file in files}
    for k, file in enumerate(sorted(files, key=parts.__getitem__)):
        yield Scan(k * period, read_cloud(file).cloud)


def _capture(path: Path, name: str) -> Iterator[Scan]:
    from navcore.drivers.lidar3d.capture_turns import CaptureTurns
    from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams

    model = Lidar3dParams(model=name).lidar_model() if name else None
    for turn in CaptureTurns(path, model).turns():
        yield Scan(turn.stamp_ns * 1e-9, turn.cloud)


def _tum(seconds: float, T: SE3) -> str:
    from scipy.spatial.transform import Rotation

    turn = Rotation.from_matrix(T.R).as_quat(canonical=True)
    return " ".join((f"{seconds:.6f}", *(f"{value:.6f}" for value in (*T.t, *turn))))

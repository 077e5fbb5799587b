"""`rowpilot calibrate`: camera and LiDAR from folders of pictures and scans."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from navcore.calibration.board import Board
    from navcore.calibration.calibration_file import CalibrationVersion

BAD_INPUT = 2
calibrate_app = typer.Typer(
    help="Calibrate the camera, and where it sits to the LiDAR, from a board.", no_args_is_help=True
)

BoardSize = Annotated[str, typer.Option("--board", help="Inner corners, as 8x5: where two black squares meet.")]
SquareMm = Annotated[float, typer.Option(help="Side of a square, mm, measured on the print.")]
Charuco = Annotated[bool, typer.Option("--charuco", help="The board has ArUco markers (4X4_100) in white squares.")]
Plate = Annotated[
    str, typer.Option(help="Width x height of the whole plate, mm, as 297x210; else a white edge one square wide.")
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object.")]
Out = Annotated[
    Path | None, typer.Option(help="Keep the version: a new .json file, or a folder that gets one.")
]  # fmt: skip
By = Annotated[str, typer.Option(help="Who calibrates.")]
Plot = Annotated[Path | None, typer.Option(help="Draw errors and coverage into this .png.")]


@calibrate_app.command("camera")
def calibrate_camera(
    folder: Annotated[Path, typer.Argument(help="Pictures of the board: 20, near and far, tilted to all sides.")],
    board: BoardSize = "8x5",
    square_mm: SquareMm = 27.0,
    charuco: Charuco = False,
    as_json: AsJson = False,
    out: Out = None,
    by: By = "",
    robot: Annotated[str, typer.Option(help="Whose camera it is.")] = "robot",
    camera: Annotated[str, typer.Option(help="Serial number or name of the camera.")] = "front",
    plot: Plot = None,
) -> None:
    """Focal lengths, principal point and lens of a camera, with their errors, and which poses are missing."""
    from navcore.errors import InputError

    try:
        from navcore.cli.calibrate_camera import calibrated_camera

        version, record = calibrated_camera(folder, _board(board, square_mm, charuco, ""), by, robot, camera, plot)
        record["written"] = _kept(version, out)
    except InputError as error:
        _refuse(error)
    _tell(record, as_json)


@calibrate_app.command("lidar")
def calibrate_lidar(
    folder: Annotated[
        Path,
        typer.Argument(
            help="Pairs of one name: NAME.png (or .jpg) and NAME.csv, rows angle_deg,distance_m under that heading, "
            "angles to the left, one second of turns while the board is held still in the LiDAR's plane."
        ),
    ],
    camera: Annotated[Path, typer.Option(help="The camera's calibration, as `calibrate camera --out` keeps it.")],
    board: BoardSize = "8x5",
    square_mm: SquareMm = 27.0,
    charuco: Charuco = False,
    plate_mm: Plate = "",
    camera_at: Annotated[
        str, typer.Option(help="The camera in the LiDAR's frame, by ruler: x,y,z in m, and yaw in deg.")
    ] = "0,0,0,0",
    lidar_at: Annotated[
        str, typer.Option(help="Where the level LiDAR is on the robot: x,y,z in m, and yaw in deg.")
    ] = "",
    range_std_mm: Annotated[float, typer.Option(min=1.0, max=100.0, help="1-sigma of the LiDAR's distances.")] = 10.0,
    robot: Annotated[str | None, typer.Option(help="Refuse a camera calibration of another robot.")] = None,
    as_json: AsJson = False,
    out: Out = None,
    by: By = "",
    plot: Plot = None,
) -> None:
    """Where the camera sits to the LiDAR, from boards that both see, with its errors."""
    from navcore.errors import InputError

    try:
        from navcore.calibration.calibration_file import load_version
        from navcore.cli.calibrate_lidar import LidarJob, calibrated_lidar

        job = LidarJob(
            folder=folder, board=_board(board, square_mm, charuco, plate_mm), by=by, plot=plot,
            camera=load_version(camera, robot=robot), rough=_numbers(camera_at, "--camera-at"),
            lidar_at=_numbers(lidar_at, "--lidar-at") if lidar_at else None, range_std=range_std_mm / 1000.0,
        )  # fmt: skip
        version, record = calibrated_lidar(job)
        record["written"] = _kept(version, out)
    except InputError as error:
        _refuse(error)
    _tell(record, as_json)


def _board(size: str, square_mm: float, charuco: bool, plate_mm: str) -> Board:
    from navcore.calibration.board import Board

    columns, rows = _pair(size, "--board", "8x5")
    wide, high = _pair(plate_mm, "--plate-mm", "297x210") if plate_mm else (0.0, 0.0)
    return Board(
        columns=int(columns), rows=int(rows), square=square_mm / 1000.0, charuco=charuco, width=wide / 1000.0,
        height=high / 1000.0,
    )  # fmt: skip


def _pair(text: str, option: str, example: str) -> tuple[float, float]:
    from navcore.errors import InputError

    try:
        first, second = (float(part) for part in text.lower().split("x"))
    except ValueError:
        raise InputError(f"{option} must be two numbers as {example}, not {text}.") from None
    if not (0.0 < first < 10_000.0 and 0.0 < second < 10_000.0):
        raise InputError(f"{option} must be two numbers above 0 as {example}, not {text}.")
    return first, second


def _numbers(text: str, option: str) -> tuple[float, float, float, float]:
    """x, y, z in m and yaw in deg."""
    import math

    from navcore.errors import InputError

    try:
        x, y, z, yaw = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"{option} must be x,y,z,yaw as 0.1,0,0.25,0, not {text}.") from None
    if not all(map(math.isfinite, (x, y, z, yaw))):
        raise InputError(f"{option} must be finite, not {text}.")
    return x, y, z, yaw


def _kept(version: CalibrationVersion, out: Path | None) -> str | None:
    """The file that it was written to."""
    from dataclasses import replace

    from navcore.calibration.calibration_file import new_id, save_version

    if out is None:
        return None
    if out.suffix == ".json":
        save_version(version, out)
        return str(out)
    version = replace(version, id=new_id(version.made_utc, out))
    save_version(version, path := out / f"{version.id}.json")
    return str(path)


def _refuse(error: Exception) -> None:
    """A sentence each line."""
    for reason in getattr(error, "reasons", (str(error),)):
        typer.echo(reason, err=True)
    raise typer.Exit(BAD_INPUT) from None


def _tell(record: dict[str, Any], as_json: bool) -> None:
    import json

    if as_json:
        typer.echo(json.dumps(record, indent=1, allow_nan=False))
        return
    for line in _lines(record):
        typer.echo(line)


def _lines(record: dict[str, Any]) -> Sequence[str]:
    """Values with their 1-sigma and unit, then what was refused and what is missing."""
    lines = [f"{v['name']:<12}{v['value']:>12.5g} ± {v['std']:<9.2g} {v['unit']}".rstrip() for v in record["values"]]
    lines += [f"{name}: {value}" for name, value in record["quality"].items()]
    lines += [f"not used: {name}: {reason}" for name, reason in record["refused"]]
    lines += [f"missing: {wish}" for wish in record["missing"]]
    lines += [f"Written to {record[key]}." for key in ("plot", "written") if record.get(key)]
    return lines

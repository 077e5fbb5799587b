"""`rowpilot see`: what the default perception makes of any picture or video."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from navcore.cli.see_drawing import Drawings
    from navcore.cli.see_frames import Frame
    from navcore.drivers.camera_capture import CameraParams

BAD_INPUT = 2
Sight = Callable[["Frame"], dict[str, Any]]


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("see")(see)


def see(
    pictures: Annotated[
        list[Path], typer.Argument(metavar="PICTURE...", help="Pictures, videos, or folders of them.")
    ],
    camera: Annotated[
        Path | None, typer.Option(help="Settings with a [front_camera]; without, tilt and height are guessed.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON list, one object per frame.")] = False,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the drawn pictures; `seen` where neither it nor --json is given.")
    ] = None,
) -> None:
    """Look for the row in pictures, without a station: objects, both ground lines, or why there is no row."""
    from navcore.cli.see_drawing import Drawings
    from navcore.errors import InputError

    folder = out or (None if as_json else Path("seen"))
    try:
        sight = _told_sight(camera) if camera else _guessing_sight()
        drawings = Drawings(folder) if folder else None
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    records, refused = _look(pictures, sight, drawings, None if as_json else typer.echo)
    if drawings:
        drawings.close()
    if as_json:
        typer.echo(json.dumps(records, indent=1, allow_nan=False))
    if refused:
        raise typer.Exit(BAD_INPUT)


def _look(
    pictures: list[Path], sight: Sight, drawings: Drawings | None, tell: Callable[[str], None] | None
) -> tuple[list[dict[str, Any]], bool]:
    """Records of all frames, and whether something was refused; what follows it is looked at all the same."""
    from navcore.errors import InputError

    records, refused = [], False
    for path in pictures:
        try:
            for frame, record in _seen(path, sight):
                records.append(record)
                if drawings:
                    drawings.add(frame, record)
                if tell:
                    tell(_line(record))
        except InputError as error:
            refused = True
            typer.echo(str(error), err=True)
    return records, refused


def _seen(path: Path, sight: Sight) -> Iterator[tuple[Frame, dict[str, Any]]]:
    from navcore.cli.see_frames import frames

    for frame in frames(path):
        yield frame, sight(frame)


def _guessing_sight() -> Sight:
    from navcore.cli.see_record import see_record
    from navcore.perception.onnx_detector import OnnxDetector
    from navcore.perception.row_perception import RowPerceptionParams
    from navcore.perception.sliced_detector import SlicedDetector
    from navcore.perception.unknown_camera import UnknownCameraParams, see_with_unknown_camera

    detector = SlicedDetector(OnnxDetector())

    def sight(frame: Frame) -> dict[str, Any]:
        guess = see_with_unknown_camera(frame.image, detector, UnknownCameraParams(), RowPerceptionParams())
        return see_record(frame, guess.view, guess.camera, told=False, reason=guess.reason)

    return sight


def _told_sight(settings: Path) -> Sight:
    from navcore.cli.see_record import see_record
    from navcore.config import load_config
    from navcore.drivers.camera_capture import rectification
    from navcore.messages import CameraName
    from navcore.perception.detector_choice import new_detector
    from navcore.perception.row_perception import RowPerception

    config = load_config(settings)
    camera = config.front_camera
    perception = RowPerception(camera.mount, new_detector(config.detector), config.perception)
    straighten = rectification(camera)

    def sight(frame: Frame) -> dict[str, Any]:
        _check_size(frame, camera)
        perception.forget()
        view = perception.process(straighten(frame.image), 0, CameraName.FRONT)
        return see_record(frame, view, camera.mount, told=True, reason=view.row.reason)

    return sight


def _check_size(frame: Frame, camera: CameraParams) -> None:
    from navcore.errors import InputError

    height, width = frame.image.shape[:2]
    wanted = (camera.mount.width_px, camera.mount.height_px)
    if (width, height) != wanted:
        raise InputError(
            f"{frame.path} is {width}x{height}, the settings are for {wanted[0]}x{wanted[1]}. Leave --camera out or "
            "give the settings of the camera that took it."
        )


def _line(record: dict[str, Any]) -> str:
    name = Path(record["picture"]).name + ("" if record["frame"] is None else f" frame {record['frame']}")
    row, count = record["row"], len(record["objects"])
    if row is None:
        return f"{name}: no row, {record['reason']} ({count} objects)"
    return f"{name}: row, quality {row['quality']:.2f}, {row['objects']} of {count} objects on its lines"

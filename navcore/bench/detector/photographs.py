"""Photographs with marked rows, seen as `rowpilot see` sees them: what is found on pictures that nobody rendered.

Of a folder with pictures and `labels.json`, a list of objects: `file`; `in_row` true, false, or anything else for who
cannot tell; the ground lines `left` and `right`, two points (u, v) each, null where there is none; and `objects` with
`box` (left, top, right, bottom) and `foot_visible`. Pixels. Whatever else stands there is not read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import msgspec
import numpy as np

from navcore.bench.figure import Figure, share
from navcore.errors import InputError
from navcore.messages import CameraView, ImageLine
from navcore.perception.detector import Image
from navcore.perception.onnx_detector import OnnxDetector
from navcore.perception.row_perception import RowPerceptionParams
from navcore.perception.sliced_detector import SlicedDetector
from navcore.perception.unknown_camera import Guess, UnknownCameraParams, see_with_unknown_camera

LABELS = "labels.json"
WITHIN_DEG, FOOT_PX = 5.0, 8.0
# Six of the seven photographs of rows that came with the project.
_WANTED = 6 / 7

Point = tuple[float, float]
Sight = Callable[[Image], Guess]


class MarkedObject(msgspec.Struct):
    """A trunk or post."""

    box: tuple[float, float, float, float]
    foot_visible: bool = True


class Photograph(msgspec.Struct):
    """One picture and what somebody marked in it; see the module."""

    file: str
    in_row: Any
    left: tuple[Point, Point] | None = None
    right: tuple[Point, Point] | None = None
    objects: tuple[MarkedObject, ...] = ()


@dataclass(slots=True)
class Tally:
    """Photographs in a row, with both lines right, without a row, with a line there; marked feet and those found."""

    rows: int = 0
    right: int = 0
    headlands: int = 0
    false: int = 0
    feet: int = 0
    found: int = 0


def photograph_figures(folder: Path) -> tuple[Figure, ...]:
    """Beside ours as baseline the picture seen as a whole by the best camera alone. Raises InputError."""
    ours = _tally(folder, _sight(UnknownCameraParams(), sliced=True))
    base = _tally(folder, _sight(UnknownCameraParams(agreeing=1.0), sliced=False))
    return (
        share("photographs: both ground lines within 5 deg", ours.right, ours.rows, seed=None,
              baseline=_part(base.right, base.rows), at_least=_WANTED),
        share("photographs: a line where there is no row", ours.false, ours.headlands, seed=None,
              baseline=_part(base.false, base.headlands), at_most=0.0),
        share("photographs: marked feet found within 8 px", ours.found, ours.feet, seed=None,
              baseline=_part(base.found, base.feet)),
    )  # fmt: skip


def read_photographs(folder: Path) -> Iterator[tuple[Photograph, Image]]:
    """Each with its picture (H, W, 3), BGR. Raises InputError with a sentence."""
    path = folder / LABELS
    try:
        marked = msgspec.json.decode(path.read_bytes(), type=tuple[Photograph, ...])
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.") from error
    except msgspec.MsgspecError as error:
        raise InputError(f"{path} is no list of marked photographs: {error}.") from error
    for photograph in marked:
        image = cv2.imread(str(folder / photograph.file), cv2.IMREAD_COLOR)
        if image is None:
            raise InputError(f"The photograph {folder / photograph.file} is missing or damaged.")
        yield photograph, np.asarray(image, dtype=np.uint8)


def _sight(params: UnknownCameraParams, *, sliced: bool) -> Sight:
    detector = OnnxDetector()
    eye = SlicedDetector(detector) if sliced else detector
    return lambda image: see_with_unknown_camera(image, eye, params, RowPerceptionParams())


def _tally(folder: Path, sight: Sight) -> Tally:
    tally = Tally()
    for photograph, image in read_photographs(folder):
        _count(tally, photograph, sight(image))
    return tally


def _count(tally: Tally, photograph: Photograph, guess: Guess) -> None:
    feet = [o.box for o in photograph.objects if o.foot_visible]
    tally.feet, tally.found = tally.feet + len(feet), tally.found + sum(_has_foot(guess.view, box) for box in feet)
    if photograph.in_row is True:
        tally.rows, tally.right = tally.rows + 1, tally.right + (not guess.reason and _agrees(guess.view, photograph))
    elif photograph.in_row is False:
        tally.headlands, tally.false = tally.headlands + 1, tally.false + (not guess.reason)


def _has_foot(view: CameraView, box: tuple[float, float, float, float]) -> bool:
    u, v = (box[0] + box[2]) / 2, box[3]
    return any(math.hypot((o.x1 + o.x2) / 2 - u, o.y2 - v) <= FOOT_PX for o in view.objects)


def _agrees(view: CameraView, photograph: Photograph) -> bool:
    pairs = ((view.left, photograph.left), (view.right, photograph.right))
    return all(seen is not None and told is not None and _off_deg(seen, told) <= WITHIN_DEG for seen, told in pairs)


def _off_deg(seen: ImageLine, told: tuple[Point, Point]) -> float:
    (u0, v0), (u1, v1) = told
    turn = math.atan2(seen.v1 - seen.v0, seen.u1 - seen.u0) - math.atan2(v1 - v0, u1 - u0)
    return abs(math.degrees(math.remainder(turn, math.pi)))


def _part(part: int, whole: int) -> float | None:
    return part / whole if whole else None

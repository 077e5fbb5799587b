"""Rows in a picture of a camera about which nothing is known: its tilt and height are chosen so that what stands in
the picture makes the best row, and the lines are those that most of the cameras agree on that explain it well.

A wrong field of view only scales the ground, and so does a wrong height; the lines in the picture stay where they
are.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName, CameraView
from navcore.perception.agreed_lines import agreed_lines
from navcore.perception.detector import Detector, Image, Told
from navcore.perception.row_perception import RowPerception, RowPerceptionParams

UNSURE = "what stands in the picture makes no row that is sure enough"
FEW = "too few trunks and posts stand in line"
ASIDE = "the camera stands on a row and not between two"
ACROSS = "the camera looks across the rows"


@dataclass(frozen=True, slots=True, kw_only=True)
class UnknownCameraParams:
    """Which cameras are tried.

    Attributes:
        field_of_view_deg: across the picture, as of most robots' cameras.
        pitch_deg: tilts, positive looks down. height: above the ground, m.
        curve: scatter of plants per squared metre of distance, 1/m: a lens that is guessed bends rows.
        lines, tries: as in `CorridorFitParams`; more than on the robot, for a single picture knows no row before it.
        min_quality: the best row must be worth so much, 0 to 1: with enough cameras to choose from, anything stands
            in line somehow.
        min_objects: so many objects stand on its lines; on the robot, which knows its camera, fewer do.
        most_aside: the camera stands no further from the row's middle, as a share of the row's width, 0 to 0.5.
        most_turned_deg: and is turned no further from the row's direction.
        agreeing: cameras worth at least that share of the best have a say in where the lines lie, 0 to 1.
    """

    field_of_view_deg: float = 69.0
    pitch_deg: tuple[float, ...] = (-6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0)
    height: tuple[float, ...] = (0.6, 0.85, 1.2, 1.7)
    curve: float = 0.001
    lines: int = 30
    tries: int = 12
    min_quality: float = 0.5
    min_objects: int = 5
    most_aside: float = 0.38
    most_turned_deg: float = 20.0
    agreeing: float = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Guess:
    """The camera that explains a picture best, and what is seen in it. `reason`: why there is no row; else empty."""

    camera: PinholeCamera
    view: CameraView
    reason: str


def see_with_unknown_camera(
    image: Image, detector: Detector, params: UnknownCameraParams, perception: RowPerceptionParams
) -> Guess:
    """What is seen in one picture (H, W, 3), BGR. It is detected once and fitted with every camera."""
    told, loose = Told(detector.detect(image)), _loosened(perception, params)
    tried = [(camera, _view(image, camera, told, loose)) for camera in _cameras(image, params)]
    worths = [0.0 if _unfit(view, params) else view.row.objects * view.row.quality for _, view in tried]
    best = max(range(len(tried)), key=worths.__getitem__)
    if worths[best] <= 0.0:
        return _no_row(tried, params)
    camera, view = tried[best]
    say = [k for k, worth in enumerate(worths) if worth >= params.agreeing * worths[best]]
    agreed = agreed_lines(view, [tried[k][1] for k in say], [worths[k] ** 2 for k in say])
    return Guess(camera=camera, view=agreed, reason=UNSURE if view.row.quality < params.min_quality else "")


def _no_row(tried: list[tuple[PinholeCamera, CameraView]], params: UnknownCameraParams) -> Guess:
    """What the middle camera says, or what is wrong with the row that another one sees."""
    seen = next((one for one in tried if one[1].row.valid), None)
    camera, view = seen or tried[len(tried) // 2]
    return Guess(camera=camera, view=view, reason=_unfit(view, params))


def _unfit(view: CameraView, p: UnknownCameraParams) -> str:
    """Why nobody can drive in what is seen; empty if one can."""
    row = view.row
    if not row.valid or row.offset is None or row.heading is None or row.width is None:
        return row.reason or UNSURE
    if row.objects < p.min_objects:
        return FEW
    if abs(math.degrees(row.heading)) > p.most_turned_deg:
        return ACROSS
    return ASIDE if abs(row.offset) > p.most_aside * row.width else ""


def _loosened(perception: RowPerceptionParams, p: UnknownCameraParams) -> RowPerceptionParams:
    corridor = perception.corridor
    fit = replace(corridor.fit, curve=p.curve, lines=p.lines, tries=p.tries)
    return replace(perception, corridor=replace(corridor, fit=fit))


def _cameras(image: Image, params: UnknownCameraParams) -> Iterator[PinholeCamera]:
    height, width = image.shape[:2]
    f = width / 2 / math.tan(math.radians(params.field_of_view_deg) / 2)
    for pitch, z in itertools.product(params.pitch_deg, params.height):
        yield PinholeCamera(
            width_px=width, height_px=height, fx=f, fy=f, cx=width / 2, cy=height / 2, x=0.0, y=0.0, z=z,
            pitch=math.radians(pitch),
        )  # fmt: skip


def _view(image: Image, camera: PinholeCamera, told: Told, perception: RowPerceptionParams) -> CameraView:
    return RowPerception(camera, told, perception).process(image, 0, CameraName.FRONT)

"""Rows in a picture of a camera about which nothing is known: its tilt and height are chosen so that what stands in
the picture makes the best row.

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
from navcore.perception.detector import Detector, Image, Told
from navcore.perception.row_perception import RowPerception, RowPerceptionParams


@dataclass(frozen=True, slots=True, kw_only=True)
class UnknownCameraParams:
    """Which cameras are tried.

    Attributes:
        field_of_view_deg: across the picture, as of most robots' cameras.
        pitch_deg: tilts, positive looks down. height: above the ground, m.
        curve: scatter of plants per squared metre of distance, 1/m: a lens that is guessed bends rows.
        min_quality: the best row must be worth so much, 0 to 1: with enough cameras to choose from, anything stands
            in line somehow.
    """

    field_of_view_deg: float = 69.0
    pitch_deg: tuple[float, ...] = (-6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 21.0)
    height: tuple[float, ...] = (0.6, 0.85, 1.2, 1.7)
    curve: float = 0.001
    min_quality: float = 0.5


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
    told, bent = Told(detector.detect(image)), _with_curve(perception, params.curve)
    tried = [(camera, _view(image, camera, told, bent)) for camera in _cameras(image, params)]
    camera, view = max(tried, key=lambda one: _worth(one[1]))
    if not view.row.valid:
        camera, view = tried[len(tried) // 2]
    reason = view.row.reason
    if view.row.valid and view.row.quality < params.min_quality:
        reason = "what stands in the picture makes no row that is sure enough"
    return Guess(camera=camera, view=view, reason=reason)


def _with_curve(perception: RowPerceptionParams, curve: float) -> RowPerceptionParams:
    corridor = perception.corridor
    return replace(perception, corridor=replace(corridor, fit=replace(corridor.fit, curve=curve)))


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


def _worth(view: CameraView) -> float:
    """So many objects carry the row, each as much as the row is sure."""
    return view.row.objects * view.row.quality if view.row.valid else -1.0

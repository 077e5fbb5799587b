"""Feeds row perception what it needs beside the picture: the camera, the row that is meant, the motion in between."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from navcore.geometry.se2 import SE2
from navcore.messages import USUAL_WIDTH, CameraName, CameraRequest, CameraView, RowObservation
from navcore.perception.detector import Image
from navcore.perception.levelling import leaning_offset, levelled
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception

LEAST_PRIOR_STD = 0.15
WRONG_ROW = 0.38


class RowEye:
    """One perception a camera; a change of camera starts anew."""

    def __init__(self, perceptions: Mapping[CameraName, RowPerception], camera_height: float) -> None:
        """`camera_height` above the ground, m."""
        self._perceptions, self._height = perceptions, camera_height
        self._last: CameraRequest | None = None

    def look(self, image: Image, stamp_ns: int, request: CameraRequest, latency_ms: float = 0.0) -> CameraView:
        """What is seen in one picture (H, W, 3) BGR of the camera that was asked for."""
        perception = self._perceptions[request.camera]
        motion = self._motion(request)
        if motion is None:
            perception.forget()
        self._last = request
        prior = row_prior(request, self._height)
        view = perception.process(image, stamp_ns, request.camera, prior=prior, motion=motion, latency_ms=latency_ms)
        if _is_another_row(view.row, prior):
            perception.forget()
        return replace(view, row=levelled(view.row, self._height, request.roll))

    def _motion(self, request: CameraRequest) -> SE2 | None:
        """`T_last_now` of base_link, None where this picture does not follow the last one.

        Nor does it where no row is expected: nobody tells then how the robot moves.
        """
        last = self._last
        if last is None or last.camera is not request.camera or request.offset is None:
            return None
        return _odom(last).inverse() @ _odom(request)


def row_prior(request: CameraRequest, camera_height: float) -> RowPrior | None:
    """The expected row in the driving frame as the leaning camera should see it, None where none is expected."""
    if request.offset is None or request.heading is None:
        return None
    std = max(request.offset_std or 0.0, LEAST_PRIOR_STD)
    offset = leaning_offset(request.offset, request.width or USUAL_WIDTH, camera_height, request.roll)
    return RowPrior(
        offset=offset, heading=request.heading, std=std, width=request.width, pitch=request.pitch, roll=request.roll
    )  # fmt: skip


def _is_another_row(seen: RowObservation, prior: RowPrior | None) -> bool:
    """A line further from the expected one than a share of the width is not worth following on."""
    if prior is None or not seen.valid or seen.offset is None:
        return False
    return abs(seen.offset - prior.offset) > WRONG_ROW * (prior.width or USUAL_WIDTH)


def _odom(request: CameraRequest) -> SE2:
    return SE2(request.odom_x, request.odom_y, request.odom_yaw)

"""A row in a picture of a camera about which nothing is known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName, CameraView, DetectedObject, ImageLine, ObjectKind, RowObservation
from navcore.perception.agreed_lines import agreed_lines
from navcore.perception.detector import Told
from navcore.perception.row_perception import RowPerceptionParams
from navcore.perception.unknown_camera import ACROSS, FEW, UnknownCameraParams, see_with_unknown_camera

CAMERA = PinholeCamera(
    width_px=640, height_px=640, fx=450.0, fy=450.0, cx=320.0, cy=320.0, x=0.0, y=0.0, z=1.1, pitch=0.1
)
IMAGE = np.random.default_rng(0).integers(0, 255, (640, 640, 3), dtype=np.uint8)
ALL = tuple(2.5 + 1.2 * k for k in range(9))


def trunks(turned: float, x: tuple[float, ...] = ALL, width: float = 2.6) -> Told:
    """Feet of two lines of vines `x` m ahead, seen by a camera between them that is turned, rad, to the left."""
    c, s = math.cos(turned), math.sin(turned)
    objects = []
    for ahead, left in ((a, side * width / 2) for a in x for side in (1.0, -1.0)):
        at = (c * ahead + s * left, -s * ahead + c * left)
        (u, v), (_, top) = CAMERA.project(np.array([(*at, 0.0), (*at, 0.7)]))
        if 0.0 < u < 640.0 and v < 640.0:
            objects.append(
                DetectedObject(kind=ObjectKind.TRUNK, confidence=0.8, x1=u - 4, x2=u + 4, y1=float(top), y2=float(v))
            )
    return Told(tuple(objects))


def seen(told: Told, params: UnknownCameraParams = UnknownCameraParams()) -> tuple[CameraView, str]:
    guess = see_with_unknown_camera(IMAGE, told, params, RowPerceptionParams())
    return guess.view, guess.reason


@pytest.mark.parametrize("turned", [-0.1, 0.0, 0.1])
def test_the_lines_go_through_the_feet(turned: float) -> None:
    told = trunks(turned)
    view, reason = seen(told)
    assert reason == ""
    assert view.left is not None
    assert view.right is not None
    for o in told.objects:
        off = [abs(u_at(line, o.y2) - (o.x1 + o.x2) / 2) for line in (view.left, view.right)]
        assert min(off) < 4.0  # px


def test_a_camera_that_looks_across_the_rows_says_so() -> None:
    assert seen(trunks(math.radians(24.0)))[1] == ACROSS


def test_fewer_plants_in_line_than_wanted_are_no_row() -> None:
    few = trunks(0.0, x=ALL[:4])
    assert seen(few)[1] == ""
    assert seen(few, UnknownCameraParams(min_objects=len(few.objects) + 1))[1] == FEW


def u_at(line: ImageLine, v: float) -> float:
    return line.u0 + (line.u1 - line.u0) * (v - line.v0) / (line.v1 - line.v0)


def view_of(shift: float) -> CameraView:
    """Three lines that meet at (320, 200), moved to the right by `shift` px."""
    row = RowObservation(stamp_ns=0, camera=CameraName.FRONT, valid=True, reason="")
    left, centre, right = (
        ImageLine(u0=u + shift, v0=640.0, u1=(u + 9 * 320.0) / 10 + shift, v1=244.0) for u in (20.0, 330.0, 610.0)
    )
    return CameraView(
        stamp_ns=0, camera=CameraName.FRONT, width_px=640, height_px=640, objects=(), points=(), left=left,
        right=right, centre=centre, row=row, latency_ms=0.0,
    )  # fmt: skip


def test_one_camera_that_sees_other_lines_does_not_move_them() -> None:
    best = view_of(0.0)
    agreed = agreed_lines(best, [best, view_of(1.0), view_of(90.0)], [0.4, 0.35, 0.25])
    assert agreed.left is not None
    assert best.left is not None
    assert u_at(agreed.left, 640.0) == pytest.approx(u_at(best.left, 640.0) + 1.0)
    assert agreed.left.v1 == best.left.v1


def test_the_best_camera_is_overruled_by_those_that_agree() -> None:
    best = view_of(90.0)
    agreed = agreed_lines(best, [best, view_of(0.0), view_of(0.0)], [0.4, 0.3, 0.3])
    assert agreed.right is not None
    assert u_at(agreed.right, 640.0) == pytest.approx(610.0)  # px


def test_a_camera_without_lines_has_no_say() -> None:
    best = view_of(0.0)
    agreed = agreed_lines(best, [best, replace(view_of(0.0), left=None)], [0.1, 0.9])
    assert agreed.left == best.left


def test_lines_end_where_they_meet() -> None:
    steep = view_of(0.0)
    assert steep.left is not None
    crossing = replace(steep, left=replace(steep.left, u1=steep.left.u1 + 60.0))
    agreed = agreed_lines(crossing, [crossing], [1.0])
    assert agreed.left is not None
    assert agreed.right is not None
    assert agreed.left.v1 > steep.left.v1
    assert (agreed.left.u1, agreed.left.v1) == pytest.approx((agreed.right.u1, agreed.right.v1))

"""Boxes of a known corridor as a flawless detector sees them, and a picture for who needs one."""

from __future__ import annotations

import math

import numpy as np

from navcore.geometry.pinhole import PinholeCamera, robot_camera, rotation_from_rpy
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView, DetectedObject, ObjectKind
from navcore.perception.detector import Image, Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams

FRONT = robot_camera()
REAR = robot_camera(rear=True)


def picture(camera: PinholeCamera) -> Image:
    """Any picture with contrast."""
    rng = np.random.default_rng(0)
    return rng.integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)


def boxes_at(
    camera: PinholeCamera, feet: np.ndarray, reach: float = 12.0, roll: float = 0.0, wide: np.ndarray | None = None
) -> tuple[DetectedObject, ...]:
    """Boxes of trunks 1.2 m high at feet (N, 2) in `base_link`, those wholly inside the picture.

    `roll` of the body against the ground, rad; `wide` (N,) are the boxes, m, else 8 cm.
    """
    objects, leaning = [], rotation_from_rpy(roll, 0.0, 0.0)
    for (x, y), width in zip(feet, np.full(len(feet), 0.08) if wide is None else wide, strict=True):
        facing = (x - camera.x) * math.cos(camera.yaw) + (y - camera.y) * math.sin(camera.yaw)
        if facing < 0.5 or math.hypot(x - camera.x, y - camera.y) > reach:
            continue
        (u, v), (_, top) = camera.project(np.array([[x, y, 0.0], [x, y, 1.2]]) @ leaning)
        half = 0.5 * width * camera.fx / facing
        if u - half > 0 and u + half < camera.width_px and v < camera.height_px:
            objects.append(
                DetectedObject(kind=ObjectKind.TRUNK, confidence=0.9, x1=u - half, y1=top, x2=u + half, y2=v)
            )
    return tuple(objects)


def corridor_feet(
    pose: SE2, *, width: float = 3.0, start: float = -20.0, end: float = 40.0, spacing: float = 1.5, lines: int = 2,
    keep_left: bool = True, keep_right: bool = True,
) -> np.ndarray:  # fmt: skip
    """Feet (N, 2) in `base_link` of a robot at `pose` in an orchard whose corridor runs along x with y = 0 inside."""
    sides = [(k + 0.5) * width for k in range(-lines, lines)]
    sides = [y for y in sides if (y > 0 or keep_right) and (y < 0 or keep_left)]
    along = np.arange(start, end + 1e-6, spacing)
    feet = np.stack(np.meshgrid(along, sides), axis=-1).reshape(-1, 2)
    return pose.inverse().apply(feet)


def drive(perception: RowPerception, told: Told, poses: list[SE2], **orchard: object) -> list[CameraView]:
    """Pictures along `poses`, with the motion in between."""
    views: list[CameraView] = []
    last: SE2 | None = None
    for i, pose in enumerate(poses):
        told.objects = boxes_at(FRONT, corridor_feet(pose, **orchard))  # type: ignore[arg-type]
        motion = last.inverse() @ pose if last else None
        views.append(perception.process(picture(FRONT), i, CameraName.FRONT, motion=motion))
        last = pose
    return views


def look(
    pose: SE2, camera: PinholeCamera = FRONT, method: RowMethod = RowMethod.CORRIDOR, prior: RowPrior | None = None,
    **orchard: object,
) -> CameraView:  # fmt: skip
    """One picture from `pose` in an orchard whose corridor runs along x."""
    told = Told(boxes_at(camera, corridor_feet(pose, **orchard)))  # type: ignore[arg-type]
    name = CameraName.REAR if camera is REAR else CameraName.FRONT
    perception = RowPerception(camera, told, RowPerceptionParams(method=method))
    return perception.process(picture(camera), 7, name, prior=prior)

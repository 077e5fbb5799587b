"""Row lines in the image: from the ground, their bisector, and the published readings of it."""

from __future__ import annotations

import math
from dataclasses import replace

from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception import drawing_kernels as kernels
from navcore.perception.row_lines import away_from_camera


def looks_back(camera: PinholeCamera) -> bool:
    """Whether it is a rear camera."""
    return math.cos(camera.yaw) < 0.0


def driving_camera(camera: PinholeCamera) -> PinholeCamera:
    """The camera's mount in its driving frame: `base_link`, turned by pi for a rear camera."""
    return replace(camera, x=-camera.x, y=-camera.y, yaw=camera.yaw - math.pi) if looks_back(camera) else camera


def image_line(camera: PinholeCamera, *, offset: float, heading: float, pitch: float = 0.0) -> Line2:
    """Image of the ground line with that offset and heading in the driving frame, for a camera pitched by more."""
    seen = camera.pitched(pitch) if pitch else camera
    return away_from_camera(Line2(*kernels.image_line(offset, heading, seen.compiled())))


def image_bisector(left: Line2, right: Line2) -> Line2 | None:
    """The published centre line (paper A, Equations 1 to 4), without its singularities.

    The sum of the two unit normals is the normal of the bisector, and the bisector passes through the lines' point
    of intersection. That holds for a centred robot (k1 + k2 = 0) and for vertical lines. Both lines are directed
    away from the camera. None if they are opposed, as level lines can be.
    """
    left, right = away_from_camera(left), away_from_camera(right)
    nx, ny = left.nx + right.nx, left.ny + right.ny
    norm = math.hypot(nx, ny)
    if norm < 0.05:
        return None
    return Line2(nx / norm, ny / norm, (left.offset + right.offset) / norm)


def published_reading(centre: Line2, camera: PinholeCamera, look_ahead: float) -> tuple[float, float] | None:
    """Lateral deviation dy = (u_c - u_0) Z_p / f_x at the look-ahead depth, and the angle to the image's vertical.

    Both positive to the left: m and rad. None for a level line.
    """
    _, v = kernels.pixel(camera.x + look_ahead, camera.y, 0.0, camera.compiled())
    u = centre.x_at(v)
    if u is None:
        return None
    return float(-(u - camera.cx) * look_ahead / camera.fx), math.atan2(-centre.ny, centre.nx)

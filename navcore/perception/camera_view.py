"""What row perception says: the observation for the robot, the description of the picture for the browser."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import (
    CameraName,
    CameraView,
    ImageArea,
    ImageLine,
    ImagePoint,
    RowObservation,
    ScannedPlant,
)
from navcore.messages.columns import made_of_columns
from navcore.perception.corner_points import CornerPoints
from navcore.perception.image_lines import image_line
from navcore.perception.lean_watch import Reading
from navcore.perception.plants.box_association import boxed_as
from navcore.perception.row_bands import row_bands
from navcore.perception.row_lines import GroundRow, RowLines
from navcore.perception.row_odometry import Driven
from navcore.perception.seen_row import SeenRow

Ints = NDArray[np.int64]

# Of a row's scanned plants no more are told, and none further away, m.
_MOST_PLANTS, _PLANTS_WITHIN = 12, 8.0


def row_observation(
    stamp_ns: int, name: CameraName, lines: RowLines, ground: GroundRow | str, end: float | None,
    seen_to: float | None, published: tuple[float, float] | None, reading: Reading | None = None,
    driven: Driven | None = None,
) -> RowObservation:  # fmt: skip
    """The row on the ground, or the reason why there is none; `published` is the bisector's reading beside it."""
    if isinstance(ground, str):
        return RowObservation(stamp_ns=stamp_ns, camera=name, valid=False, reason=ground, end_distance=end)
    image_offset, image_heading = published or (None, None)
    offset_std, heading_std = math.sqrt(ground.covariance[0, 0]), math.sqrt(ground.covariance[1, 1])
    correlation = float(ground.covariance[0, 1]) / (offset_std * heading_std)
    lean, mount = (reading.lean, reading.mount) if reading else (None, None)
    return RowObservation(
        stamp_ns=stamp_ns, camera=name, valid=True, reason="", offset=ground.offset, heading=ground.heading,
        offset_std=offset_std, heading_std=heading_std, correlation=correlation, curvature=ground.curvature,
        quality=ground.quality, width=ground.width, end_distance=end, seen_to=seen_to,
        objects=len(ground.left_x) + len(ground.right_x), left_seen=lines.left_seen, right_seen=lines.right_seen,
        image_offset=image_offset, image_heading=image_heading, lean=lean.roll if lean else None,
        lean_std=lean.std if lean else None, mount=mount, driven=driven.metres if driven else None,
        driven_since_ns=driven.since_ns if driven else None, carried=ground.carried,
    )  # fmt: skip


def told_plants(seen: SeenRow, which: Ints | None = None) -> tuple[ScannedPlant, ...]:
    """All scanned plants of a look, or those of the given indices in that order, each with its side of the row and
    the object of the picture that it is.
    """
    plants, sides = seen.look.plants, seen.lines.plant_sides
    index = np.arange(len(plants)) if which is None else which
    on = sides[index] if len(sides) else np.zeros(len(index), dtype=np.int64)
    numbers = plants.number, plants.xy[:, 0], plants.xy[:, 1], plants.diameter, plants.sureness
    objects = (None if k < 0 else k for k in boxed_as(seen.look.found, len(plants))[index].tolist())
    return made_of_columns(ScannedPlant, *(column[index].tolist() for column in numbers), on.tolist(), objects)


def plants_of_row(seen: SeenRow) -> tuple[ScannedPlant, ...]:
    """Those on the row's two lines that are near enough to tell where along the row the robot is, nearest first."""
    sides = seen.lines.plant_sides
    if not len(sides):
        return ()
    away = np.hypot(*seen.look.plants.xy.T)
    near = np.flatnonzero((sides != 0) & (away <= _PLANTS_WITHIN))
    return told_plants(seen, near[np.argsort(away[near], kind="stable")[:_MOST_PLANTS]])


def camera_view(
    camera: PinholeCamera, seen: SeenRow, latency_ms: float, region: ImageArea | None = None
) -> CameraView:
    """Boxes, corner points, lines and plants, as they are drawn over the picture and from above. A row that is not
    valid has no lines.
    """
    row, lines = seen.row, seen.lines
    shown = None if isinstance(seen.ground, str) or not row.valid else seen.ground
    left, right = (lines.left, lines.right) if shown else (None, None)
    centre = image_line(camera, offset=shown.offset, heading=shown.heading, pitch=shown.pitch) if shown else None
    left_band, right_band = row_bands(camera, shown) if shown else (None, None)
    pitch = shown.pitch if shown else 0.0
    return CameraView(
        stamp_ns=row.stamp_ns, camera=row.camera, width_px=camera.width_px, height_px=camera.height_px,
        objects=seen.look.objects, points=_points(seen.look.corners, lines), left=_segment(left, camera, pitch),
        right=_segment(right, camera, pitch), centre=_segment(centre, camera, pitch), row=row, latency_ms=latency_ms,
        bisector=_segment(seen.bisector if shown else None, camera, pitch), region=region,
        left_band=left_band, right_band=right_band, plants=told_plants(seen),
        bearings=tuple(seen.bearings.tolist()), camera_x=camera.x,
    )  # fmt: skip


def _points(corners: CornerPoints, lines: RowLines) -> tuple[ImagePoint, ...]:
    return tuple(
        ImagePoint(u=u, v=v, side="left" if on_left else "right", kept=kept)
        for (u, v), on_left, kept in zip(
            corners.points.tolist(), lines.on_left.tolist(), lines.kept.tolist(), strict=True
        )
    )


def _segment(line: Line2 | None, camera: PinholeCamera, pitch: float) -> ImageLine | None:
    """The part of a line from the image's lower edge to just below the horizon; None for a level line."""
    horizon = camera.cy - camera.fy * math.tan(camera.pitch + pitch)
    far = horizon + 0.02 * camera.height_px
    ends = (line.x_at(float(camera.height_px)), line.x_at(far)) if line else (None, None)
    if ends[0] is None or ends[1] is None:
        return None
    return ImageLine(u0=float(ends[0]), v0=float(camera.height_px), u1=float(ends[1]), v1=float(far))

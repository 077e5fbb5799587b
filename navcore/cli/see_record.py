"""What was seen in a frame, as plain data for JSON."""

from __future__ import annotations

import math
from typing import Any

from navcore.cli.see_frames import Frame
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraView, DetectedObject, ImageLine


def see_record(frame: Frame, view: CameraView, camera: PinholeCamera, *, told: bool, reason: str) -> dict[str, Any]:
    """Pixels have their origin top left. `reason` says why there is no row and is empty where there is one.

    `told`: the camera is the user's; else it is a guess, and nothing in metres is said.
    """
    row = _row(view, told) if not reason else None
    return {
        "picture": str(frame.path), "frame": frame.number, "width": view.width_px, "height": view.height_px,
        "objects": [_object(o) for o in view.objects], "row": row,
        "reason": "" if row else reason or "the row's lines leave the picture", "camera": _camera(camera, told),
    }  # fmt: skip


def _object(seen: DetectedObject) -> dict[str, Any]:
    box = [round(v, 1) for v in (seen.x1, seen.y1, seen.x2, seen.y2)]
    return {"class": str(seen.kind), "box": box, "confidence": round(seen.confidence, 3)}


def _row(view: CameraView, told: bool) -> dict[str, Any] | None:
    if view.left is None or view.right is None or view.centre is None:
        return None
    row, meet = view.row, _through(view.left).intersection(_through(view.right))
    pixels = {
        "left": _ends(view.left), "right": _ends(view.right), "centre": _ends(view.centre),
        "vanishing_point": None if meet is None else [round(v, 1) for v in meet],
        "quality": round(row.quality, 3), "objects": row.objects,
    }  # fmt: skip
    if not told or row.offset is None or row.heading is None or row.width is None:
        return pixels
    metres = {"offset_m": round(row.offset, 3), "width_m": round(row.width, 3)}
    return {**pixels, **metres, "heading_deg": round(math.degrees(row.heading), 2)}


def _through(line: ImageLine) -> Line2:
    return Line2.through((line.u0, line.v0), (line.u1, line.v1))


def _ends(line: ImageLine) -> list[list[float]]:
    return [[round(line.u0, 1), round(line.v0, 1)], [round(line.u1, 1), round(line.v1, 1)]]


def _camera(camera: PinholeCamera, told: bool) -> dict[str, Any]:
    return {
        "told": told, "fx": round(camera.fx, 1), "fy": round(camera.fy, 1), "height_m": camera.z,
        "pitch_deg": round(math.degrees(camera.pitch), 1),
    }  # fmt: skip

"""The two topics that other programs understand too: pictures and positions in Foxglove's JSON schemas.

Source: foxglove/foxglove-sdk, schemas/jsonschema/CompressedImage.json and LocationFix.json.
"""

from __future__ import annotations

import base64
from typing import Any

import msgspec

from navcore.messages import CameraName, GnssFix

IMAGE_TOPIC = "camera/image"
IMAGE_SCHEMA = "foxglove.CompressedImage"
LOCATION_TOPIC = "gnss/location"
LOCATION_SCHEMA = "foxglove.LocationFix"
COVARIANCE_UNKNOWN = 0
COVARIANCE_DIAGONAL = 2
NS = 1_000_000_000

_TIME: dict[str, Any] = {
    "type": "object",
    "title": "time",
    "properties": {"sec": {"type": "integer", "minimum": 0}, "nsec": {"type": "integer", "minimum": 0}},
}
_COMMON: dict[str, Any] = {"timestamp": _TIME, "frame_id": {"type": "string"}}
SCHEMAS: dict[str, dict[str, Any]] = {
    IMAGE_SCHEMA: {
        "title": IMAGE_SCHEMA,
        "type": "object",
        "properties": {
            **_COMMON,
            "data": {"type": "string", "contentEncoding": "base64"},
            "format": {"type": "string"},
        },
    },
    LOCATION_SCHEMA: {
        "title": LOCATION_SCHEMA,
        "type": "object",
        "properties": {
            **_COMMON,
            "latitude": {"type": "number"},
            "longitude": {"type": "number"},
            "altitude": {"type": "number"},
            "position_covariance": {"type": "array", "items": {"type": "number"}, "minItems": 9, "maxItems": 9},
            "position_covariance_type": {"type": "integer"},
        },
    },
}


def compressed_image(jpeg: bytes, camera: CameraName, wall_ns: int) -> bytes:
    """A JPEG as foxglove.CompressedImage; `wall_ns` is the time of capture since 1970."""
    return msgspec.json.encode(
        {
            "timestamp": _timestamp(wall_ns),
            "frame_id": f"camera_{camera}",
            "data": base64.b64encode(jpeg).decode(),
            "format": "jpeg",
        }
    )


def image_of(payload: bytes) -> bytes:
    """The JPEG of a foxglove.CompressedImage, empty if there is none."""
    try:
        return base64.b64decode(msgspec.json.decode(payload)["data"])
    except (msgspec.DecodeError, KeyError, TypeError, ValueError):
        return b""


def location_fix(fix: GnssFix, wall_ns: int) -> bytes | None:
    """A fix as foxglove.LocationFix, None if it has no position."""
    if fix.lat_deg is None or fix.lon_deg is None:
        return None
    stds = (fix.std_east_m, fix.std_north_m, fix.std_up_m)
    known = None not in stds
    variances = [(std or 0.0) ** 2 for std in stds]
    return msgspec.json.encode(
        {
            "timestamp": _timestamp(wall_ns),
            "frame_id": "gnss",
            "latitude": fix.lat_deg,
            "longitude": fix.lon_deg,
            "altitude": fix.height_m or 0.0,
            "position_covariance": [variances[0], 0, 0, 0, variances[1], 0, 0, 0, variances[2]],
            "position_covariance_type": COVARIANCE_DIAGONAL if known else COVARIANCE_UNKNOWN,
        }
    )


def _timestamp(wall_ns: int) -> dict[str, int]:
    return {"sec": wall_ns // NS, "nsec": wall_ns % NS}

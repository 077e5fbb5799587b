"""The picture as the browser gets it: small enough for a tablet in the yard."""

from __future__ import annotations

import cv2
import numpy as np

from navcore.calibration.board import Image

WIDTH_PX = 960
QUALITY = 75


def grey_picture(jpeg: bytes) -> Image | None:
    """(H, W), grey; None without a picture."""
    if not jpeg:
        return None
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION)
    return None if image is None else np.asarray(image, dtype=np.uint8)


def shown_picture(jpeg: bytes, width_px: int) -> bytes:
    """The JPEG itself, or a smaller one of a picture that is wider than the screen's part for it."""
    if width_px <= WIDTH_PX or not jpeg:
        return jpeg
    reduced = cv2.IMREAD_REDUCED_COLOR_2 if width_px < 3 * WIDTH_PX else cv2.IMREAD_REDUCED_COLOR_4
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), reduced | cv2.IMREAD_IGNORE_ORIENTATION)
    if image is None:
        return b""
    _, smaller = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, QUALITY))
    return smaller.tobytes()

"""A picture as large as a network's input allows: on the robot, in training and for other people's models alike."""

from __future__ import annotations

import cv2
import numpy as np

from navcore.perception.detector import Image


def fit_picture(image: Image, height_px: int, width_px: int) -> tuple[Image, float]:
    """The picture shrunk or enlarged to fit into that size, its shape kept, and how many times as large it is."""
    scale = min(width_px / image.shape[1], height_px / image.shape[0])
    if scale == 1.0:
        return image, scale
    method = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_LINEAR
    fitted = np.asarray(cv2.resize(image, None, fx=scale, fy=scale, interpolation=method), dtype=np.uint8)
    return fitted[:height_px, :width_px], scale

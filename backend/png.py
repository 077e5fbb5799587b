"""Pictures as PNG."""

from __future__ import annotations

import numpy as np
from cv2 import COLOR_RGBA2BGRA, cvtColor, imencode
from numpy.typing import NDArray


def encode_png(rgba: NDArray[np.uint8]) -> bytes:
    """Lossless, with alpha."""
    done, data = imencode(".png", cvtColor(rgba, COLOR_RGBA2BGRA))
    assert done
    return bytes(data)

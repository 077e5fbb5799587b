"""One object per foot: a vine before its post, or one thing seen as both, must not weigh twice in a row's fit.

Where feet that stand so close all counted, three of seven real rows were seen and not five.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.box_decoding import DecodingParams, suppress

ONE_PER_FOOT = DecodingParams(across_kinds=True)
# The width that its distances are meant for, px.
_WIDTH_PX = 640


def one_per_foot(objects: Sequence[DetectedObject], width_px: int) -> NDArray[np.int64]:
    """Which objects, best first, of a picture of that width are no double of a surer one, whatever its class."""
    boxes = np.array([(o.x1, o.y1, o.x2, o.y2) for o in objects], dtype=np.float64).reshape(-1, 4)
    kinds = np.array([o.kind is ObjectKind.POST for o in objects], dtype=np.int64)
    near = replace(ONE_PER_FOOT, foot_distance_px=ONE_PER_FOOT.foot_distance_px * width_px / _WIDTH_PX)
    return np.array(suppress(boxes, kinds, near), dtype=np.int64)

"""How much memory a map takes by its area: a mapped block laid beside itself until the area is reached."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams

Floats = NDArray[np.float64]
# A tenth of the smallest cell: no cell that is one loses the points that make it.
_VOXEL = 0.05


def grown_map_bytes(
    keyframes: Sequence[Keyframe], poses: Sequence[SE3], block: Floats, hectares: float, params: NdtMapParams
) -> int:
    """Memory of the cells of a map of so many hectares, bytes; `block` (4,) is the driven rectangle, x0, y0, x1, y1.

    What was seen inside the rectangle is laid beside itself, the last column in part.
    """
    points = _inside(keyframes, poses, block)
    width, height = block[2] - block[0], block[3] - block[1]
    grown, left = NdtMap(params), hectares * 10_000.0
    across = max(1, math.ceil(math.sqrt(left / (width * height)) * math.sqrt(height / width)))
    n = 0
    while left > 1e-6:
        share = min(1.0, left / (width * height))
        tile = points[points[:, 0] < block[0] + share * width]
        grown.add(np.asarray(tile + np.array((n % across * width, n // across * height, 0.0))))
        left -= share * width * height
        n += 1
    return grown.nbytes


def _inside(keyframes: Sequence[Keyframe], poses: Sequence[SE3], block: Floats) -> Floats:
    pieces = [np.empty((0, 3))]
    for keyframe, T in zip(keyframes, poses, strict=True):
        points = T.apply(keyframe.points.astype(np.float64))
        kept = ((points[:, :2] >= block[:2]) & (points[:, :2] < block[2:])).all(axis=1)
        pieces.append(points[kept])
    return voxel_means(np.concatenate(pieces), _VOXEL)

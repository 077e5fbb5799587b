"""What the network should say for a labelled picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.training.model import CLASSES, STRIDE
from navcore.training.samples import Labels

Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Targets:
    """Attributes (h = H / 4, w = W / 4).

    heat: (2, h, w) 1 at a foot, falling off around it; -1 where nothing is asked (ignored objects).
    boxes: (4, h, w) as `FootNet` gives them.
    weight: (h, w) of the box values; 0 where no foot is near.
    """

    heat: Singles
    boxes: Singles
    weight: Singles


def targets(labels: Labels, height_px: int, width_px: int) -> Targets:
    """Targets for a picture of that size, multiples of 4. Feet outside of the picture are not asked for."""
    h, w = height_px // STRIDE, width_px // STRIDE
    heat = np.zeros((CLASSES, h, w), dtype=np.float32)
    boxes, weight = np.zeros((4, h, w), dtype=np.float32), np.zeros((h, w), dtype=np.float32)
    # Far objects first, so that the nearer one keeps a cell that both want.
    for i in np.argsort(labels.boxes[:, 3], kind="stable"):
        x1, y1, x2, y2 = labels.boxes[i] / STRIDE
        u, v = (x1 + x2) / 2, y2
        cut = v > h - 0.25 or u < 0 or u >= w
        if labels.ignore[i] or cut:
            _mask(heat, x1, y1, x2, min(v, h))
        else:
            _peak(heat[labels.kinds[i]], u, v)
            _box_values(boxes, weight, (u, v, x2 - x1, y2 - y1))
    return Targets(heat=heat, boxes=boxes, weight=weight)


def _mask(heat: Singles, x1: float, y1: float, x2: float, y2: float) -> None:
    """Nothing is asked around an object that does not count; feet already asked for stay."""
    rows = slice(max(0, int(y1 + 0.7 * (y2 - y1)) - 1), int(y2) + 3)
    part = heat[:, rows, max(0, int(x1) - 1) : int(x2) + 2]
    part[part < 0.5] = -1.0


def _window(centre: float, size: int) -> range:
    return range(max(0, int(centre) - 2), min(size, int(centre) + 3))


def _peak(heat: Singles, u: float, v: float) -> None:
    cell_u, cell_v = int(u), int(v)
    for row in _window(v, heat.shape[0]):
        for column in _window(u, heat.shape[1]):
            fall = np.exp(-((row - cell_v) ** 2 + (column - cell_u) ** 2) / (2 * 0.8**2))
            heat[row, column] = max(heat[row, column], fall)


def _box_values(boxes: Singles, weight: Singles, box: tuple[float, float, float, float]) -> None:
    """Box values at the foot's cell and, with less weight, at its neighbours."""
    u, v, width, height = box
    for row in range(max(0, int(v) - 1), min(weight.shape[0], int(v) + 2)):
        for column in range(max(0, int(u) - 1), min(weight.shape[1], int(u) + 2)):
            own = row == int(v) and column == int(u)
            boxes[:, row, column] = u - column - 0.5, v - row - 0.5, np.log(max(width, 0.1)), np.log(max(height, 0.1))
            weight[row, column] = 1.0 if own else 0.3

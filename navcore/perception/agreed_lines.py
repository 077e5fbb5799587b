"""The lines of one row that several guesses of its camera agree on: medians in the picture, weighted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from navcore.messages import CameraView, ImageLine


def agreed_lines(best: CameraView, views: Sequence[CameraView], weights: Sequence[float]) -> CameraView:
    """`best` with the lines that most of the `views`, by weight, have about there; all are of one picture.

    A line crosses two rows of pixels: the lowest, and one half-way from there to where the best lines meet.
    """
    if best.left is None or best.right is None or best.centre is None:
        return best
    bottom, far = float(best.height_px), min(best.left.v1, best.right.v1)
    at = (bottom, (bottom + far) / 2)
    left = _agreed(best.left, [v.left for v in views], weights, at)
    right = _agreed(best.right, [v.right for v in views], weights, at)
    centre = _agreed(best.centre, [v.centre for v in views], weights, at)
    meet = _meet(left, right)
    return replace(best, left=_below(left, meet), right=_below(right, meet), centre=_below(centre, meet))


def _agreed(
    best: ImageLine, lines: Sequence[ImageLine | None], weights: Sequence[float], at: tuple[float, float]
) -> ImageLine:
    """As long as the best one."""
    usable = [(line, w) for line, w in zip(lines, weights, strict=True) if line and abs(line.v1 - line.v0) > 1.0]
    heavy = [w for _, w in usable]
    low, high = (_median([_u(line, v) for line, _ in usable], heavy) for v in at)
    agreed = ImageLine(u0=low, v0=at[0], u1=high, v1=at[1])
    return ImageLine(u0=_u(agreed, best.v0), v0=best.v0, u1=_u(agreed, best.v1), v1=best.v1)


def _meet(left: ImageLine, right: ImageLine) -> float:
    """The row of pixels in which they meet; above the picture where they do not."""
    low, high = _u(right, left.v0) - left.u0, _u(right, left.v1) - left.u1
    return left.v0 + (left.v1 - left.v0) * low / (low - high) if low > high else -1.0


def _below(line: ImageLine, v: float) -> ImageLine:
    """What of it lies below where the lines meet."""
    end = max(line.v1, v)
    return replace(line, u1=_u(line, end), v1=end)


def _u(line: ImageLine, v: float) -> float:
    return line.u0 + (line.u1 - line.u0) * (v - line.v0) / (line.v1 - line.v0)


def _median(values: Sequence[float], weights: Sequence[float]) -> float:
    """The least value up to which half of the weight lies."""
    order = np.argsort(values, kind="stable")
    share = np.cumsum(np.asarray(weights)[order])
    return float(np.asarray(values)[order][np.searchsorted(share, share[-1] / 2)])

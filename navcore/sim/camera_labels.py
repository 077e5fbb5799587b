"""True boxes of the trunks and posts in a rendered picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import ObjectKind
from navcore.sim.render.buffers import Floats, View
from navcore.sim.render.compiled import compiled


@dataclass(frozen=True, slots=True, kw_only=True)
class LabelParams:
    """What counts as an object; what is seen but does not count is labelled `ignore`.

    Attributes:
        min_visible: share of the object's pixels that must be seen, 0 to 1.
        min_height_px: of the box, in a picture 640 px wide.
        max_range: distance from the camera, m.
        nearest_rows: objects of so many rows count, of those that are nearest to the camera.
        min_pixels: fewer visible pixels give no label at all.
    """

    min_visible: float = 0.4
    min_height_px: float = 14.0
    max_range: float = 12.0
    nearest_rows: int = 2
    min_pixels: int = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class RenderedObject:
    """A trunk or post in the picture.

    Attributes:
        x1, y1, x2, y2: box of its visible pixels, px, origin top left.
        visible: share of it that is not hidden, of what lies inside the picture.
        range: distance on the ground from the camera to its foot, m.
        rows_nearer: how many rows are nearer to the camera than the object's; -1 for one that stands in no row.
        foot_visible: the lowest visible pixel is where it meets the ground.
        foot_u, foot_v: where its foot is in the picture, px, whether hidden or not.
        ignore: too far, too small, too hidden or of too far a row to count.
    """

    kind: ObjectKind
    x1: float
    y1: float
    x2: float
    y2: float
    visible: float
    range: float
    rows_nearer: int
    foot_visible: bool
    foot_u: float
    foot_v: float
    ignore: bool


def label_objects(
    view: View, owner: NDArray[np.int32], tubes: Floats, trunks: int, rows_nearer: NDArray[np.int64],
    params: LabelParams,
) -> tuple[RenderedObject, ...]:  # fmt: skip
    """Objects seen in an owner layer (H, W); tubes (N, 5, 4) are trunks first, then posts, numbered from 1.

    `rows_nearer` (N,) as in `RenderedObject`.
    """
    boxes = visible_boxes(owner, len(tubes) + 1)[1:]
    seen = np.flatnonzero(boxes[:, 4] >= params.min_pixels)
    box = boxes[seen].astype(np.float64)
    box[:, 2:4] += 1.0
    foot, head = _pixels(view, tubes[seen, 0]), _pixels(view, tubes[seen, -1])
    visible = np.minimum(box[:, 4] / np.maximum(_full_area(view, foot, head), 1.0), 1.0)
    away = np.hypot(tubes[seen, 0, 0] - view.centre[0], tubes[seen, 0, 1] - view.centre[1])
    at_foot = np.abs(box[:, 3] - foot[:, 1]) < np.maximum(2.0, 0.04 * (foot[:, 1] - head[:, 1]))
    at_foot &= foot[:, 1] <= view.height
    small = box[:, 3] - box[:, 1] < params.min_height_px * view.width / 640
    rank = rows_nearer[seen]
    elsewhere = (rank < 0) | (rank >= params.nearest_rows)
    ignore = (visible < params.min_visible) | small | (away > params.max_range) | elsewhere
    return tuple(
        RenderedObject(
            kind=ObjectKind.TRUNK if i < trunks else ObjectKind.POST, x1=b[0], y1=b[1], x2=b[2], y2=b[3], visible=v,
            range=r, rows_nearer=n, foot_visible=f, foot_u=u, foot_v=w, ignore=g,
        )
        for i, b, v, r, n, f, (u, w, _), g in zip(
            seen.tolist(), box.tolist(), visible.tolist(), away.tolist(), rank.tolist(), at_foot.tolist(),
            foot.tolist(), ignore.tolist(), strict=True,
        )
    )  # fmt: skip


def rows_nearer(view: View, line: NDArray[np.int64], lines: Floats) -> NDArray[np.int64]:
    """For objects of the given lines (N,), how many lines (L, 4) pass nearer to the camera; -1 where `line` is."""
    start, along = lines[:, :2], lines[:, 2:] - lines[:, :2]
    to = np.array(view.centre[:2]) - start
    share = np.clip((to * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-9), 0.0, 1.0)
    order = np.argsort(np.hypot(*(to - share[:, None] * along).T), kind="stable")
    rank = np.empty(len(lines) + 1, dtype=np.int64)
    rank[order], rank[-1] = np.arange(len(lines)), -1
    return rank[line]


def _pixels(view: View, rings: Floats) -> Floats:
    """Middle and half width, px, of rings (N, 4), shape (N, 3); a foot counts where it meets the ground."""
    d = np.column_stack((rings[:, :2], np.maximum(rings[:, 2], 0.0))) - view.centre
    x, y, z = d @ view.right, d @ view.down, np.maximum(d @ view.forward, 0.12)
    return np.column_stack((view.cx + view.fx * x / z, view.cy + view.fy * y / z, view.fx * rings[:, 3] / z))


def _full_area(view: View, foot: Floats, head: Floats) -> Floats:
    """Pixels that unhidden tubes would fill inside the picture, (N,)."""
    t = ((np.arange(32) + 0.5) / 32)[:, None]
    u, v, half = (foot[:, k] + t * (head[:, k] - foot[:, k]) for k in range(3))
    half = np.maximum(half, 0.35)
    wide = np.clip(u + half, 0, view.width) - np.clip(u - half, 0, view.width)
    inside = (v >= 0) & (v < view.height)
    return np.asarray((wide * inside).sum(axis=0) * np.abs(foot[:, 1] - head[:, 1]) / 32)


@compiled
def visible_boxes(owner: NDArray[np.int32], owners: int) -> NDArray[np.int32]:
    """Per owner: first and last column and row, and number of pixels; (owners, 5) as x, y, x, y, count."""
    height, width = owner.shape
    boxes = np.zeros((owners, 5), np.int32)
    boxes[:, 0], boxes[:, 1] = width, height
    for y in range(height):
        for x in range(width):
            k = owner[y, x]
            if k > 0:
                boxes[k, 0], boxes[k, 1] = min(boxes[k, 0], x), min(boxes[k, 1], y)
                boxes[k, 2], boxes[k, 3] = max(boxes[k, 2], x), max(boxes[k, 3], y)
                boxes[k, 4] += 1
    return boxes

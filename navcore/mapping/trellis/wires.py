"""Wires between neighbouring posts: thin straight lines along the row that stay from season to season."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from navcore.mapping.trellis.posts import Post

Floats = NDArray[np.float64]
Point3 = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class WireParams:
    """Parameters of `find_wires`.

    Attributes:
        longest: posts further apart have no wire between them, m.
        beside: how far out of the line of posts wires run, m: 1.35 m on the arms of paper C's trellis.
        low, high: band of heights, m.
        cell: edge of a cell of the picture across the row, m. piece: length of a piece along the row, m.
        ends: what is left out beside each post, m: its arms hide the wires' ends.
        filled: share of the pieces in which a wire must be hit in one run, 0 to 1. again: in the others that count as
            having seen it: leaves hide a wire for most of its length.
        contrast: how many times more of the pieces than the cells around must be hit.
        apart: two wires run no nearer to each other than this, m.
        persistence: share of the runs in which a wire must be found, 0 to 1.
    """

    longest: float = 10.0
    beside: float = 1.7
    low: float = 0.35
    high: float = 3.4
    cell: float = 0.04
    piece: float = 0.2
    ends: float = 0.4
    filled: float = 0.6
    again: float = 0.2
    contrast: float = 1.6
    apart: float = 0.2
    persistence: float = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Wire:
    """A wire between two posts of a line.

    Attributes:
        begin, end: at the first and the second post, in `map`, m.
        std: 1-sigma across, m. filled: share of its length on which it was hit.
        times_seen: runs that saw it.
    """

    begin: Point3
    end: Point3
    std: float
    filled: float
    times_seen: int


def find_wires(
    posts: tuple[Post, Post], runs: Sequence[Floats], params: WireParams = WireParams()
) -> tuple[Wire, ...]:
    """Wires between two neighbouring posts, from the points of each run near them (N, 3), z the height above ground.

    A run's picture across the row has a cell for each side and height: a wire fills one of them all along. What grows
    fills many of them here and there.
    """
    span = _Span(posts, params)
    if not 1.0 < span.length <= params.longest:
        return ()
    inside = [span.local(points) for points in runs]
    pictures = [span.picture(points) for points in inside]
    both = np.max(pictures, axis=0)
    found = [span.wire(cell, inside, pictures) for cell in _peaks(both, params)]
    wanted = params.persistence * len(runs)
    return tuple(wire for wire in found if wire is not None and wire.times_seen >= wanted)


def _peaks(picture: Floats, params: WireParams) -> list[tuple[int, int]]:
    """Cells (side, height) that are filled along the row and stand out, the fullest first."""
    near = ndimage.maximum_filter(picture, size=2 * round(params.apart / params.cell / 2) + 1, mode="constant")
    around = ndimage.uniform_filter(picture, size=9, mode="nearest")
    peak = (picture == near) & (picture >= params.filled) & (picture >= params.contrast * around)
    cells = np.argwhere(peak)
    order = np.argsort(-picture[peak], kind="stable")
    kept: list[tuple[int, int]] = []
    for side, height in cells[order].tolist():
        if all(max(abs(side - s), abs(height - h)) * params.cell >= params.apart for s, h in kept):
            kept.append((side, height))
    return kept


class _Span:
    """Between two posts: x along, y to the left, z above the ground."""

    def __init__(self, posts: tuple[Post, Post], params: WireParams) -> None:
        self._posts, self._params = posts, params
        a, b = posts
        self._origin = np.array((a.x, a.y))
        d = np.array((b.x, b.y)) - self._origin
        self.length = float(np.hypot(*d))
        self._unit = d / max(self.length, 1e-9)
        self._shape = (round(2 * params.beside / params.cell), round((params.high - params.low) / params.cell))

    def local(self, points: Floats) -> Floats:
        """Points that lie between the posts, in the span's own axes."""
        p, d = self._params, points[:, :2] - self._origin
        x = d @ self._unit
        y = d @ (-self._unit[1], self._unit[0])
        z = points[:, 2]
        inside = (x > p.ends) & (x < self.length - p.ends) & (np.abs(y) < p.beside) & (z > p.low) & (z < p.high)
        return np.asarray(np.column_stack((x, y, z))[inside])

    def picture(self, points: Floats) -> Floats:
        """Share of the pieces along the row hit in each cell of side and height and the eight around it."""
        p = self._params
        pieces = max(int((self.length - 2 * p.ends) / p.piece), 1)
        hit = np.zeros((pieces, *self._shape), dtype=np.bool_)
        piece = np.clip(((points[:, 0] - p.ends) / p.piece).astype(np.int64), 0, pieces - 1)
        side = ((points[:, 1] + p.beside) / p.cell).astype(np.int64)
        height = ((points[:, 2] - p.low) / p.cell).astype(np.int64)
        hit[piece, np.minimum(side, self._shape[0] - 1), np.minimum(height, self._shape[1] - 1)] = True
        wide = ndimage.maximum_filter(hit, size=(1, 3, 3), mode="constant")
        return np.asarray(wide.mean(axis=0))

    def wire(self, cell: tuple[int, int], runs: list[Floats], pictures: list[Floats]) -> Wire | None:
        """The line through what lies about a cell; None where it is none."""
        p = self._params
        middle = np.array((cell[0] + 0.5, cell[1] + 0.5)) * p.cell + (-p.beside, p.low)
        points = np.concatenate(runs)
        near: Floats = points[np.abs(points[:, 1:] - middle).max(axis=1) <= 2.0 * p.cell]
        A = np.column_stack((np.ones(len(near)), near[:, 0]))
        solution, off = _robust(A, near[:, 1:])
        if off is None:
            return None
        ends = np.array(((1.0, 0.0), (1.0, self.length))) @ solution
        seen = sum(bool(picture[cell] >= p.again) for picture in pictures)
        pieces = np.unique((near[:, 0] / p.piece).astype(np.int64))
        filled = min(len(pieces) / max((self.length - 2 * p.ends) / p.piece, 1.0), 1.0)
        begin, end = (self._in_map(x, y, z, post) for x, (y, z), post in zip((0.0, self.length), ends.tolist(),
                                                                             self._posts, strict=True))  # fmt: skip
        return Wire(begin=begin, end=end, std=off, filled=filled, times_seen=seen)

    def _in_map(self, x: float, y: float, z: float, post: Post) -> Point3:
        place = self._origin + x * self._unit + y * np.array((-self._unit[1], self._unit[0]))
        return float(place[0]), float(place[1]), post.ground + z


def _robust(A: Floats, b: Floats) -> tuple[Floats, float | None]:
    """Line (2, 2) through points b (N, 2) over A (N, 2) by Huber's weights, and their 1-sigma; None for few."""
    solution: Floats = np.zeros((2, 2))
    if len(b) < 8:
        return solution, None
    weights = np.ones(len(b))
    off = np.zeros(len(b))
    for _ in range(5):
        scaled = A * weights[:, None]
        solution = np.asarray(np.linalg.lstsq(scaled.T @ A, scaled.T @ b, rcond=None)[0])
        off = np.linalg.norm(b - A @ solution, axis=1)
        weights = np.minimum(1.0, 0.015 / np.maximum(off, 1e-9))
    return solution, float(np.median(off)) * 1.2 / np.sqrt(min(len(b), 30))

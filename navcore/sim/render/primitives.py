"""What an orchard is drawn from: tubes, beams, cards and panels, sorted into chunks that are culled as one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.render.buffers import Floats

CHUNK_M = 2.5
RINGS = 5


class Chunks(NamedTuple):
    """All primitives of a scene, sorted by chunk.

    Attributes:
        head: (N, 4) middle x, y, z and radius of each chunk, m.
        span: (N, 8) first and last + 1 index of its tubes, beams, cards and panels.
        tubes: (T, 5, 4) x, y, z, radius of five rings from the foot up, m.
        tube_look: (T, 2) material and owner number.
        beams: (B, 9) two ends, radius at each, material.
        cards: (C, 15) middle, half edges u and v (each 3), unit normal, material, tint, keep rank 0 to 1.
        panels: (Q, 4, 5) corners x, y, z, u, v, in order around.
        panel_look: (Q, 4) unit normal and material.
    """

    head: Floats
    span: NDArray[np.int64]
    tubes: Floats
    tube_look: NDArray[np.int64]
    beams: Floats
    cards: Floats
    panels: Floats
    panel_look: Floats


class Primitives(NamedTuple):
    """The same, not yet sorted."""

    tubes: Floats
    tube_look: NDArray[np.int64]
    beams: Floats
    cards: Floats
    panels: Floats
    panel_look: Floats


def upright(p: Primitives, uphill: tuple[float, float]) -> Primitives:
    """The same on sloping land: each point is moved by `uphill` (east, north) for each metre above the ground."""
    tubes, beams, cards, panels = p.tubes.copy(), p.beams.copy(), p.cards.copy(), p.panels.copy()
    for places in (tubes, beams[:, :3], beams[:, 3:6], cards, panels):
        places[..., :2] += places[..., 2:3] * uphill
    return p._replace(tubes=tubes, beams=beams, cards=cards, panels=panels)


def into_chunks(p: Primitives) -> Chunks:
    """Sort primitives into square cells of the ground; each cell that holds any is a chunk."""
    middles, reaches = _spheres(p)
    keys = [_cell(m) for m in middles]
    cells = np.unique(np.concatenate(keys))
    orders = [np.argsort(k, kind="stable") for k in keys]
    span = np.empty((len(cells), 8), dtype=np.int64)
    for i, (key, order) in enumerate(zip(keys, orders, strict=True)):
        span[:, 2 * i] = np.searchsorted(key[order], cells)
        span[:, 2 * i + 1] = np.searchsorted(key[order], cells, side="right")
    head = _heads(cells, np.concatenate(keys), np.concatenate(middles), np.concatenate(reaches))
    t, b, c, q = orders
    return Chunks(head, span, p.tubes[t], p.tube_look[t], p.beams[b], p.cards[c], p.panels[q], p.panel_look[q])


def _spheres(p: Primitives) -> tuple[list[Floats], list[Floats]]:
    """Middle (N, 3) and reach (N,) of all tubes, beams, cards and panels."""
    tubes, panels = p.tubes.mean(axis=1)[:, :3], p.panels.mean(axis=1)[:, :3]
    beams, cards = (p.beams[:, :3] + p.beams[:, 3:6]) / 2, p.cards[:, :3]
    edges = np.linalg.norm(p.cards[:, 3:6], axis=1) + np.linalg.norm(p.cards[:, 6:9], axis=1)
    along = np.linalg.norm(p.beams[:, 3:6] - p.beams[:, :3], axis=1) / 2
    reaches = [_reach(p.tubes[..., :3], tubes) + 0.1, along, edges, _reach(p.panels[..., :3], panels)]
    return [tubes, beams, cards, panels], reaches


def _reach(points: Floats, middles: Floats) -> Floats:
    """Distance of the farthest of (N, K, 3) points from their middle (N, 3)."""
    return np.asarray(np.linalg.norm(points - middles[:, None], axis=2).max(axis=1, initial=0.0))


def _cell(points: Floats) -> NDArray[np.int64]:
    """One number per ground cell of points (N, 3)."""
    ij = np.floor(points[:, :2] / CHUNK_M).astype(np.int64)
    return np.asarray(ij[:, 0] * 1_000_003 + ij[:, 1])


def _heads(cells: NDArray[np.int64], keys: NDArray[np.int64], middles: Floats, reaches: Floats) -> Floats:
    """Bounding spheres of all cells, shape (N, 4)."""
    index = np.searchsorted(cells, keys)
    low, high = np.full((len(cells), 3), np.inf), np.full((len(cells), 3), -np.inf)
    np.minimum.at(low, index, middles)
    np.maximum.at(high, index, middles)
    centre = (low + high) / 2
    radius = np.zeros(len(cells))
    np.maximum.at(radius, index, np.linalg.norm(middles - centre[index], axis=1) + reaches)
    return np.column_stack((centre, radius))

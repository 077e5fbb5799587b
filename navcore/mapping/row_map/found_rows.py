"""Rows to drive: the alleys between neighbouring lines of posts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from navcore.geometry.line2 import Line2
from navcore.mapping.trellis.trellis_reference import TrellisReference, places_of
from navcore.maps.plant_lines import PlantLine, alleys, along, robust_line
from navcore.maps.site_map import Row

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundRowParams:
    """Parameters of `found_blocks`.

    Attributes:
        widest, narrowest: alley between two lines of posts, m.
        road: an alley so many times wider than usual is a way between two blocks, not a row.
        side_by_side: share of the shorter line's length along which two lines of one block lie beside each other.
        end_off: a line that ends so far from the straight edge of its block, m, was cut short by a missing post and
            is taken to the edge; never further than `end_most`, m.
    """

    widest: float = 12.0
    narrowest: float = 1.2
    road: float = 1.8
    side_by_side: float = 0.5
    end_off: float = 0.5
    end_most: float = 13.0


@dataclass(frozen=True, slots=True)
class FoundBlock:
    """Rows side by side, all directed the same way."""

    rows: tuple[Row, ...]


def found_blocks(trellis: TrellisReference, params: FoundRowParams = FoundRowParams()) -> tuple[FoundBlock, ...]:
    """The blocks of a trellis; lines without a neighbour make no row. Rows are numbered through all blocks."""
    blocks: list[FoundBlock] = []
    number = 1
    for family in trellis.families:
        lines = [_plant_line(trellis, k) for k in family]
        for group in _groups(lines, params):
            rows = alleys(_to_the_edges([lines[k] for k in group], params), _plant_spacing(trellis))
            rows = tuple(row for row in rows if params.narrowest <= row.width <= params.widest)
            if rows:
                blocks.append(FoundBlock(tuple(_numbered(row, number + k) for k, row in enumerate(rows))))
                number += len(rows)
    return tuple(blocks)


def _numbered(row: Row, number: int) -> Row:
    return replace(row, id=f"row-{number}", name=f"Row {number}")


def _plant_line(trellis: TrellisReference, k: int) -> PlantLine:
    """A line from its first upright to its last: where the last post is missing, the trunks go on."""
    posts = places_of([trellis.posts[i] for i in trellis.lines[k]])
    line = robust_line(posts)
    trunks = places_of(trellis.trunks)
    beside = np.abs(line.distances(trunks)) <= 0.4
    reach = along(line, np.concatenate((posts, trunks[beside])))
    ends = [
        line.project(*(reach_at * np.array((line.ny, -line.nx))).tolist()) for reach_at in (reach.min(), reach.max())
    ]
    inner = posts[1:-1] if len(posts) > 2 else np.zeros((0, 2))
    return PlantLine(f"{k + 1:04d}", line, np.vstack((ends[0], inner, ends[1])))


def _plant_spacing(trellis: TrellisReference) -> float | None:
    """Usual distance of trunks along a line, m; None where few were found."""
    gaps = []
    places = places_of(trellis.trunks)
    for line in trellis.lines:
        fit = robust_line(places_of([trellis.posts[i] for i in line]))
        spots = np.sort(along(fit, places[np.abs(fit.distances(places)) <= 0.4]))
        gaps.append(np.diff(spots))
    every = np.concatenate([np.zeros(0), *gaps])
    return round(float(np.median(every)), 2) if len(every) >= 3 and np.median(every) >= 0.1 else None


def _groups(lines: Sequence[PlantLine], params: FoundRowParams) -> list[list[int]]:
    """Indices of lines that lie beside each other, block by block."""
    apart = {(i, j): _apart(lines[i], lines[j], params) for i in range(len(lines)) for j in range(i)}
    beside = {pair: away for pair, away in apart.items() if params.narrowest <= away <= params.widest}
    usual = _usual_alley(beside, len(lines))
    pairs = [pair for pair, away in beside.items() if away <= params.road * usual]
    i, j = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    graph = coo_array((np.ones(len(pairs)), (i, j)), shape=(len(lines), len(lines)))
    count, label = connected_components(graph, directed=False)
    return [np.nonzero(label == k)[0].tolist() for k in range(count)]


def _usual_alley(beside: Mapping[tuple[int, int], float], lines: int) -> float:
    """How far the nearest line is from a line, m, in the middle of all; 0 where none has one."""
    nearest = [min((away for pair, away in beside.items() if k in pair), default=np.inf) for k in range(lines)]
    known = [away for away in nearest if np.isfinite(away)]
    return float(np.median(known)) if known else 0.0


def _apart(a: PlantLine, b: PlantLine, params: FoundRowParams) -> float:
    """Between two lines, m; infinite where they do not lie side by side."""
    s, t = along(a.line, a.points), along(a.line, b.points)
    shared = min(s.max(), t.max()) - max(s.min(), t.min())
    if shared < params.side_by_side * min(np.ptp(s), np.ptp(t)):
        return np.inf
    return float(np.abs(a.line.distances(b.points)).mean())


def _to_the_edges(lines: list[PlantLine], params: FoundRowParams) -> list[PlantLine]:
    """Lines of a block taken out to its straight edges, where most of them end."""
    if len(lines) < 3:
        return lines
    first = lines[0].line
    same = [item if item.line.nx * first.nx + item.line.ny * first.ny >= 0.0 else
            PlantLine(item.name, item.line.reversed(), item.points[::-1]) for item in lines]  # fmt: skip
    for end in (0, -1):
        outer = np.array([item.points[end] for item in same])
        edge = robust_line(outer)
        same = [_to_edge(item, edge, end, params) for item in same]
    return same


def _to_edge(item: PlantLine, edge: Line2, end: int, params: FoundRowParams) -> PlantLine:
    meeting = item.line.intersection(edge)
    if meeting is None:
        return item
    sign = 1.0 if end == -1 else -1.0
    short = sign * float((along(item.line, np.array([meeting])) - along(item.line, item.points[end][None]))[0])
    if not params.end_off < short <= params.end_most:
        return item
    points = item.points.copy()
    points[end] = meeting
    return PlantLine(item.name, item.line, points)

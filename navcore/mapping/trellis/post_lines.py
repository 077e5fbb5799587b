"""Lines of posts: parallel families of straight lines, each block's its own."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.trellis.line_gaps import breaks
from navcore.maps.plant_lines import robust_line

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PostLineParams:
    """Parameters of `post_lines`.

    Attributes:
        nearest, furthest: distances between neighbouring posts of a line, m.
        plants: vines that were trained as high as their posts stand this near to each other, m, at most `nearest`.
        closer: vines are taken for posts where so many times as many uprights then stand in lines side by side.
        parallel_deg: lines of a family differ by less in direction, deg.
        off: a post stands no further from its line than this, m.
        fewest: posts that make a line.
        break_at: a gap of so many times the line's usual spacing ends it, and another block begins, where the lines
            beside it have one too.
    """

    nearest: float = 2.0
    furthest: float = 15.0
    plants: float = 1.0
    closer: float = 1.5
    parallel_deg: float = 4.0
    off: float = 0.4
    fewest: int = 3
    break_at: float = 3.5


def post_lines(places: Floats, params: PostLineParams = PostLineParams()) -> tuple[tuple[Ints, ...], ...]:
    """Families of parallel lines of posts at places (P, 2), m: of each line its posts' indices in the order along it.

    The direction that joins most posts into lines comes first, and so on with those left. Lines of a family come side
    by side, each in the same sense.
    """
    left = np.arange(len(places))
    families: list[tuple[Ints, ...]] = []
    while len(left) >= params.fewest:
        family = _family(places, left, params)
        if not family:
            break
        families.append(tuple(family))
        left = np.setdiff1d(left, np.concatenate(family))
    return tuple(families)


def upright_lines(places: Floats, params: PostLineParams = PostLineParams()) -> tuple[tuple[Ints, ...], ...]:
    """Families of lines as `post_lines` finds them; where most are left over, vines may stand in them like posts."""
    families = post_lines(places, params)
    if params.closer * _side_by_side(families) >= len(places):
        return families
    closer = post_lines(places, replace(params, nearest=params.plants))
    return closer if _side_by_side(closer) > params.closer * _side_by_side(families) else families


def _side_by_side(families: Sequence[Sequence[Ints]]) -> int:
    """Posts in lines that have another beside them."""
    return sum(len(line) for family in families if len(family) > 1 for line in family)


def _family(places: Floats, left: Ints, params: PostLineParams) -> list[Ints]:
    """The lines of the direction that most pairs of neighbours have."""
    heading = _heading(places[left], params)
    if heading is None:
        return []
    unit, normal = (math.cos(heading), math.sin(heading)), (-math.sin(heading), math.cos(heading))
    across = places[left] @ normal
    order = np.argsort(across, kind="stable")
    cuts = np.nonzero(np.diff(across[order]) > params.off)[0] + 1
    straight = [_straight(places, left[part], unit, params) for part in np.split(order, cuts)]
    laid = [line for line in straight if len(line) >= 2]
    means = np.array([(places[line] @ normal).mean() for line in laid])
    spots = [places[line] @ unit for line in laid]
    parts = [part for k in range(len(laid)) for part in _parts(k, laid, spots, means, params)]
    known = np.array([(places[part] @ normal).mean() for part in parts if len(part) >= params.fewest])
    lines = [(float((places[part] @ normal).mean()), part) for part in parts]
    return [
        part
        for across, part in sorted(lines, key=lambda item: item[0])
        if len(part) >= params.fewest or _at_row_spacing(across, known, params)
    ]


def _at_row_spacing(across: float, known: Floats, params: PostLineParams) -> bool:
    """Whether two posts that are left of a line stand where the other lines' even spacing has one."""
    spacings = np.diff(np.unique(np.round(known, 1)))
    if len(spacings) < 2 or spacings.min() < params.nearest:
        return False
    steps = (across - known) / float(spacings.min())
    return bool(np.abs(steps - np.round(steps)).max() * spacings.min() <= params.off)


def _heading(points: Floats, params: PostLineParams) -> float | None:
    """The direction, in [0, pi), that most pairs within reach have; None without any."""
    d = points[None] - points[:, None]
    far = np.hypot(d[..., 0], d[..., 1])
    i, j = np.nonzero(np.triu((far >= params.nearest) & (far <= params.furthest), 1))
    if not len(i):
        return None
    angles = np.arctan2(d[i, j, 1], d[i, j, 0]) % math.pi
    bins = round(180.0 / params.parallel_deg * 2)
    votes = np.bincount((angles / math.pi * bins).astype(np.int64) % bins, 1.0 / far[i, j], minlength=bins)
    best = (int(np.argmax(votes + np.roll(votes, 1) + np.roll(votes, -1))) + 0.5) * math.pi / bins
    off = (angles - best + math.pi / 2) % math.pi - math.pi / 2
    near = np.abs(off) <= math.radians(params.parallel_deg)
    # Long baselines tell a direction better than short ones.
    return float((best + np.average(off[near], weights=far[i, j][near] ** 2)) % math.pi)


def _straight(places: Floats, group: Ints, unit: tuple[float, float], params: PostLineParams) -> Ints:
    """Those of a group on the line through most of them, in order; none where they stand too close for posts."""
    ordered = group[np.argsort(places[group] @ unit, kind="stable")]
    if len(ordered) < 2:
        return ordered[:0]
    kept = ordered[np.abs(robust_line(places[ordered]).distances(places[ordered])) <= params.off]
    close = len(kept) < 2 or float(np.median(np.diff(places[kept] @ unit))) < params.nearest
    return kept[:0] if close else kept


def _parts(
    k: int, laid: Sequence[Ints], spots: Sequence[Floats], across: Floats, params: PostLineParams
) -> list[Ints]:
    """Line `k`, cut where it crosses a headland."""
    return [part for part in np.split(laid[k], breaks(k, spots, across, params.break_at)) if len(part) >= 2]

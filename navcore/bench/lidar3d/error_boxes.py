"""Errors at the fixed points as box plots, as paper C shows them: a panel lateral and one heading, an SVG drawing.

A box holds the middle half of the errors and a line at their median; whiskers reach to the smallest and the largest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import resources

import numpy as np
from jinja2 import Environment, StrictUndefined
from numpy.typing import NDArray

from navcore.bench.lidar3d.fixed_point_figures import SEASONS, WAYS, Drives, at_fixed_points

Floats = NDArray[np.float64]
WIDTH_PX, HEIGHT_PX, LEFT_PX, TOP_PX, GAP_PX, BOX_PX = 420, 240, 60, 76, 70, 26
INKS = {"rtk": "#c98a1b", "map": "#3b6fb6", "fused": "#12733a"}
_STEPS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """Places on the panel, px, from above: `top` and `bottom` of the whiskers, `high` and `low` of the box."""

    x: float
    top: float
    high: float
    median: float
    low: float
    bottom: float
    ink: str
    count: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One kind of error, at that place of the drawing, px; `levels`, `seasons`: places and words of the axes."""

    title: str
    x: float
    levels: tuple[tuple[float, str], ...]
    seasons: tuple[tuple[float, str], ...]
    boxes: tuple[Box, ...]


def error_boxes(driven: Drives, rows: tuple[int, ...]) -> str:
    """The drawing; a way that says nothing at any point of a season has no box."""
    errors = {
        (season, way): np.array(at_fixed_points(driven.get(season, []), rows, way)).reshape(-1, 2)
        for season in SEASONS
        for way in WAYS
    }
    panels = [
        _panel("lateral error, cm, left is up", 0, [100.0 * e[:, 0] for e in errors.values()]),
        _panel("heading error, deg", 1, [180.0 / math.pi * e[:, 1] for e in errors.values()]),
    ]
    page = resources.files("navcore.bench.lidar3d").joinpath("error_boxes.svg.j2").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    keys = [{"x": 12 + 160 * k, "ink": INKS[way], "name": name} for k, (way, name) in enumerate(WAYS.items())]
    return environment.from_string(page).render(
        title="Errors at the fixed points at 1.0 m/s, simulated", keys=keys, panels=panels, height=HEIGHT_PX,
        width=WIDTH_PX, box=BOX_PX, top=TOP_PX, whole_width=LEFT_PX + 2 * (WIDTH_PX + GAP_PX),
        whole_height=TOP_PX + HEIGHT_PX + 50,
    )  # fmt: skip


def _panel(title: str, column: int, errors: Sequence[Floats]) -> Panel:
    """`errors` season by season, way by way."""
    step = _step(max((float(np.abs(e).max()) for e in errors if len(e)), default=1.0))
    edge = 4.0 * step

    def down(value: float) -> float:
        return HEIGHT_PX * (edge - value) / (2.0 * edge)

    boxes = [
        _box(e, WIDTH_PX * (k // 3 + 0.25 * (k % 3 + 1)) / 3.0, down, ink)
        for k, (e, ink) in enumerate(zip(errors, 3 * list(INKS.values()), strict=True))
        if len(e)
    ]
    return Panel(
        title=title, x=LEFT_PX + column * (WIDTH_PX + GAP_PX), boxes=tuple(boxes),
        levels=tuple((down(k * step), f"{k * step:g}") for k in range(-4, 5)),
        seasons=tuple((WIDTH_PX * (k + 0.5) / 3.0, name) for k, name in enumerate(SEASONS.values())),
    )  # fmt: skip


def _step(largest: float) -> float:
    """Four of them reach beyond the largest error."""
    return next((step for step in _STEPS if 4.0 * step >= largest), largest / 4.0)


def _box(errors: Floats, x: float, down: Callable[[float], float], ink: str) -> Box:
    bottom, low, median, high, top = (down(float(q)) for q in np.percentile(errors, (0, 25, 50, 75, 100)))
    return Box(x=x, top=top, high=high, median=median, low=low, bottom=bottom, ink=ink, count=len(errors))

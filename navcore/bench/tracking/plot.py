"""How far off the path along the way, one panel a course and speed, one line a drive: an SVG drawing."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib import resources

from jinja2 import Environment, StrictUndefined

from navcore.bench.tracking.cases import Localization, Rival
from navcore.bench.tracking.courses import Course
from navcore.bench.tracking.drive import TrackingResult

WIDTH_PX, HEIGHT_PX, LEFT_PX, TOP_PX, GAP_PX = 380, 170, 60, 76, 52
# Left and right of the path at the panels' edges, cm; what is further off is cut there.
EDGE_CM = 15.0
DRAWN = {Rival.PUBLISHED: "#c98a1b", Rival.LINE: "#3b6fb6", Rival.LQR: "#12733a"}
# A panel stays readable with so many drives of each.
MOST_DRIVES = 6


@dataclass(frozen=True, slots=True)
class Line:
    """Points as SVG wants them, px."""

    points: str
    ink: str


@dataclass(frozen=True, slots=True)
class Panel:
    """A course at a speed, at that place of the drawing, px; `levels` and `ways` are places and words of the axes."""

    title: str
    x: float
    y: float
    width: float
    height: float
    levels: tuple[tuple[float, str], ...]
    ways: tuple[tuple[float, str], ...]
    lines: tuple[Line, ...]


def tracking_plot(results: Iterable[TrackingResult], where: Localization) -> str:
    """The drives by one kind of localization as a page of panels."""
    drives = [r for r in results if r.case.localization is where and r.case.rival in DRAWN and r.trace]
    speeds = sorted({r.case.speed for r in drives})
    panels = [
        _panel([r for r in drives if r.case.course is course and r.case.speed == v], f"{course} at {v} m/s", i, j)
        for j, course in enumerate(Course)
        for i, v in enumerate(speeds)
    ]
    page = resources.files("navcore.bench.tracking").joinpath("plot.svg.j2").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    keys = [{"x": 12 + 230 * k, "ink": ink, "name": str(rival)} for k, (rival, ink) in enumerate(DRAWN.items())]
    return environment.from_string(page).render(
        title=f"Off the path, cm, by metres along it; simulated, {where}", keys=keys, panels=panels,
        width=LEFT_PX + max(len(speeds), 1) * (WIDTH_PX + GAP_PX), height=TOP_PX + len(Course) * (HEIGHT_PX + GAP_PX),
    )  # fmt: skip


def _panel(drives: Sequence[TrackingResult], title: str, column: int, row: int) -> Panel:
    longest = max((s for r in drives for s, _ in r.trace), default=1.0)
    kept = [r for rival in DRAWN for r in [d for d in drives if d.case.rival is rival][:MOST_DRIVES]]
    lines = tuple(Line(_points(r.trace, longest), DRAWN[r.case.rival]) for r in kept)
    levels = tuple((_down(cm), f"{cm:g}") for cm in (-15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0))
    ways = tuple((WIDTH_PX * s / longest, f"{s:.0f} m") for s in (0.0, longest / 2, longest))
    x, y = LEFT_PX + column * (WIDTH_PX + GAP_PX), TOP_PX + row * (HEIGHT_PX + GAP_PX)
    return Panel(title, x, y, WIDTH_PX, HEIGHT_PX, levels, ways, lines)


def _points(trace: Sequence[tuple[float, float]], longest: float) -> str:
    return " ".join(f"{WIDTH_PX * s / longest:.1f},{_down(100.0 * lateral):.1f}" for s, lateral in trace)


def _down(cm: float) -> float:
    """Left of the path is up."""
    held = min(max(cm, -EDGE_CM), EDGE_CM)
    return HEIGHT_PX * (EDGE_CM - held) / (2.0 * EDGE_CM)

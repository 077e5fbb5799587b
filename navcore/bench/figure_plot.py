"""Figures of one unit on a common axis: what was measured with its interval, and what it stands beside."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from navcore.bench.figure_file import MadeFigure

LABEL_PX, AXIS_PX, ROW_PX, EDGE_PX = 390, 400, 22, 26
# Steps of an axis, at most about.
STEPS = 6
# What differs by less is drawn as one.
LEAST = 1e-9


@dataclass(frozen=True, slots=True)
class Mark:
    """Places on the axis, px; None where there is nothing to mark."""

    name: str
    y: float
    value: float
    low: float | None
    high: float | None
    paper: float | None
    baseline: float | None
    target: float | None
    ok: bool | None


@dataclass(frozen=True, slots=True)
class Plot:
    """A drawing of that size, px; `ticks` are places and words of the axis."""

    unit: str
    width: float
    height: float
    marks: tuple[Mark, ...]
    ticks: tuple[tuple[float, str], ...]


@dataclass(frozen=True, slots=True)
class Axis:
    """From `low` to `high` in steps, in the figures' unit."""

    low: float
    high: float
    step: float

    def place(self, number: float | None) -> float | None:
        """px from the left edge."""
        return None if number is None else LABEL_PX + AXIS_PX * (number - self.low) / (self.high - self.low)

    @property
    def ticks(self) -> list[float]:
        """The steps from `low` to `high`."""
        return [self.low + self.step * k for k in range(round((self.high - self.low) / self.step) + 1)]


def plot(figures: Sequence[MadeFigure]) -> Plot | None:
    """None where nothing was measured, or only one thing with nothing beside it."""
    shown = [figure for figure in figures if figure.value is not None]
    numbers = [number for figure in shown for number in _numbers(figure)]
    if len(numbers) < 2:
        return None
    unit = shown[0].unit
    axis = _axis(min(numbers), max(numbers), share=unit == "share")
    marks = tuple(_mark(figure, axis, EDGE_PX / 2 + ROW_PX * k) for k, figure in enumerate(shown))
    height = EDGE_PX + ROW_PX * len(marks)
    return Plot(unit, LABEL_PX + AXIS_PX + EDGE_PX, height + EDGE_PX / 2, marks, _ticks(axis, share=unit == "share"))


def _numbers(figure: MadeFigure) -> list[float]:
    told = (figure.value, figure.low, figure.high, figure.paper, figure.baseline, figure.target)
    return [number for number in told if number is not None]


def _axis(least: float, most: float, *, share: bool) -> Axis:
    """Round numbers. Shares end at 100 %, and everything else begins at 0 unless it is less."""
    low, high = (0.0 if least < 0.5 else least, 1.0) if share else (min(0.0, least), max(most, 0.0))
    step = _round_step((high - low if high - low > LEAST else 1.0) / STEPS)
    low, high = step * math.floor(low / step + 1e-9), step * math.ceil(high / step - 1e-9)
    return Axis(low, high if high > low else low + step, step)


def _round_step(step: float) -> float:
    """The smallest of 1, 2 and 5 times a power of ten that is no shorter."""
    power = 10.0 ** math.floor(math.log10(step))
    return power * min(digit for digit in (1.0, 2.0, 5.0, 10.0) if digit * power >= step * (1.0 - 1e-9))


def _ticks(axis: Axis, *, share: bool) -> tuple[tuple[float, str], ...]:
    return tuple((axis.place(n) or 0.0, f"{100 * n:.4g} %" if share else f"{n:.4g}") for n in axis.ticks)


def _mark(figure: MadeFigure, axis: Axis, y: float) -> Mark:
    return Mark(
        figure.figure, y + ROW_PX / 2, axis.place(figure.value) or 0.0, axis.place(figure.low),
        axis.place(figure.high), axis.place(figure.paper), axis.place(figure.baseline), axis.place(figure.target),
        figure.ok,
    )  # fmt: skip

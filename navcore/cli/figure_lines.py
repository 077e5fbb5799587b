"""The figures of a bench as it prints them: a line each, or JSON."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from navcore.bench.figure import Figure


def report(figures: tuple[Figure, ...], commit: str, machine: str) -> str:
    """As JSON, one row a figure."""
    rows = [{**dataclasses.asdict(figure), "commit": commit, "machine": machine} for figure in figures]
    return json.dumps(rows, indent=1, allow_nan=False)


def lines(figures: tuple[Figure, ...], commit: str, machine: str) -> str:
    """As text, without the parts of other figures."""
    return "\n".join([f"commit {commit}, {machine}", "", *(_row(figure) for figure in figures if not figure.detail)])


def _row(f: Figure) -> str:
    value = "-" if f.value is None else _shown(f.value)
    interval = "" if f.low is None or f.high is None else f" [{_shown(f.low)}, {_shown(f.high)}]"
    asides = [
        f"{name} {number:g}" for name, number in (("paper", f.paper), ("baseline", f.baseline), ("target", f.target))
        if number is not None
    ]  # fmt: skip
    verdict = "" if f.ok is None else "ok" if f.ok else "MISSED"
    return f"{f.figure:<60} {value + interval:>24} {f.unit:<6} n={f.n:<4} {', '.join(asides):<36} {verdict}"


def _shown(number: float) -> str:
    """To a thousandth, and small ones to three digits: 0.3 mm are not nothing."""
    size = math.floor(math.log10(abs(number))) if number else 0
    return f"{number:.{min(max(3, 2 - size), 9)}f}"

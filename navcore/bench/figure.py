"""One figure of a bench, beside what was published and what is wanted."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.bench.wilson import wilson


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One row of a bench's table.

    Attributes:
        value: None if no case gave it. n: how many missions, frames or switches it rests on. seed: of the first case.
        low, high: Wilson 95 % interval of a share.
        paper, baseline, target: to compare with; None where there is none.
        ok: whether the target is met, None without one or without a value.
        table: of the paper that it stands beside, as "Paper A, Table 8"; None where there is none.
        detail: one of the parts of another figure, for the report alone.
    """

    figure: str
    value: float | None
    unit: str
    n: int
    seed: int | None
    low: float | None = None
    high: float | None = None
    paper: float | None = None
    baseline: float | None = None
    target: float | None = None
    ok: bool | None = None
    table: str | None = None
    detail: bool = False


def share(
    figure: str, part: int, whole: int, *, seed: int | None, paper: float | None = None,
    baseline: float | None = None, at_least: float | None = None, at_most: float | None = None,
    table: str | None = None, detail: bool = False,
) -> Figure:  # fmt: skip
    """`part` of `whole`, with its interval; judged by the one limit that is given."""
    value = part / whole if whole else None
    low, high = wilson(part, whole)
    return Figure(
        figure=figure, value=value, unit="share", n=whole, seed=seed, low=low, high=high, paper=paper,
        baseline=baseline, target=at_most if at_least is None else at_least, ok=_met(value, at_least, at_most),
        table=table, detail=detail,
    )  # fmt: skip


def _met(value: float | None, at_least: float | None, at_most: float | None) -> bool | None:
    if value is None or (at_least is None and at_most is None):
        return None
    return value >= at_least if at_least is not None else value <= (at_most or 0.0)

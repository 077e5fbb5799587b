"""The figures of `rowpilot bench rows`, beside what paper A published and what is wanted."""

from __future__ import annotations

from functools import partial

import numpy as np

from navcore.bench import paper_a
from navcore.bench.figure import Figure, share
from navcore.bench.rows.by_row import OURS, figures_by_row
from navcore.bench.rows.end_error import AT_M
from navcore.bench.rows.no_row_frames import NoRow
from navcore.bench.rows.rows import PUBLISHED_BEST, SEED, RowsResult
from navcore.bench.rows.stages import whole
from navcore.bench.rows.valid_frames import LAST_M

_WANTED_FIT_US, _WANTED_END_M = 25.0, 0.5
_LAST = f" in the last {LAST_M:.0f} m"
_share = partial(share, seed=SEED)


def rows_figures(result: RowsResult) -> tuple[Figure, ...]:
    """Those of paper A first, its rows one by one at the end."""
    return (
        *_valid_figures(result), *_ablation_figures(result), *_stage_figures(result), *_false_figures(result),
        _abstained(result), _end_figure(result), *_entry_figures(result), *_time_figures(result),
        *figures_by_row(result),
    )  # fmt: skip


def _valid_figures(result: RowsResult) -> list[Figure]:
    """By the paper's rule for each, then against the truth, in the row and near its end."""
    best, ours = result.frames[PUBLISHED_BEST], result.frames[OURS]
    figures = [
        _share(f"valid frames by the paper's rule, {m}", c.row.valid, c.row.frames, paper=paper_a.VALID.get(m),
               table="Paper A, Table 8: valid row lines")
        for m, c in result.frames.items()
    ]  # fmt: skip
    row, last = (f"lines on the true ones{where}, ours" for where in ("", _LAST))
    figures.append(
        _share(row, ours.row.true, ours.row.frames, baseline=best.row.true / best.row.frames, at_least=0.995)
    )
    figures.append(
        _share(last, ours.last.true, ours.last.frames, baseline=best.last.true / best.last.frames, at_least=0.99)
    )
    return figures


def _ablation_figures(result: RowsResult) -> list[Figure]:
    """What each part of ours is worth: lines on the true ones with it (as baseline) and without."""
    ours, figures = result.frames[OURS], []
    for name, counts in result.ablations.items():
        for where, part, whole_fit in (("", counts.row, ours.row), (_LAST, counts.last, ours.last)):
            figures.append(
                _share(f"lines on the true ones{where}, ours {name}", part.true, part.frames,
                       baseline=whole_fit.true / whole_fit.frames, table="Ablations: baseline is ours, whole")
            )  # fmt: skip
    return figures


def _stage_figures(result: RowsResult) -> list[Figure]:
    figures = []
    for stage, rows in result.stages[OURS].items():
        ours, other = whole(rows), whole(result.stages[PUBLISHED_BEST][stage])
        figures.append(
            _share(f"centre line right, {stage}, ours", ours.right, ours.frames, paper=paper_a.CENTRES[stage],
                   baseline=other.right / other.frames, at_least=0.99, table="Paper A, Table 11: right centre lines")
        )  # fmt: skip
    return figures


def _false_figures(result: RowsResult) -> list[Figure]:
    ours, other = result.false_lines[OURS], result.false_lines[PUBLISHED_BEST]
    return [
        _share(f"a line where no row is, {kind}, ours", ours[kind].seen, ours[kind].frames,
               baseline=other[kind].seen / other[kind].frames, at_most=0.01)
        for kind in NoRow
    ]  # fmt: skip


def _abstained(result: RowsResult) -> Figure:
    ours, other = result.frames[OURS].row, result.frames[PUBLISHED_BEST].row
    return _share(
        "no line although there is a row, ours", ours.abstained, ours.frames, baseline=other.abstained / other.frames,
        at_most=0.02,
    )  # fmt: skip


def _end_figure(result: RowsResult) -> Figure:
    """95 of 100 are no worse."""
    errors = result.end_errors
    told = np.where(np.isnan(errors), np.inf, np.abs(errors))
    value = float(np.quantile(told, 0.95, method="higher"))
    return Figure(
        figure=f"error of the row's end {AT_M:.0f} m before it, 95 % are no worse, ours",
        value=value if np.isfinite(value) else None, unit="m", n=len(errors), seed=SEED, target=_WANTED_END_M,
        ok=value <= _WANTED_END_M,
    )  # fmt: skip


def _entry_figures(result: RowsResult) -> list[Figure]:
    ours, other = result.entries[OURS], result.entries[PUBLISHED_BEST]
    return [
        _share("of entrances that are seen, the one meant, ours", ours.meant, ours.trusted,
               baseline=other.meant / max(other.trusted, 1), at_least=1.0),
        _share("entrances that are seen from 7 to 3 m before them, ours", ours.trusted, ours.tried,
               baseline=other.trusted / other.tried),
    ]  # fmt: skip


def _time_figures(result: RowsResult) -> list[Figure]:
    ours, published = result.times["ours"], result.times["RANSAC as published"]
    rivals = [time for name, time in result.times.items() if name != "ours"]
    slowest = result.times.get("scikit-image RANSAC", published)
    best_rate = max(time.right / time.n for time in rivals)
    return [
        Figure(figure="one side's fit, 40 points with 30 to 50 % outliers, ours", value=ours.seconds * 1e6, unit="us",
               n=ours.n, seed=SEED, baseline=slowest.seconds * 1e6, target=_WANTED_FIT_US,
               ok=ours.seconds * 1e6 <= _WANTED_FIT_US),
        _share("fits within 0.03 rad, ours", ours.right, ours.n, baseline=best_rate, at_least=best_rate),
    ]  # fmt: skip

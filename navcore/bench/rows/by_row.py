"""The parts of `rowpilot bench rows` as paper A prints them: row by row, stage by stage (Tables 5 to 7, 9 and 10)."""

from __future__ import annotations

from collections.abc import Iterator

from navcore.bench import paper_a
from navcore.bench.figure import Figure, share
from navcore.bench.rows.rows import PUBLISHED_BEST, SEED, RowsResult
from navcore.bench.rows.stages import StageCount
from navcore.perception.row_perception import RowMethod
from navcore.sim.orchard import Season

OURS = RowMethod.CORRIDOR


def figures_by_row(result: RowsResult) -> Iterator[Figure]:
    """Rows that no frame was taken in are left out."""
    for method in paper_a.VALID_BY_ROW:
        yield from _valid(result, method)
    yield from _lines(result)
    yield from _centres(result)


def _valid(result: RowsResult, method: RowMethod) -> Iterator[Figure]:
    rows, published = result.frames[method].rows, paper_a.VALID_BY_ROW[method]
    for number, (row, paper) in enumerate(zip(rows, published, strict=True), start=1):
        if row.frames:
            yield share(f"valid frames, {method}, row {number}", row.valid, row.frames, seed=SEED, paper=paper,
                        table=paper_a.VALID_TABLES[method], detail=True)  # fmt: skip


def _lines(result: RowsResult) -> Iterator[Figure]:
    """Row lines by growth stage: ours, temporal RANSAC on the same pictures beside it."""
    for stage, number, ours, other in _stage_rows(result):
        yield share(f"row lines right, {stage}, row {number}, ours", ours.lines, ours.frames, seed=SEED,
                    paper=paper_a.LINES_BY_ROW[stage][number - 1], baseline=other.lines / other.frames,
                    table="Paper A, Table 9: right row lines by growth stage", detail=True)  # fmt: skip


def _centres(result: RowsResult) -> Iterator[Figure]:
    for stage, number, ours, other in _stage_rows(result):
        yield share(f"centre line right, {stage}, row {number}, ours", ours.right, ours.frames, seed=SEED,
                    paper=paper_a.CENTRES_BY_ROW[stage][number - 1], baseline=other.right / other.frames,
                    table="Paper A, Table 10: right centre lines by growth stage", detail=True)  # fmt: skip


def _stage_rows(result: RowsResult) -> Iterator[tuple[Season, int, StageCount, StageCount]]:
    """Stage, number of the row, our count and that of the best published method."""
    for stage, rows in result.stages[OURS].items():
        others = result.stages[PUBLISHED_BEST][stage]
        for number, (ours, other) in enumerate(zip(rows, others, strict=True), start=1):
            if ours.frames:
                yield stage, number, ours, other

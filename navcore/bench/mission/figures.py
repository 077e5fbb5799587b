"""The figures of `rowpilot bench mission`, beside what paper A published and what is wanted."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from navcore.bench.evaluate.evaluate import Deviation, Evaluation
from navcore.bench.figure import Figure, share
from navcore.bench.mission.cases import SPEEDS, CaseKind, Track
from navcore.bench.mission.result import MissionResult

# Paper A, Table 12 (mean lateral deviation on GNSS, m) and Table 13 (mean heading deviation in rows, deg, image).
_PAPER_TRACKS = {Track.STRAIGHT: 0.093, Track.CURVE: 0.164, Track.Z: 0.221}
_WANTED_TRACKS = {Track.STRAIGHT: (0.08, 0.03), Track.CURVE: (0.12, 0.05), Track.Z: (0.15, 0.06)}
_PAPER_HEADING_DEG = {0.4: 3.24, 0.6: 5.23, 0.8: 8.12}
_TRACKS_TABLE, _HEADING_TABLE = (
    "Paper A, Table 12: lateral deviation on GNSS",
    "Paper A, Table 13: heading deviation in rows",
)


def mission_figures(results: Iterable[MissionResult]) -> tuple[Figure, ...]:
    """All figures of the results at hand."""
    known = sorted(results, key=lambda r: r.case.id)
    missions = [r for r in known if r.case.kind in (CaseKind.MISSION, CaseKind.ROW_CHANGE)]
    alone = [r for r in known if r.case.kind is CaseKind.GNSS_ONLY]
    changes = [r for r in known if r.case.kind is CaseKind.ROW_CHANGE]
    tracks = [r for r in known if r.case.kind is CaseKind.TRACK]
    ablation = float(np.mean([r.clean for r in alone])) if alone else None
    return (
        _clean("missions finished without a human", missions, target=1.0, baseline=ablation),
        _clean("the same missions on GNSS alone", alone),
        *_track_figures(tracks),
        *_row_figures(missions),
        *_switch_figures(missions),
        _clean("row changes over the headland without an RTK fix", changes, target=0.95),
    )


def _clean(
    name: str, results: list[MissionResult], *, target: float | None = None, baseline: float | None = None
) -> Figure:
    clean = sum(r.clean for r in results)
    return share(name, clean, len(results), seed=_seed(results), at_least=target, baseline=baseline)


def _track_figures(results: list[MissionResult]) -> tuple[Figure, ...]:
    figures = []
    for track in Track:
        of = [r for r in results if r.case.track is track]
        whole, steady = _WANTED_TRACKS[track]
        paper = _PAPER_TRACKS[track]
        figures += [
            _mean(
                f"lateral on GNSS, {track}, whole",
                of,
                lambda e: e.gnss_whole,
                "m",
                target=whole,
                paper=paper,
                table=_TRACKS_TABLE,
            ),
            _mean(f"lateral on GNSS, {track}, from 10 m on", of, lambda e: e.gnss_steady, "m", target=steady),
        ]
    return tuple(figures)


def _row_figures(results: list[MissionResult]) -> tuple[Figure, ...]:
    figures = [
        _mean("lateral in rows, from the true centre line", results, lambda e: e.row_lateral, "m", target=0.10)
    ]
    for speed in sorted(SPEEDS):
        of = [r for r in results if r.case.speed == speed]
        paper = _PAPER_HEADING_DEG[speed]
        figures += [
            _mean(f"heading in rows at {speed} m/s, on the ground", of, lambda e: e.row_heading_deg, "deg"),
            _mean(f"heading in rows at {speed} m/s, in the image", of, lambda e: e.image_heading_deg, "deg",
                  paper=paper, table=_HEADING_TABLE),
        ]  # fmt: skip
    return tuple(figures)


def _mean(
    name: str, results: list[MissionResult], part: Callable[[Evaluation], Deviation | None], unit: str, *,
    target: float | None = None, paper: float | None = None, table: str | None = None,
) -> Figure:  # fmt: skip
    """Mean over the runs of each run's mean deviation; a run counts as far as it got."""
    values = [d.mean for r in results if r.evaluation is not None and (d := part(r.evaluation)) is not None]
    value = float(np.mean(values)) if values else None
    return Figure(
        figure=name, value=value, unit=unit, n=len(values), seed=_seed(results), paper=paper, target=target,
        ok=None if value is None or target is None else value <= target, table=table,
    )  # fmt: skip


def _switch_figures(results: list[MissionResult]) -> tuple[Figure, ...]:
    """Switching succeeds in a run whose every switch was followed by a command on the new source."""
    runs = [r for r in results if r.evaluation is not None and r.evaluation.switches]
    switches = [s for r in runs if r.evaluation for s in r.evaluation.switches]
    good = sum(s.seconds is not None for s in switches)
    wrong = sum(len(r.evaluation.wrong_rows) for r in results if r.evaluation)
    lateral = max((s.lateral_m for s in switches if s.lateral_m is not None), default=None)
    seconds = max((s.seconds for s in switches if s.seconds is not None), default=None)
    entries = [e for r in results if r.evaluation for e in r.evaluation.entry_errors]
    return (
        share("mode switches followed by a command on the new source", good, len(switches), seed=_seed(runs),
              at_least=1.0),
        _largest("largest lateral error within 2 m of a switch", lateral, "m", len(switches), 0.15, _seed(runs)),
        _largest("longest time from trigger to first command", seconds, "s", len(switches), 1.0, _seed(runs)),
        _largest("largest distance from the true centre line at an entrance", max(entries, default=None), "m",
                 len(entries), None, _seed(runs)),
        _largest("entries into the wrong row", float(wrong) if results else None, "count", len(results), 0.0,
                 _seed(results)),
    )  # fmt: skip


def _largest(name: str, value: float | None, unit: str, n: int, target: float | None, seed: int | None) -> Figure:
    ok = None if value is None or target is None else value <= target
    return Figure(figure=name, value=value, unit=unit, n=n, seed=seed, target=target, ok=ok)


def _seed(results: list[MissionResult]) -> int | None:
    return min((r.case.seed for r in results), default=None)

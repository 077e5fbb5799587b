"""The figures of `rowpilot bench tracking`, in cm, beside what paper C published and what is wanted. Simulated."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.tracking.cases import SHIPPED, Localization, Rival
from navcore.bench.tracking.courses import Course
from navcore.bench.tracking.drive import TrackingResult

# Paper C, text to Figure 12: mean and largest deviation from the path by speed, cm; and what is wanted.
PAPER_MEAN_CM = {0.5: 8.0, 1.0: 3.5, 1.5: 7.0}
PAPER_LARGEST_CM = {0.5: 13.0, 1.0: 6.0, 1.5: 15.0}
WANTED_MEAN_CM = {0.5: 2.0, 1.0: 2.0, 1.5: 3.0}
WANTED_TURN_CM = 15.0
ROWS = (Course.STRAIGHT, Course.CURVE)
MEAN_TABLE = "Paper C: mean deviation from the path"
LARGEST_TABLE = "Paper C: largest deviation from the path"
TURN_TABLE = "Turn over the headland"


def tracking_figures(results: Iterable[TrackingResult]) -> tuple[Figure, ...]:
    """Along rows by speed, over the headland, course by course, and who got through at all."""
    known = sorted(results, key=lambda r: r.case.seed)
    present = [pair for pair in product(Localization, Rival) if _of(known, *pair)]
    speeds = sorted({r.case.speed for r in known})
    figures = [f for pair in present for v in speeds for f in _along_rows(known, *pair, v)]
    figures += [f for pair in present for v in speeds for f in _in_turn(known, *pair, v)]
    figures += [_pose_error(known, v) for v in speeds]
    return (*figures, *(_through(known, *pair) for pair in present), *_details(known, present, speeds))


def _of(
    results: Sequence[TrackingResult], localization: Localization, rival: Rival, speed: float | None = None,
    courses: Sequence[Course] = tuple(Course),
) -> list[TrackingResult]:  # fmt: skip
    return [
        r for r in results
        if r.case.localization is localization and r.case.rival is rival and r.case.course in courses
        and (speed is None or r.case.speed == speed)
    ]  # fmt: skip


def mean_cm(results: Sequence[TrackingResult]) -> float | None:
    """Mean over the drives of each drive's mean; None without any that got so far."""
    means = [r.mean for r in results if r.mean is not None]
    return 100.0 * float(np.mean(means)) if means else None


def largest_cm(results: Sequence[TrackingResult]) -> float | None:
    """The furthest that any drive was ever off."""
    return max((100.0 * r.largest for r in results if r.largest is not None), default=None)


def _along_rows(results: list[TrackingResult], where: Localization, rival: Rival, v: float) -> tuple[Figure, ...]:
    """Mean and largest on straight and bent row together; ours is judged where the pose's error counts too."""
    drives, published = _of(results, where, rival, v, ROWS), _of(results, where, Rival.PUBLISHED, v, ROWS)
    name, judged = f"{rival}, {where}, rows at {v} m/s", rival is SHIPPED and where is Localization.RTK
    wanted = WANTED_MEAN_CM.get(v) if judged else None
    return (
        _figure(f"{name}: mean", drives, mean_cm(drives), paper=PAPER_MEAN_CM.get(v), wanted=wanted,
                baseline=_beside(rival, mean_cm(published)), table=MEAN_TABLE),
        _figure(f"{name}: largest", drives, largest_cm(drives), paper=PAPER_LARGEST_CM.get(v),
                baseline=_beside(rival, largest_cm(published)), table=LARGEST_TABLE),
    )  # fmt: skip


def _in_turn(results: list[TrackingResult], where: Localization, rival: Rival, v: float) -> tuple[Figure, ...]:
    """The planner slows the turn itself to what the chassis can turn; the speed is that on the way to it."""
    drives, published = _of(results, where, rival, v, (Course.TURN,)), _of(results, where, Rival.PUBLISHED, v)
    turned = [r for r in published if r.case.course is Course.TURN]
    name, judged = f"{rival}, {where}, headland turn from {v} m/s", rival is SHIPPED and where is Localization.RTK
    return (
        _figure(f"{name}: mean", drives, mean_cm(drives), baseline=_beside(rival, mean_cm(turned)), table=TURN_TABLE),
        _figure(f"{name}: largest", drives, largest_cm(drives), baseline=_beside(rival, largest_cm(turned)),
                wanted=WANTED_TURN_CM if judged else None, table=TURN_TABLE),
    )  # fmt: skip


def _details(
    results: list[TrackingResult], present: list[tuple[Localization, Rival]], speeds: list[float]
) -> list[Figure]:
    """Course by course."""
    found = []
    for (where, rival), course, v in product(present, ROWS, speeds):
        drives, name = _of(results, where, rival, v, (course,)), f"{rival}, {where}, {course} at {v} m/s"
        found += [
            _figure(f"{name}: mean", drives, mean_cm(drives), table=MEAN_TABLE, detail=True),
            _figure(f"{name}: largest", drives, largest_cm(drives), table=LARGEST_TABLE, detail=True),
        ]
    return found


def _pose_error(results: list[TrackingResult], v: float) -> Figure:
    drives = _of(results, Localization.RTK, SHIPPED, v)
    value = 100.0 * float(np.mean([r.pose_error for r in drives])) if drives else None
    return _figure(f"error of the pose across the path at {v} m/s, {Localization.RTK}: mean", drives, value)


def _through(results: list[TrackingResult], where: Localization, rival: Rival) -> Figure:
    drives = _of(results, where, rival)
    wanted = 1.0 if rival is SHIPPED else None
    name = f"{rival}, {where}: drives that got to the end"
    return share(name, sum(not r.why for r in drives), len(drives), seed=_seed(drives), at_least=wanted)


def _figure(
    name: str, drives: list[TrackingResult], value: float | None, *, paper: float | None = None,
    baseline: float | None = None, wanted: float | None = None, table: str | None = None, detail: bool = False,
) -> Figure:  # fmt: skip
    ok = None if value is None or wanted is None else value <= wanted
    return Figure(
        figure=name, value=value, unit="cm", n=len(drives), seed=_seed(drives), paper=paper, baseline=baseline,
        target=wanted, ok=ok, table=table, detail=detail,
    )  # fmt: skip


def _beside(rival: Rival, published: float | None) -> float | None:
    return None if rival is Rival.PUBLISHED else published


def _seed(drives: list[TrackingResult]) -> int | None:
    return min((r.case.seed for r in drives), default=None)

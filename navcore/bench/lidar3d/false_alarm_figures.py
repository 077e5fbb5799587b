"""How often a robot that is where its map says takes its trust from the map, in an hour of driving."""

from __future__ import annotations

from collections.abc import Sequence

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.fixed_point_figures import SEASONS
from navcore.bench.lidar3d.watched_drives import WATCH_SEED, Watched
from navcore.bench.poisson import poisson_interval

MOST_AN_HOUR = 1.0


def false_alarm_figures(watched: Sequence[Watched]) -> list[Figure]:
    """Of all drives, then of each season; judged only if so many hours could show it: without any alarm, three."""
    told = sum(w.turns for w in watched)
    return [
        _plain("healthy driving watched", sum(w.hours for w in watched), "h", len(watched)),
        _rate("false alarms an hour", watched, judged=True),
        *(_rate(f"{words}: false alarms an hour", [w for w in watched if w.season is season])
          for season, words in SEASONS.items()),
        _plain("alarms that were due on these drives", sum(w.deserved for w in watched), "count", len(watched)),
        share("matches believed on these drives", sum(w.believed for w in watched), told, seed=WATCH_SEED),
    ]  # fmt: skip


def _rate(figure: str, watched: Sequence[Watched], *, judged: bool = False) -> Figure:
    """With its Poisson 95 % interval."""
    alarms, hours = sum(len(w.alarms) for w in watched), sum(w.hours for w in watched)
    low, high = poisson_interval(alarms, hours)
    value = alarms / hours if hours > 0.0 else None
    enough = judged and value is not None and poisson_interval(0, hours)[1] <= MOST_AN_HOUR
    return Figure(
        figure=figure, value=value, unit="1/h", n=len(watched), seed=WATCH_SEED,
        low=None if value is None else low, high=None if value is None else high,
        target=MOST_AN_HOUR if judged else None, ok=alarms <= MOST_AN_HOUR * hours if enough else None,
    )  # fmt: skip


def _plain(figure: str, value: float, unit: str, n: int) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=WATCH_SEED)

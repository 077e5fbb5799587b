"""One drive of `rowpilot bench tracking`, and how far off the path it was."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from navcore.bench.tracking.alone import Footprint, drive_alone
from navcore.bench.tracking.cases import Localization, TrackingCase
from navcore.bench.tracking.courses import Track, put_down, track, track_plan, track_site
from navcore.config import RobotConfig
from navcore.messages import Request, RequestKind, RunState, SimTruth
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.world import World, WorldParams

_START_NS = 1_000_000_000
_POSE_S, _SETTLE_S = 30.0, 2.0
_RESTING = (RunState.FINISHED, RunState.STOPPED)


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingResult:
    """How far the true robot was from the path on the part that counts.

    Attributes:
        mean, largest: m; None where it did not get so far.
        pose_error: mean distance across the path between where it was and where it was told to be, m.
        trace: (m along, m left of the path), about every 0.25 m, for the plot.
        why: what the operator was told where it did not get through.
    """

    case: TrackingCase
    mean: float | None
    largest: float | None
    pose_error: float
    trace: tuple[tuple[float, float], ...]
    why: str = ""


def drive_track(case: TrackingCase) -> TrackingResult:
    """Drive it, and measure."""
    way = track(case.course)
    if case.localization is Localization.TRUE:
        return measured(case, way, drive_alone(way, case.speed, case.config(), case.seed))
    return _drive_on_rtk(case, way, case.config())


def measured(
    case: TrackingCase, way: Track, prints: tuple[Footprint, ...], *, pose_error: float = 0.0, why: str = ""
) -> TrackingResult:
    """The figures of a drive."""
    s, lateral = np.array([p.s for p in prints]), np.array([p.lateral for p in prints])
    off = np.abs(lateral[(s >= way.first) & (s <= way.last)])
    return TrackingResult(
        case=case, mean=float(off.mean()) if len(off) else None, largest=float(off.max()) if len(off) else None,
        pose_error=pose_error, trace=_thinned(s, lateral), why=why,
    )  # fmt: skip


_TRACE_M = 0.25


def _thinned(s: np.ndarray, lateral: np.ndarray) -> tuple[tuple[float, float], ...]:
    """The first sample in each stretch of a quarter of a metre."""
    _, first = np.unique(np.floor(s / _TRACE_M), return_index=True)
    return tuple((round(float(s[k]), 2), round(float(lateral[k]), 4)) for k in first)


class _Watch:
    """Listens to a drive in lockstep."""

    def __init__(self, way: Track) -> None:
        self._line = way.line
        self._s = 0.0
        self.prints: list[Footprint] = []
        self.pose_errors: list[float] = []

    def __call__(self, tick: Tick) -> None:
        """Keep where the robot was, while it drives."""
        told = tick.decision.status.pose
        if tick.decision.status.state is not RunState.DRIVING or told is None:
            return
        true = self._off(tick.truth)
        self.prints.append(Footprint(self._s, true, tick.truth.v))
        self.pose_errors.append(abs(self._line.project(told.x, told.y, self._s).lateral - true))

    def _off(self, truth: SimTruth) -> float:
        hit = self._line.project(truth.x, truth.y, self._s)
        self._s = hit.s
        return hit.lateral


def _drive_on_rtk(case: TrackingCase, way: Track, config: RobotConfig) -> TrackingResult:
    """The whole robot in lockstep."""
    site, vehicle, start = track_site(way), config.vehicle_params(), put_down(case.seed)
    params = WorldParams(seed=case.seed, start=(start.x, start.y, start.yaw), map_error=NO_MAP_ERROR)
    lockstep = Lockstep(World(site, vehicle, params, start_ns=_START_NS), config.new_navigator(site.datum), None)
    lockstep.run(_POSE_S, lambda tick: tick.decision.status.pose is not None)
    lockstep.run(_SETTLE_S)
    watch = _Watch(way)
    lockstep.listeners.append(watch)
    plan = track_plan(way, case.speed, vehicle)
    lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="bench", plan=plan))
    reply = lockstep.tick().decision.replies[0]
    if not reply.accepted:
        return measured(case, way, (), why=" ".join(reply.reasons))
    last = lockstep.run(5.0 * way.line.length / case.speed, lambda t: t.decision.status.state in _RESTING)
    finished = last.decision.status.state is RunState.FINISHED
    why = "" if finished else "; ".join(e.text for e in last.decision.status.events) or "not through in time"
    error = float(np.mean(watch.pose_errors)) if watch.pose_errors else 0.0
    return measured(case, way, tuple(watch.prints), pose_error=error, why=why)

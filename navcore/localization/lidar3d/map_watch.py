"""Whether the 3D map's matches may be believed: asked of wheels, gyro, RTK and rows, not of the match's own score.

A high score does not show that a match is right: rows and posts repeat. What cannot be fooled the same way is the way
driven since the last match, a fixed RTK position, and how a row that is seen lies beside where the map puts it.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from statistics import median

from navcore.geometry.se2 import SE2
from navcore.messages import MapMatch, MatchState

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class MapWatchParams:
    """Parameters of `MapWatch`.

    Attributes:
        back_s: matches are compared with that of so long ago, s.
        jump: m, by so much two matches may differ from the way driven between them; `jump_share`: of that way.
        slip: share of the way by which wheels may slip besides (simulated on grass: up to 0.25).
        jump_yaw: rad, the same of the direction.
        apart: m, a fixed RTK position and the match may differ by this.
        row_apart: m, by so much a row may seem to move sideways against the map.
        patience: so many contradictions in a row are believed, and as many agreements end the doubt.
        row_patience: the same of looks at a row, of which some are wrong in a row.
        learn: so many looks at a row say where it lies against the map; the newest five times as many count.
    """

    back_s: float = 0.8
    jump: float = 0.12
    jump_share: float = 0.08
    slip: float = 0.35
    jump_yaw: float = 0.06
    apart: float = 0.3
    row_apart: float = 0.3
    patience: int = 2
    row_patience: int = 5
    learn: int = 10


@dataclass(slots=True)
class Doubts:
    """One witness' contradictions in a row, and what it said last."""

    patience: int
    count: int = 0
    reason: str = ""

    def hear(self, contradiction: str) -> None:
        """A word of the witness; empty if it agrees."""
        self.count = min(self.count + 1, 2 * self.patience) if contradiction else max(self.count - 1, 0)
        if contradiction and self.count >= self.patience:
            self.reason = contradiction
        elif self.count == 0:
            self.reason = ""


@dataclass(frozen=True, slots=True)
class WatchedMatch:
    """A match and the odometry at its capture; `farther` than the wheels say it went since the match before, m."""

    match: MapMatch
    T_odom_base: SE2
    farther: float


class MapWatch:
    """Fed with matches and with what others say of the same moment; `reason` tells why not to believe."""

    def __init__(self, params: MapWatchParams | None = None) -> None:
        self._p = p = params or MapWatchParams()
        self._matches: deque[WatchedMatch] = deque(maxlen=50)
        self._wheels, self._fix, self._row = Doubts(p.patience), Doubts(p.patience), Doubts(p.row_patience)
        self._row_id: str | None = None
        self._row_places: deque[float] = deque(maxlen=5 * p.learn)

    @property
    def reason(self) -> str:
        """Why the map is not believed, empty if it is."""
        return self._wheels.reason or self._fix.reason or self._row.reason

    def add_match(self, match: MapMatch, T_odom_base: SE2) -> bool:
        """A match and the odometry at its capture; whether it may be used."""
        if match.state is not MatchState.MATCHED:
            self._matches.clear()
            return False
        self._forget_before(match.stamp_ns)
        now = WatchedMatch(match, T_odom_base, self._farther(match, T_odom_base))
        if self._matches:
            self._wheels.hear(self._jumped(self._matches[0], now))
        self._matches.append(now)
        return not self.reason

    def add_fix(
        self, stamp_ns: int, x: float, y: float, std: float, T_odom_at: SE2, antenna: tuple[float, float]
    ) -> None:
        """A fixed RTK position of the antenna in `map`, m, with the odometry at its capture."""
        if not self._matches or abs(stamp_ns - self._matches[-1].match.stamp_ns) * NS > self._p.back_s:
            return
        last = self._matches[-1]
        here = _place(last.match) @ last.T_odom_base.inverse() @ T_odom_at
        off = math.dist(here.apply_point(*antenna), (x, y))
        apart = off > self._p.apart + 3.0 * std
        self._fix.hear(f"RTK and the 3D map are {off:.1f} m apart" if apart else "")

    def add_row(self, row_id: str, lateral_seen: float, lateral_by_map: float) -> None:
        """Where a seen row's middle lies, and where the map puts that of the drawn one, m to the left."""
        if row_id != self._row_id:
            self._row_id = row_id
            self._row_places.clear()
        off = lateral_seen - lateral_by_map
        moved = abs(off - median(self._row_places)) if len(self._row_places) >= self._p.learn else 0.0
        if moved > self._p.row_apart:
            self._row.hear(f"the row seems to lie {moved:.1f} m beside itself")
            return
        self._row.hear("")
        self._row_places.append(off)

    def row_agrees(self, row_id: str | None, within: float) -> bool:
        """Whether that row was seen to lie where it is drawn: only then may the map lead through it."""
        if row_id is None or row_id != self._row_id or len(self._row_places) < self._p.learn:
            return False
        return abs(median(self._row_places)) <= within

    def _forget_before(self, stamp_ns: int) -> None:
        """Matches of more than `back_s` before that moment."""
        while self._matches and (stamp_ns - self._matches[0].match.stamp_ns) * NS > self._p.back_s:
            self._matches.popleft()

    def _farther(self, match: MapMatch, T_odom_base: SE2) -> float:
        if not self._matches:
            return 0.0
        last = self._matches[-1]
        return (_place(last.match).inverse() @ _place(match)).x - (last.T_odom_base.inverse() @ T_odom_base).x

    def _jumped(self, before: WatchedMatch, now: WatchedMatch) -> str:
        p = self._p
        moved = _place(before.match).inverse() @ _place(now.match)
        driven = before.T_odom_base.inverse() @ now.T_odom_base
        way = math.hypot(driven.x, driven.y)
        slipped = self._slipped(now, p.slip * way) / way if way > 0.0 else 0.0
        off = math.hypot(moved.x - (1.0 + slipped) * driven.x, moved.y - (1.0 + slipped) * driven.y)
        turned = abs((driven.inverse() @ moved).yaw)
        if off > p.jump + p.jump_share * way:
            return f"the 3D map's place jumped {off:.1f} m against the wheels"
        return f"the 3D map's direction jumped {math.degrees(turned):.0f} deg" if turned > p.jump_yaw else ""

    def _slipped(self, now: WatchedMatch, most: float) -> float:
        """How much farther than the wheels say all matches have gone, step by step alike, m: a jump is one step."""
        steps = [match.farther for match in (*self._matches, now)][1:]
        return min(max(len(steps) * median(steps), -most), most)


def _place(match: MapMatch) -> SE2:
    return SE2(match.x, match.y, match.yaw)

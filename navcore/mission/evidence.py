"""How much each source is worth now: the newest observation, its age, and for how long it has agreed."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.localization.row_line import RowLine
from navcore.messages import FixQuality, GnssFix, RowObservation

NS = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEvidenceParams:
    """Parameters of `RowEvidence`.

    Attributes:
        gate: largest disagreement with the expected row, as a share of the corridor width, in (0, 0.5): beyond half a
            width the neighbouring row would be the nearer one. It holds by the tie to what was seen before, and
            outside the row by GNSS as well: a fit that begins between two rows may creep over to the wrong one.
        sigmas: nor may it be further off, or turned by more, than so many 1-sigma of what is expected.
        heading_gate: largest disagreement of the direction, rad: plants on a lattice stand in line crosswise too.
        width_gate: largest disagreement of its width, as a share: two rows side by side are no row.
        max_curvature: what bends tighter is no row, 1/m.
        min_quality: 0 to 1.
        looks_s: a picture older than that shows nothing of now, s.
    """

    gate: float = 0.45
    sigmas: float = 3.0
    heading_gate: float = 0.16
    width_gate: float = 0.3
    max_curvature: float = 0.3
    min_quality: float = 0.15
    looks_s: float = 0.5


@dataclass(frozen=True, slots=True)
class Doubt:
    """1-sigma of where a row is expected: across it, m, and its direction, rad."""

    lateral: float
    heading: float


NO_IDEA = Doubt(math.inf, math.inf)


class RowEvidence:
    """The row that is meant, as the camera sees it."""

    def __init__(self, params: RowEvidenceParams) -> None:
        self.params = params
        self.forget()

    def forget(self) -> None:
        """Another row, or another camera."""
        self.newest: RowObservation | None = None
        self.agreeing: RowObservation | None = None
        self.streak = 0

    def judge(
        self, seen: RowObservation, row: RowLine, expected: tuple[SE2, ...], width: float, doubt: Doubt = NO_IDEA
    ) -> bool:
        """Take one observation; True if it is seen, not only carried on, and of the row that is meant.

        `expected` are the poses of the driving frame in `map` at the time of capture, by all who know it, to `doubt`.
        """
        self.newest = seen
        p = self.params
        reach = min(p.gate * width, p.sigmas * doubt.lateral), min(p.heading_gate, p.sigmas * doubt.heading)
        agrees = all(self._agrees(seen, row.coordinates(pose), width, reach) for pose in expected)
        self.streak = self.streak + 1 if agrees else 0
        if agrees:
            self.agreeing = seen
        return agrees

    def _agrees(self, seen: RowObservation, expected: SE2, width: float, reach: tuple[float, float]) -> bool:
        if not seen.in_sight or seen.offset is None or seen.heading is None:
            return False
        near = abs(-seen.offset - expected.y) <= reach[0]
        straight = abs(seen.curvature) <= self.params.max_curvature
        parallel = straight and abs(wrap(-seen.heading - expected.yaw)) <= reach[1]
        as_wide = seen.width is None or abs(seen.width - width) <= self.params.width_gate * width
        return near and parallel and as_wide and seen.quality >= self.params.min_quality

    def age_s(self, now_ns: int) -> float | None:
        """Age of the newest agreeing observation."""
        return None if self.agreeing is None else (now_ns - self.agreeing.stamp_ns) * NS

    def looks(self, now_ns: int) -> bool:
        """Whether the camera shows pictures, with or without a row in them."""
        return self.newest is not None and (now_ns - self.newest.stamp_ns) * NS <= self.params.looks_s

    @property
    def reason(self) -> str:
        """Why there is no row, in the row worker's words."""
        if self.newest is None:
            return "no picture"
        if self.newest.carried:
            return f"no trunk or post on its lines for {self.newest.carried:.1f} m"
        return self.newest.reason or "what it sees is not the row that is meant"


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssEvidenceParams:
    """Parameters of `GnssEvidence`.

    Attributes:
        qualities: what counts as a good epoch.
    """

    qualities: tuple[FixQuality, ...] = (FixQuality.RTK_FIXED,)


class GnssEvidence:
    """The receiver's epochs: the newest with a position, and how many good ones came in a row."""

    def __init__(self, params: GnssEvidenceParams) -> None:
        self.params = params
        self.newest: GnssFix | None = None
        self.streak = 0

    def add(self, fix: GnssFix) -> None:
        """Take one epoch."""
        if fix.quality is FixQuality.NONE or fix.lat_deg is None:
            self.streak = 0
            return
        self.newest = fix
        self.streak = self.streak + 1 if fix.quality in self.params.qualities else 0

    def age_s(self, now_ns: int) -> float | None:
        """Age of the newest epoch with a position."""
        return None if self.newest is None else (now_ns - self.newest.stamp_ns) * NS

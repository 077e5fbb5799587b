"""What the pose filter uses, what it rejects and why: the quantities behind the faults of localization."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.messages import FixQuality


@dataclass(frozen=True, slots=True, kw_only=True)
class FilterStatus:
    """State of the pose filter at one moment.

    Attributes:
        ready: position and heading are known.
        reason: what is missing or was rejected last, a sentence; empty when all is well.
        quality: of the newest accepted fix.
        fix_age_s: since the capture of the newest accepted position, None before the first.
        heading_age_s: since the newest accepted heading or course, None before the first.
        position_std: 1-sigma along the worst direction, m, None until ready.
        yaw_std: rad, None until ready.
        dead_reckoned: driven since the newest accepted position, m.
        position_doubt_s: for how long positions in a row have been rejected, 0 while they are accepted.
        heading_doubt_s: the same for headings.
        relocations: how often the pose was set anew to a receiver that held to its place.
        accepted, rejected: how often each kind of evidence was.
    """

    stamp_ns: int
    ready: bool
    reason: str
    quality: FixQuality
    fix_age_s: float | None
    heading_age_s: float | None
    position_std: float | None
    yaw_std: float | None
    dead_reckoned: float
    position_doubt_s: float
    heading_doubt_s: float
    relocations: int
    accepted: dict[str, int]
    rejected: dict[str, int]

"""What one sentence says about one epoch."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date

from navcore.messages import FixQuality


@dataclass(frozen=True, slots=True, kw_only=True)
class EpochPart:
    """All fields None where the sentence does not tell.

    Attributes:
        kind: of the sentence.
        rank: of its position and quality; the highest of an epoch counts, 0 for none.
        clock_ns: UTC time of day.
        day: UTC date.
        usable: False if the receiver itself calls its navigation invalid.
        height_m: ellipsoidal.
        heading_deg: of the antenna baseline, clockwise from true north.
        course_deg: over ground, clockwise from true north.
        speed: over ground, m/s.
    """

    kind: str
    rank: int = 0
    clock_ns: int | None = None
    day: date | None = None
    usable: bool | None = None
    quality: FixQuality | None = None
    lat_deg: float | None = None
    lon_deg: float | None = None
    height_m: float | None = None
    std_east_m: float | None = None
    std_north_m: float | None = None
    std_up_m: float | None = None
    heading_deg: float | None = None
    heading_std_deg: float | None = None
    speed: float | None = None
    course_deg: float | None = None
    hdop: float | None = None
    satellites: int | None = None
    correction_age_s: float | None = None

"""What became of a measurement."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Evidence(StrEnum):
    """Kinds of measurement."""

    POSITION = "position"
    HEADING = "heading"
    COURSE = "course"
    MAP = "map"
    INPUT = "input"


@dataclass(frozen=True, slots=True)
class Verdict:
    """Accepted, or the reason why not.

    Attributes:
        reason: empty when accepted and nothing is to be said.
    """

    evidence: Evidence
    accepted: bool
    reason: str = ""

"""What the recorder says of itself."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class RecorderStatus:
    """Whether the run is being written down. Driving goes on without.

    Attributes:
        problem: why nothing is written, empty when all is well or nothing was asked for.
    """

    stamp_ns: int
    recording: bool
    run_id: str | None
    size_bytes: int
    problem: str

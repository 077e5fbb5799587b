"""What can be asked of the recorder, over `Endpoints.recorder_requests`."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum


class RecorderRequestKind(StrEnum):
    """START opens a log, FINISH closes it, STATUS asks how it stands."""

    START = "start"
    FINISH = "finish"
    STATUS = "status"


@dataclass(frozen=True, slots=True, kw_only=True)
class RecorderRequest:
    """One request.

    Attributes:
        run_id: of START; of FINISH: finishes only this run's log, any if None.
        path: of START: file to make; its folder must exist, the file must not.
        metadata: of START: kept in the log as it is.
    """

    kind: RecorderRequestKind
    run_id: str | None = None
    path: str | None = None
    metadata: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingSummary:
    """How a log stands, or how it ended.

    Attributes:
        messages: number of messages of each topic.
        size_bytes: of the file.
        duration_s: since its start.
        problem: why nothing is written any more; empty when all is well.
    """

    run_id: str
    path: str
    messages: dict[str, int]
    size_bytes: int
    duration_s: float
    problem: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecorderReply:
    """Answer to any request.

    Attributes:
        accepted: done; else `reason` says why not.
        recording: a log is open and being written, now.
        summary: of the log asked for, or of the last one; None if there was none.
    """

    accepted: bool
    recording: bool
    reason: str = ""
    summary: RecordingSummary | None = None

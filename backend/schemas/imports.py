"""Imports of pictures under way."""

from __future__ import annotations

from enum import StrEnum

from pydantic import Field

from backend.schemas.base import Id, Sent


class JobState(StrEnum):
    """State of an import."""

    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"


class JobStarted(Sent):
    """An import that has begun; ask `/api/jobs/{id}` how it goes."""

    job_id: Id


class Job(Sent):
    """An import. `message` says what is being done, or what to do about a failure."""

    id: Id
    state: JobState
    progress: float = Field(ge=0, le=1)
    message: str
    site_id: Id | None

"""3D maps of a site, and how one is made."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from backend.schemas.base import Id, Sent
from backend.schemas.imports import JobState


class Map3dFile(Sent):
    """One of a map's files."""

    name: str
    size_bytes: int


class Map3dDocument(Sent):
    """A map that was made of a run.

    Attributes:
        driven: m. rtk_share: 0 to 1. fix_rms, loop_rms: m, None where there was nothing to compare with.
        doubts: sentences that say what the map is not good for.
    """

    run_id: Id
    made: datetime
    driven: float
    keyframes: int
    loops_taken: int
    georeferenced: bool
    rtk_share: float = Field(ge=0, le=1)
    fix_rms: float | None
    loop_rms: float | None
    hectares: float
    points: int
    doubts: list[str]
    files: list[Map3dFile]


class Map3dJob(Sent):
    """A map under way. `message` says what is being done, or what to do about a failure."""

    state: JobState
    progress: float = Field(ge=0, le=1)
    message: str


class RunMap3d(Sent):
    """The 3D map of a run.

    Attributes:
        clouds: number of the run's clouds; None where its log has no index to tell.
        begun: part of the work is there already; it goes on from there.
        job: that makes it now, or that failed since the station began. map: what was made.
    """

    clouds: int | None
    begun: bool
    job: Map3dJob | None
    map: Map3dDocument | None

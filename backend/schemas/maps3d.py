"""3D maps of a site, and how one is made."""

from __future__ import annotations

from datetime import datetime

from pydantic import Field

from backend.schemas.base import Id, Received, Sent
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


class HeightColour(Sent):
    """Colour, as CSS writes it, of what stands so high above the ground, m."""

    height: float
    colour: str


class Map3dPicture(Sent):
    """A map seen from above, to be laid over the farm; its pixels are at `picture.png` beside it.

    Attributes:
        bounds_3857: west, south, east, north in EPSG:3857, m; the picture's sides run along them.
        pixel: edge of a pixel on the ground, m. made: when the map was, so that a new one is asked for anew.
        legend: from the ground up; what stands higher has the last colour.
    """

    bounds_3857: tuple[float, float, float, float]
    pixel: float
    width_px: int
    height_px: int
    made: datetime
    legend: list[HeightColour]


class Map3dChoice(Received):
    """The run whose map the robot drives by; none where it drives without one."""

    run_id: Id | None


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

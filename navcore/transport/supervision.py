"""What can be asked of the supervisor, over `Endpoints.supervisor_requests`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class SupervisorRequestKind(StrEnum):
    """What is asked.

    STATUS tells of the processes; LOAD_SITE moves the robot's mind, and a simulated robot, to another farm;
    LOAD_CALIBRATION has its eyes start again with the calibrations that are in use.
    """

    STATUS = "status"
    LOAD_SITE = "load_site"
    LOAD_CALIBRATION = "load_calibration"


@dataclass(frozen=True, slots=True, kw_only=True)
class SupervisorRequest:
    """One request.

    Attributes:
        site_path: of LOAD_SITE: file with the `SiteMap` as JSON.
        site_id: of LOAD_SITE: the station's name for it, given back in the status.
    """

    kind: SupervisorRequestKind
    site_path: str | None = None
    site_id: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ProcessStatus:
    """One process. `restarts` counts since its first start."""

    name: str
    running: bool
    pid: int | None
    restarts: int


@dataclass(frozen=True, slots=True, kw_only=True)
class SupervisorReply:
    """Answer to any request.

    Attributes:
        accepted: done; else `reason` says why not.
        site_id, site_path: the farm that the robot knows now; None before the first.
        simulated: the robot is the simulator.
    """

    accepted: bool
    reason: str = ""
    site_id: str | None = None
    site_path: str | None = None
    simulated: bool = True
    processes: tuple[ProcessStatus, ...] = ()

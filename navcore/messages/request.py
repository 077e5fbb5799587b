"""What the operator asks of the navigator, and its answer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from navcore.messages.mission_plan import MissionPlan
from navcore.messages.told_place import ToldPlace


class LinkLossPolicy(StrEnum):
    """What the robot does when no operator's page has been heard of for 5 s."""

    CONTINUE = "continue"
    STOP = "stop"


class RequestKind(StrEnum):
    """What an operator can ask of the navigator. Stop goes to the guard as well, on a socket of its own."""

    START = "start"
    PAUSE = "pause"
    RESUME = "resume"
    STOP = "stop"
    ACKNOWLEDGE = "acknowledge"
    HEARTBEAT = "heartbeat"
    PLACE = "place"


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """An operator's request, as the navigator consumed it."""

    kind: RequestKind
    request_id: str
    run_id: str | None = None
    plan: MissionPlan | None = None
    link_loss: LinkLossPolicy = LinkLossPolicy.CONTINUE
    place: ToldPlace | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """Answer to a request: accepted, or every reason why not."""

    request_id: str
    accepted: bool
    reasons: tuple[str, ...] = ()

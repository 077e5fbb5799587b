"""Starting, pausing and stopping."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal

from pydantic import Field

from backend.schemas.base import Id, Received, Sent
from navcore.messages import LinkLossPolicy


class Nonce(Sent):
    """Single use, for one start from the page that asked."""

    nonce: str
    expires_s: int


class RunStart(Received):
    """Starts a stored mission. `link_loss` is the operator's choice for when no page is heard of for 5 s."""

    mission_id: Id
    link_loss: LinkLossPolicy
    nonce: str = Field(max_length=200)


class OperatorAction(StrEnum):
    """What an operator can ask of a run under way, apart from stop."""

    PAUSE = "pause"
    RESUME = "resume"
    ACKNOWLEDGE = "acknowledge"


class ActionResult(Sent):
    """The navigator took the request."""

    accepted: Literal[True]


class StopResult(Sent):
    """Who was told to stop.

    Attributes:
        guard: the guard's stop socket took the datagram.
        navigator: the request was handed on; its answer is not waited for.
    """

    guard: bool
    navigator: bool
    message: str

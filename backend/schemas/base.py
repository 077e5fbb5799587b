"""What all bodies share: ids, what is refused, and the one form of an error."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Id = Annotated[str, Field(pattern=r"^[0-9a-f]{16}$", description="Made by the station")]


class Received(BaseModel):
    """Base of request bodies: unknown keys, NaN and infinity are refused."""

    model_config = ConfigDict(allow_inf_nan=False, extra="forbid")


class Sent(BaseModel):
    """Base of answers."""

    model_config = ConfigDict(from_attributes=True)


class ErrorDocument(Sent):
    """Every error: one sentence, and all reasons where there are several."""

    message: str
    reasons: list[str]

"""What all bodies share: ids, what is refused, and the one form of an error."""

from __future__ import annotations

import json
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, model_validator

Id = Annotated[str, Field(pattern=r"^[0-9a-f]{16}$", description="Made by the station")]


class Received(BaseModel):
    """Base of request bodies: unknown keys, NaN, infinity and half characters are refused."""

    model_config = ConfigDict(allow_inf_nan=False, extra="forbid")

    @model_validator(mode="before")
    @classmethod
    def _can_be_written_down(cls, data: Any) -> Any:
        """JSON may carry one half of a surrogate pair alone, which no file and no answer can hold."""
        try:
            json.dumps(data, ensure_ascii=False).encode()
        except (UnicodeEncodeError, RecursionError) as error:
            raise ValueError("a text is broken. Type it again.") from error
        return data


class Sent(BaseModel):
    """Base of answers."""

    model_config = ConfigDict(from_attributes=True)


class ErrorDocument(Sent):
    """Every error: one sentence, and all reasons where there are several."""

    message: str
    reasons: list[str]

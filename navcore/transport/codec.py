"""One encoding for bus, log and browser: JSON of the frozen dataclasses, made once."""

from __future__ import annotations

from math import isfinite
from typing import Any, TypeVar

import msgspec

from navcore.errors import InputError, NotFiniteError

T = TypeVar("T")


def encode(message: Any) -> bytes:
    """JSON of a message.

    Raises NotFiniteError on NaN or infinity: msgspec would write them as null, and a missing number would look meant.
    """
    refuse_not_finite(message, type(message).__name__)
    return msgspec.json.encode(message)


def decode(type_: type[T], data: bytes) -> T:
    """Message of that type. Raises InputError if the bytes are anything else; nothing is converted."""
    try:
        return msgspec.json.decode(data, type=type_, strict=True)
    except (msgspec.MsgspecError, UnicodeDecodeError) as error:
        raise InputError(
            f"This is no {type_.__name__}: {error}. Check that both sides run the same version."
        ) from error


def refuse_not_finite(value: Any, where: str) -> None:
    """Raises NotFiniteError, naming the field, if a number anywhere in `value` is NaN or infinite."""
    if isinstance(value, float):
        if not isfinite(value):
            raise NotFiniteError(f"{where} is {value}. Only finite numbers may leave a process.")
    elif isinstance(value, tuple | list):
        for item in value:
            refuse_not_finite(item, where)
    elif isinstance(value, dict):
        for key, item in value.items():
            refuse_not_finite(item, f"{where}.{key}")
    elif hasattr(value, "__dataclass_fields__"):
        for name in value.__dataclass_fields__:
            refuse_not_finite(getattr(value, name), f"{where}.{name}")

"""Many messages of one kind, from their fields as columns."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from typing import Any, TypeVar

_Message = TypeVar("_Message")


def made_of_columns(kind: type[_Message], *columns: Iterable[Any]) -> tuple[_Message, ...]:
    """One frozen message with slots for each row of its fields' columns, all as long, in the order of the fields.

    A frozen dataclass's own `__init__` takes five times as long, and each picture comes with a hundred plants.
    """
    numbers, *others = map(list, columns)
    made = tuple([object.__new__(kind) for _ in numbers])
    for field, column in zip(fields(kind), (numbers, *others), strict=True):  # type: ignore[arg-type]
        put = getattr(kind, field.name).__set__
        for message, value in zip(made, column, strict=True):
            put(message, value)
    return made

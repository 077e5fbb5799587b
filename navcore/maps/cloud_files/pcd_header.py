"""Header of a PCD file (version 0.7): which fields a point has, how many points there are, how they are written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from navcore.errors import CloudError

_LONGEST = 65_536
_KINDS = {"F": "f", "I": "i", "U": "u"}
_SIZES = {"F": (4, 8), "I": (1, 2, 4, 8), "U": (1, 2, 4, 8)}
_NEEDED = ("FIELDS", "SIZE", "TYPE", "DATA")
_MOST_NUMBERS = 10_000


class PcdForm(StrEnum):
    """How the points are written."""

    ASCII = "ascii"
    BINARY = "binary"
    COMPRESSED = "binary_compressed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PcdHeader:
    """What the header claims; `start` is where the points begin, bytes from the file's start."""

    dtype: np.dtype[Any]
    points: int
    form: PcdForm
    start: int


def read_header(data: bytes, source: str) -> PcdHeader:
    """Raises CloudError that names what is wrong."""
    entries, start = _entries(data, source)
    missing = [key for key in _NEEDED if key not in entries]
    if missing:
        raise CloudError(f"{source} is no PCD file: its header has no line {missing[0]}.")
    try:
        form = PcdForm(" ".join(entries["DATA"]).lower())
    except ValueError:
        raise CloudError(f"{source} says DATA {' '.join(entries['DATA'])}; save it as binary.") from None
    return PcdHeader(dtype=_dtype(entries, source), points=_points(entries, source), form=form, start=start)


def _entries(data: bytes, source: str) -> tuple[dict[str, list[str]], int]:
    """Words of each line up to DATA, and where the next one starts."""
    entries: dict[str, list[str]] = {}
    at = 0
    while at < min(len(data), _LONGEST):
        end = data.find(b"\n", at)
        end = len(data) if end < 0 else end
        words = data[at:end].decode("ascii", "replace").split()
        at = end + 1
        if words and not words[0].startswith("#"):
            entries[words[0].upper()] = words[1:]
            if words[0].upper() == "DATA":
                return entries, at
    raise CloudError(f"{source} is no PCD file: its header has no line DATA.")


def _dtype(entries: Mapping[str, list[str]], source: str) -> np.dtype[Any]:
    """One point: padding fields ("_") and fields named twice keep their room under a name of their own."""
    names = entries["FIELDS"]
    sizes, counts = _numbers(entries, "SIZE", source), _numbers(entries, "COUNT", source, len(names))
    kinds = entries["TYPE"]
    if not names or not len(names) == len(sizes) == len(kinds) == len(counts):
        raise CloudError(f"{source}: FIELDS, SIZE, TYPE and COUNT of its header are not of one length.")
    if sum(counts) > _MOST_NUMBERS or min(counts) < 1:
        raise CloudError(f"{source}: COUNT of its header is not to be believed; export the file again.")
    fields: list[tuple[str, str, tuple[int, ...]]] = []
    for name, size, kind, count in zip(names, sizes, kinds, counts, strict=True):
        if size not in _SIZES.get(kind, ()):
            raise CloudError(f"{source}: field {name} is of TYPE {kind} SIZE {size}, which PCD does not know.")
        unique = name if name != "_" and name not in (f[0] for f in fields) else f"_{len(fields)}"
        fields.append((unique, f"<{_KINDS[kind]}{size}", (count,) if count > 1 else ()))
    return np.dtype(fields)


def _points(entries: Mapping[str, list[str]], source: str) -> int:
    shape = [_numbers(entries, key, source, 1) for key in ("WIDTH", "HEIGHT")]
    area = shape[0][0] * shape[1][0]
    if "POINTS" not in entries:
        if "WIDTH" not in entries:
            raise CloudError(f"{source} does not say how many points it has: POINTS is missing in its header.")
        return area
    points = _numbers(entries, "POINTS", source)[0]
    if "WIDTH" in entries and area != points:
        raise CloudError(f"{source}: WIDTH x HEIGHT is {area}, POINTS is {points}; export the file again.")
    return points


def _numbers(entries: Mapping[str, list[str]], key: str, source: str, ones: int = 0) -> list[int]:
    words = entries.get(key, ["1"] * ones)
    if not words or not all(word.isdecimal() and word.isascii() and len(word) < 12 for word in words):
        raise CloudError(f"{source}: {key} {' '.join(words)[:60]} in its header is not a count.")
    return [int(word) for word in words]

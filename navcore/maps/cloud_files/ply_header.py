"""Header of a PLY file: its elements, what each is made of, how they are written."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from navcore.errors import CloudError

_LONGEST = 65_536
_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float32": "f4", "float64": "f8",
}  # fmt: skip


class PlyForm(StrEnum):
    """How the elements are written."""

    ASCII = "ascii"
    LITTLE_ENDIAN = "binary_little_endian"
    BIG_ENDIAN = "binary_big_endian"

    @property
    def order(self) -> str:
        """Of bytes, as NumPy writes it."""
        return ">" if self is PlyForm.BIG_ENDIAN else "<"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlyHeader:
    """What the header claims; `start` is where the elements begin, bytes from the file's start.

    Attributes:
        vertex: one vertex; vertices of them there are.
        before_bytes, before_lines: that other elements take before the first vertex.
    """

    form: PlyForm
    vertex: np.dtype[Any]
    vertices: int
    before_bytes: int
    before_lines: int
    start: int


@dataclass(slots=True)
class _Element:
    name: str
    count: int
    fields: list[tuple[str, str]]
    lists: bool = False


def read_header(data: bytes, source: str) -> PlyHeader:
    """Raises CloudError that names what is wrong."""
    lines, start = _lines(data, source)
    form = _form(lines, source)
    before: list[_Element] = []
    for element in _elements(lines, form, source):
        if element.name == "vertex":
            return _header(form, element, before, start, source)
        before.append(element)
    raise CloudError(f"{source} has no element vertex; export it as points.")


def _lines(data: bytes, source: str) -> tuple[list[list[str]], int]:
    end = data.find(b"end_header", 0, _LONGEST)
    newline = data.find(b"\n", end)
    if not data.startswith(b"ply") or end < 0 or newline < 0:
        raise CloudError(f"{source} is no PLY file: it does not start with ply and a header that ends.")
    text = data[:end].decode("ascii", "replace")
    return [line.split() for line in text.splitlines()[1:] if line.strip()], newline + 1


def _form(lines: list[list[str]], source: str) -> PlyForm:
    if lines and len(lines[0]) == 3 and lines[0][0] == "format" and lines[0][1] in list(PlyForm):
        return PlyForm(lines[0][1])
    raise CloudError(f"{source}: its header does not say format ascii, binary_little_endian or binary_big_endian.")


def _elements(lines: list[list[str]], form: PlyForm, source: str) -> list[_Element]:
    found: list[_Element] = []
    for words in lines[1:]:
        match words:
            case ["element", name, count] if count.isdecimal() and count.isascii() and len(count) < 12:
                found.append(_Element(name, int(count), []))
            case ["property", "list", *_] if found:
                found[-1].lists = True
            case ["property", kind, name] if found and kind in _TYPES:
                taken = name in (field for field, _ in found[-1].fields)
                found[-1].fields.append((f"_{len(found[-1].fields)}" if taken else name, form.order + _TYPES[kind]))
            case ["comment" | "obj_info", *_]:
                pass
            case _:
                raise CloudError(f'{source}: its header has the line "{" ".join(words)[:60]}", which is not PLY.')
    return found


def _header(form: PlyForm, vertex: _Element, before: list[_Element], start: int, source: str) -> PlyHeader:
    if vertex.lists or any(element.lists for element in before):
        raise CloudError(f"{source} has lists at or before its vertices; export it as bare points.")
    return PlyHeader(
        form=form,
        vertex=np.dtype(vertex.fields),
        vertices=vertex.count,
        before_bytes=sum(element.count * np.dtype(element.fields).itemsize for element in before),
        before_lines=sum(element.count for element in before),
        start=start,
    )

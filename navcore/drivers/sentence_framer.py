"""Bytes in any portions -> lines that want to be sentences, with binary between them set aside."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Iterator
from dataclasses import dataclass

MAX_SENTENCE_BYTES = 4096
CUT = re.compile(rb"[^\x20-\x7e]|\$")
SENTENCE_START = re.compile(rb"\$P?[A-Z]{2}[A-Z0-9]{2,}|#[A-Z0-9]{4,}A,")
HASH_START = re.compile(rb"#[A-Z0-9]{4,}A,")
BINARY = re.compile(rb"[^\x20-\x7e\r\n\t]")


@dataclass(frozen=True, slots=True)
class Line:
    """A stretch of the stream.

    Attributes:
        offset: of its first byte in the stream.
        data: its bytes without the line end; cut at MAX_SENTENCE_BYTES.
        is_text: False for a stretch of binary (then `data` holds its first bytes and `size` all of them).
        size: number of bytes.
    """

    offset: int
    data: bytes
    is_text: bool
    size: int


class SentenceFramer:
    """Cuts a byte stream at line ends, at binary, and wherever a `$` starts a new sentence.

    Text that is no sentence (comments, JSON, a prompt before a `#`) passes silently. Time and memory are linear in
    what is fed.
    """

    def __init__(self) -> None:
        self._piece = bytearray()
        self._piece_size = 0
        self._offset = 0
        self._binary = bytearray()
        self._binary_offset = 0
        self._binary_size = 0

    def feed(self, data: bytes) -> Iterator[Line]:
        """Every line that `data` completes."""
        at = 0
        for cut in CUT.finditer(data):
            self._grow(data[at : cut.start()])
            at = cut.end()
            yield from self._end_piece()
            self._start_after(cut.group())
        self._grow(data[at:])

    def flush(self) -> Iterator[Line]:
        """What is left at the end of the stream."""
        yield from self._end_piece()
        yield from self._end_binary()

    def _grow(self, data: bytes) -> None:
        self._piece += data[: MAX_SENTENCE_BYTES + 1 - len(self._piece)]
        self._piece_size += len(data)

    def _start_after(self, separator: bytes) -> None:
        if separator == b"$":
            self._piece += separator
            self._piece_size = 1
        else:
            self._set_aside(separator)
            self._offset += 1

    def _end_piece(self) -> Iterator[Line]:
        piece, size = bytes(self._piece), self._piece_size
        self._piece.clear()
        self._piece_size = 0
        found = SENTENCE_START.match(piece) or HASH_START.search(piece)
        if found:
            yield from self._end_binary()
            yield Line(self._offset + found.start(), piece[found.start() :], True, size - found.start())
        elif self._binary:
            self._binary_size += size
        self._offset += size

    def _set_aside(self, byte: bytes) -> None:
        if self._binary:
            self._binary_size += 1
        elif BINARY.match(byte) and not self._is_byte_order_mark(byte):
            self._binary += byte
            self._binary_offset, self._binary_size = self._offset, 1

    def _is_byte_order_mark(self, byte: bytes) -> bool:
        """Editors begin text with the three bytes of U+FEFF."""
        return self._offset < len(BOM_UTF8) and byte[0] == BOM_UTF8[self._offset]

    def _end_binary(self) -> Iterator[Line]:
        if self._binary:
            yield Line(self._binary_offset, bytes(self._binary), False, self._binary_size)
        self._binary.clear()

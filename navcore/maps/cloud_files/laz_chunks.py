"""The packed chunks of a LAZ file, checked before a library makes room for what they claim."""

from __future__ import annotations

import io
import struct

import lazrs

from navcore.errors import CloudError

# A chunk's first point is not packed, and no point is shorter.
_SHORTEST_CHUNK = 20
_ITEMS_FROM = 32
# Items of LAS 1.4 points are packed in layers, each with its own length; 14 is extra bytes, a layer each.
_LAYERS, _EXTRA = {10: 9, 11: 1, 12: 2, 13: 1}, 14


def check_chunks(data: bytes, start: int, record: bytes, source: str) -> None:
    """`start` is where the points begin, bytes; `record` the file's description of its packing.

    Raises CloudError where the chunks are not there or claim more than their bytes.
    """
    table = _table(data, start, source)
    size, layers = _items(record, source)
    stream = io.BytesIO(data)
    stream.seek(start)
    at = start + 8
    for number, (_, length) in enumerate(lazrs.read_chunk_table(stream, lazrs.LazVlr(record)), start=1):
        counts_at = at + size + 4
        if at + length > table or (layers and counts_at + 4 * layers > table):
            raise CloudError(f"{source}: packed chunk {number} reaches beyond the points; copy or export it again.")
        if layers and sum(struct.unpack_from(f"<{layers}I", data, counts_at)) > length:
            raise CloudError(f"{source}: packed chunk {number} claims more than its bytes; copy or export it again.")
        at += length


def _table(data: bytes, start: int, source: str) -> int:
    """Where the table of chunks is, bytes; its count can be true."""
    if len(data) < start + 8:
        raise CloudError(f"{source} ends where its points should begin (cut off?); copy or export it again.")
    (table,) = struct.unpack_from("<q", data, start)
    if table == -1:  # written by a program that could not go back: it stands at the end
        (table,) = struct.unpack_from("<q", data, len(data) - 8)
    if not start + 8 <= table <= len(data) - 8:
        raise CloudError(f"{source}: the table of its packed points is not there (cut off?); copy it again.")
    _, chunks = struct.unpack_from("<II", data, table)
    if chunks > (table - start - 8) // _SHORTEST_CHUNK:
        raise CloudError(f"{source} claims {chunks} packed chunks in {table - start - 8} bytes; export it again.")
    return int(table)


def _items(record: bytes, source: str) -> tuple[int, int]:
    """Bytes of a point, and number of layers of a chunk (0 where it has none)."""
    if len(record) >= _ITEMS_FROM + 2:
        (count,) = struct.unpack_from("<H", record, _ITEMS_FROM)
        if len(record) >= _ITEMS_FROM + 2 + 6 * count:
            items = [struct.unpack_from("<HHH", record, _ITEMS_FROM + 2 + 6 * k) for k in range(count)]
            layers = sum(size if kind == _EXTRA else _LAYERS.get(kind, 0) for kind, size, _ in items)
            return sum(size for _, size, _ in items), layers
    raise CloudError(f"{source}: the description of its packing is cut off; copy or export it again.")

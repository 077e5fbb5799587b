"""The public header of a LAS or LAZ file, checked before a library acts on its numbers."""

from __future__ import annotations

import struct

from navcore.errors import CloudError

_SHORTEST = {2: 227, 3: 235, 4: 375}
_RECORD_HEADER, _LONG_RECORD_HEADER = 54, 60
_COMPRESSED = 0x80
# Arithmetic coding of LAZ: constant points take next to nothing, so a count is bounded by chunks, not by bytes.
_MOST_POINTS = 2_000_000_000


def check_header(data: bytes, source: str) -> None:
    """Raises CloudError where the header is no LAS header, or claims more than the file can hold."""
    if len(data) < 227 or not data.startswith(b"LASF"):
        raise CloudError(f"{source} is no LAS or LAZ file: it does not start with a whole LASF header.")
    major, minor = data[24], data[25]
    size, start, records, kind, length, points = struct.unpack_from("<HIIBHI", data, 94)
    shortest = _SHORTEST.get(minor, 227)
    if major != 1 or not 0 <= minor <= 4:
        raise CloudError(f"{source} says LAS {major}.{minor}; versions 1.0 to 1.4 are read.")
    if not shortest <= size <= start <= len(data):
        raise CloudError(f"{source}: its header says that points start at byte {start} of {len(data)} (cut off?).")
    if records * _RECORD_HEADER > start - size:
        raise CloudError(f"{source}: its header claims {records} records in {start - size} bytes; export it again.")
    if minor == 4:
        points = max(points, _check_long(data, source))
    if not kind & _COMPRESSED and points * length > len(data) - start:
        whole = (len(data) - start) // max(1, length)
        raise CloudError(f"{source} ends after point {whole} of {points} (cut off?); copy or export it again.")
    if points > _MOST_POINTS or length == 0:
        raise CloudError(f"{source}: its header claims {points} points of {length} bytes; export it again.")


def _check_long(data: bytes, source: str) -> int:
    """The number of points of a 1.4 header, its long records checked."""
    first, records, points = struct.unpack_from("<QIQ", data, 235)
    if records and records * _LONG_RECORD_HEADER > len(data) - first:
        raise CloudError(f"{source}: its header claims {records} records at its end that are not there (cut off?).")
    return int(points)

"""An NDT map as one file: what is cut off, changed or foreign is refused with a sentence.

    16 bytes   "Rowpilot NDT map"
    <IIQ       version, length of the header, length of the body, bytes
    32 bytes   SHA-256 of header and body
    header     JSON: datum, how points become Gaussians, size and number of cells of each grid
    body       zlib: of each grid its keys (int64), then its sums (10 float64 a cell), little-endian

Gaussians are made anew from the sums.
"""

from __future__ import annotations

import hashlib
import struct
import zlib
from pathlib import Path

import msgspec
import numpy as np

from navcore.disk import write_durably
from navcore.errors import NdtMapError
from navcore.maps.ndt.cell_grid import CellGrid, CellParams
from navcore.maps.ndt.cell_kernels import SUMS
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams
from navcore.maps.site_map import Datum

_MAGIC, _VERSION = b"Rowpilot NDT map", 1
_LENGTHS = struct.Struct("<IIQ")
_START = len(_MAGIC) + _LENGTHS.size + 32
_CELL_BYTES = 8 * (1 + SUMS)


class _Grid(msgspec.Struct, forbid_unknown_fields=True):
    size: float
    cells: int


class _Header(msgspec.Struct, forbid_unknown_fields=True):
    datum: Datum | None
    cells: CellParams
    grids: list[_Grid]


def ndt_map_bytes(ndt_map: NdtMap) -> bytes:
    """The file of a map; the same map gives the same bytes."""
    grids = [_Grid(size=grid.size, cells=len(grid)) for grid in ndt_map.grids]
    header = msgspec.json.encode(_Header(datum=ndt_map.datum, cells=ndt_map.params.cells, grids=grids))
    arrays = [array for grid in ndt_map.grids for array in (grid.keys.astype("<i8"), grid.sums.astype("<f8"))]
    body = zlib.compress(b"".join(array.tobytes() for array in arrays), level=1)
    digest = hashlib.sha256(header + body).digest()
    return _MAGIC + _LENGTHS.pack(_VERSION, len(header), len(body)) + digest + header + body


def write_ndt_map(path: Path, ndt_map: NdtMap) -> None:
    """Write a map, whole or not at all. Raises NdtMapError."""
    try:
        write_durably(path, ndt_map_bytes(ndt_map))
    except OSError as error:
        raise NdtMapError(f"{path} cannot be written: {error.strerror or error}.") from None


def read_ndt_map(path: Path) -> NdtMap:
    """The map of a file. Raises NdtMapError that says what is wrong with it and what to do."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise NdtMapError(f"{path} cannot be read: {error.strerror or error}.") from None
    return ndt_map_of(data, str(path))


def ndt_map_of(data: bytes, source: str) -> NdtMap:
    """The map that `ndt_map_bytes` wrote; `source` is the file's name. Raises NdtMapError."""
    header, body = _checked(data, source)
    sizes = tuple(grid.size for grid in header.grids)
    falling = all(a > b for a, b in zip(sizes, (*sizes[1:], 0.0), strict=True)) and np.isfinite(sizes).all()
    if not sizes or not falling or any(grid.cells < 0 for grid in header.grids) or not _sound(header.cells):
        raise NdtMapError(f"{source}: its cells are not to be believed; build the map again.")
    unpacked = _unpacked(body, sum(grid.cells for grid in header.grids) * _CELL_BYTES, source)
    ndt_map = NdtMap(NdtMapParams(sizes=sizes, cells=header.cells), datum=header.datum)
    ndt_map.grids = tuple(_grids(header, unpacked, source))
    return ndt_map


def ndt_datum_of(data: bytes, source: str) -> Datum | None:
    """Where the map of `ndt_map_bytes` lies on the Earth, None where that is not known; no cell is made.

    Raises NdtMapError for a file that is cut off, changed or foreign, as `ndt_map_of` does.
    """
    return _checked(data, source)[0].datum


def _checked(data: bytes, source: str) -> tuple[_Header, bytes]:
    if not data.startswith(_MAGIC) or len(data) < _START:
        raise NdtMapError(f"{source} is no NDT map; choose a file that `rowpilot map` wrote.")
    version, header_size, body_size = _LENGTHS.unpack_from(data, len(_MAGIC))
    if version != _VERSION:
        raise NdtMapError(f"{source} has version {version}, this program reads {_VERSION}: update it, or map again.")
    if len(data) != _START + header_size + body_size:
        raise NdtMapError(
            f"{source} is {len(data)} bytes long instead of {_START + header_size + body_size}: it is cut off or has "
            "something added; copy it again."
        )
    if hashlib.sha256(data[_START:]).digest() != data[_START - 32 : _START]:
        raise NdtMapError(f"{source} was changed or damaged after it was written; copy it again or map again.")
    try:
        return msgspec.json.decode(data[_START : _START + header_size], type=_Header), data[_START + header_size :]
    except msgspec.MsgspecError as error:
        raise NdtMapError(f"{source}: its header cannot be read ({error}); build the map again.") from None


def _sound(cells: CellParams) -> bool:
    return cells.least >= 2 and 0.0 <= cells.flattest <= 1.0 and 0.0 < cells.floor < 1.0 and cells.uniform >= 0.0


def _unpacked(body: bytes, size: int, source: str) -> bytes:
    """No more than the header counts, whatever the packed bytes would give."""
    unpacker = zlib.decompressobj()
    try:
        unpacked = unpacker.decompress(body, size + 1)
    except zlib.error:
        unpacked = b""
    if len(unpacked) != size:
        raise NdtMapError(f"{source} holds something else than the {size} bytes of cells it counts; map again.")
    return unpacked


def _grids(header: _Header, unpacked: bytes, source: str) -> list[CellGrid]:
    grids, at = [], 0
    for grid in header.grids:
        keys = np.frombuffer(unpacked, dtype="<i8", count=grid.cells, offset=at).astype(np.int64)
        at += 8 * grid.cells
        sums = np.frombuffer(unpacked, dtype="<f8", count=SUMS * grid.cells, offset=at).reshape(-1, SUMS)
        at += 8 * SUMS * grid.cells
        if not np.isfinite(sums).all() or (keys < 0).any() or len(np.unique(keys)) != len(keys):
            raise NdtMapError(f"{source}: a cell of {grid.size:g} m is not finite or there twice; map again.")
        grids.append(CellGrid.of(grid.size, keys, sums.astype(np.float64), header.cells))
    return grids

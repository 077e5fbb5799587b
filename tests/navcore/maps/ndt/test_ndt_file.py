"""A map comes back from its file as it was, and from no other file."""

from __future__ import annotations

import hashlib
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.errors import NdtMapError
from navcore.maps.ndt.ndt_file import ndt_datum_of, ndt_map_bytes, ndt_map_of, read_ndt_map, write_ndt_map
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Datum

DATUM = Datum(lat_deg=52.1, lon_deg=7.6, height_m=61.25, frame="ETRS89", corrections="SAPOS")


def small_map() -> NdtMap:
    ndt_map = NdtMap(datum=DATUM)
    ndt_map.add(np.random.default_rng(4).normal(0.0, 5.0, (5000, 3)))
    return ndt_map


BYTES = ndt_map_bytes(small_map())


def test_a_map_comes_back_as_it_was(tmp_path: Path) -> None:
    before, file = small_map(), tmp_path / "pears.ndt"
    write_ndt_map(file, before)
    after = read_ndt_map(file)
    assert after.datum == DATUM
    assert after.params == before.params
    for a, b in zip(before.grids, after.grids, strict=True):
        assert np.array_equal(a.sums, b.sums)
        assert np.array_equal(a.cells()[2][: len(a)], b.cells()[2][: len(b)])
    assert [f.name for f in tmp_path.iterdir()] == ["pears.ndt"]


def test_a_map_that_came_back_grows_on() -> None:
    more = np.random.default_rng(5).normal(3.0, 5.0, (3000, 3))
    kept, read = small_map(), ndt_map_of(BYTES, "a.ndt")
    kept.add(more)
    read.add(more)
    assert ndt_map_bytes(kept) == ndt_map_bytes(read)


def test_an_empty_map_is_a_file_too() -> None:
    assert len(ndt_map_of(ndt_map_bytes(NdtMap()), "a.ndt")) == 0


@pytest.mark.parametrize("size", [0, 5, 40, 64, 200, len(BYTES) // 2, len(BYTES) - 1])
def test_a_file_that_was_cut_off_is_refused(size: int) -> None:
    with pytest.raises(NdtMapError, match=r"a\.ndt is"):
        ndt_map_of(BYTES[:size], "a.ndt")
    with pytest.raises(NdtMapError, match=r"a\.ndt is"):
        ndt_datum_of(BYTES[:size], "a.ndt")


def test_a_file_tells_where_it_lies_on_the_earth() -> None:
    assert ndt_datum_of(BYTES, "a.ndt") == DATUM
    assert ndt_datum_of(ndt_map_bytes(NdtMap()), "a.ndt") is None


@settings(max_examples=100, deadline=None)
@given(at=st.integers(0, len(BYTES) - 1), bit=st.integers(0, 7))
def test_a_file_with_one_changed_bit_is_refused(at: int, bit: int) -> None:
    changed = bytearray(BYTES)
    changed[at] ^= 1 << bit
    with pytest.raises(NdtMapError, match=r"a\.ndt"):
        ndt_map_of(bytes(changed), "a.ndt")


def test_a_newer_file_is_told_from_a_broken_one() -> None:
    with pytest.raises(NdtMapError, match="has version 2"):
        ndt_map_of(BYTES[:16] + struct.pack("<I", 2) + BYTES[20:], "a.ndt")


def with_header(header: bytes, body: bytes) -> bytes:
    """A file whose checksum is right."""
    digest = hashlib.sha256(header + body).digest()
    return BYTES[:16] + struct.pack("<IIQ", 1, len(header), len(body)) + digest + header + body


def parts() -> tuple[bytes, bytes]:
    _, size, _ = struct.unpack_from("<IIQ", BYTES, 16)
    return BYTES[64 : 64 + size], BYTES[64 + size :]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b'"size":2.0', b'"size":0.1'), (b'"size":0.5', b'"size":-0.5'), (b'"cells":', b'"cells":9'),
        (b'"floor":0.0001', b'"floor":0.0'), (b'"grids":[', b'"grids":[[],'), (b"{", b"}"),
        (b'"least":6', b'"least":0'),
    ],
)  # fmt: skip
def test_a_header_that_lies_is_refused(old: bytes, new: bytes) -> None:
    header, body = parts()
    assert old in header
    with pytest.raises(NdtMapError, match=r"a\.ndt"):
        ndt_map_of(with_header(header.replace(old, new), body), "a.ndt")


def test_a_file_that_cannot_be_read_or_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(NdtMapError, match="cannot be read"):
        read_ndt_map(tmp_path / "none.ndt")
    (tmp_path / "no folder").write_bytes(b"")
    with pytest.raises(NdtMapError, match="cannot be written"):
        write_ndt_map(tmp_path / "no folder" / "a.ndt", NdtMap())

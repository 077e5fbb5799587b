"""Cut off, changed and lying files: a sentence that names file and place, or finite points, and nothing else."""

from __future__ import annotations

import re
import struct
import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.errors import CloudError
from navcore.maps.cloud_files.file_cloud import FileCloud
from navcore.maps.cloud_files.kitti import read_kitti
from navcore.maps.cloud_files.laz import laz_bytes, read_laz
from navcore.maps.cloud_files.pcd import read_pcd
from navcore.maps.cloud_files.ply import read_ply
from tests.navcore.maps.cloud_files.written_clouds import kitti, pcd, ply, some_points

POINTS = some_points().points
Reader = Callable[[bytes, str], FileCloud]
GOOD: dict[str, tuple[Reader, bytes]] = {
    "ascii.pcd": (read_pcd, pcd(POINTS, "ascii")),
    "binary.pcd": (read_pcd, pcd(POINTS, "binary")),
    "compressed.pcd": (read_pcd, pcd(POINTS, "binary_compressed")),
    "ascii.ply": (read_ply, ply(POINTS, "ascii")),
    "binary.ply": (read_ply, ply(POINTS, "binary_big_endian")),
    "scan.bin": (read_kitti, kitti(POINTS)),
    "farm.laz": (read_laz, laz_bytes(some_points(), origin=(5e5, 5e6, 100.0), epsg=25832)),
}


@pytest.mark.parametrize("name", list(GOOD))
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_changed_bytes_give_points_or_a_sentence(name: str, data: st.DataObject) -> None:
    reader, good = GOOD[name]
    broken = bytearray(good)
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, min(len(good), 700) - 1) | st.integers(0, len(good) - 1))
        new = data.draw(st.binary(min_size=1, max_size=8) | st.sampled_from((b"\xff" * 4, bytes(4))))
        broken[at : at + len(new)] = new
    assert told_or_finite(reader, bytes(broken), name)


@pytest.mark.parametrize("name", list(GOOD))
@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9, 0.99])
def test_a_file_that_was_cut_off_is_refused(name: str, share: float) -> None:
    reader, good = GOOD[name]
    size = int(share * (len(good) - 20))  # a PLY's last bytes are a face, which nobody reads
    cut = good[: size // 16 * 16 + 5]  # KITTI's whole points are a shorter scan
    with pytest.raises(CloudError, match=re.escape(name)):
        reader(cut, name)


def test_the_place_where_a_file_ends_is_told() -> None:
    with pytest.raises(CloudError, match="ends after point 11 of 40"):
        read_pcd(pcd(POINTS, body=pcd(POINTS[:11]).split(b"DATA binary\n")[1], width=40), "a.pcd")


def test_the_line_that_is_no_point_is_told() -> None:
    lines = pcd(POINTS, "ascii").split(b"\n")
    lines[11 + 4] = b"1.0 2.0 0 0 0 three"
    with pytest.raises(CloudError, match=r'point 5 is "1\.0 2\.0 0 0 0 three"'):
        read_pcd(b"\n".join(lines), "a.pcd")
    lines[11 + 4] = b"1.0 2.0 3.0"
    with pytest.raises(CloudError, match="point 5 is"):
        read_pcd(b"\n".join(lines), "a.pcd")


def laz_with(at: int, new: bytes) -> bytes:
    good = GOOD["farm.laz"][1]
    return good[:at] + new + good[at + len(new) :]


def told_or_finite(reader: Reader, data: bytes, name: str) -> bool:
    try:
        return bool(np.isfinite(reader(data, name).cloud.points).all())
    except CloudError as error:
        return name in str(error)


def lying() -> list[tuple[Reader, bytes]]:
    """Files that claim billions of points, chunks, records or bytes."""
    good = GOOD["farm.laz"][1]
    start = struct.unpack_from("<I", good, 96)[0]
    table = struct.unpack_from("<q", good, start)[0]
    many = b"\xff\xff\xff\x7f"
    return [
        (read_pcd, pcd(POINTS, "binary", width=99_999_999_999)),
        (read_pcd, pcd(POINTS, "ascii", width=99_999_999_999)),
        (read_pcd, pcd(POINTS, "binary_compressed", width=2**28, body=struct.pack("<II", 9, 15 * 2**28) + bytes(9))),
        (read_pcd, pcd(POINTS).replace(b"COUNT 1 1 3 1", b"COUNT 1 1 99999999999 1")),
        (read_ply, ply(POINTS, "binary_little_endian", vertices=99_999_999_999)),
        (read_ply, ply(POINTS, "ascii", vertices=99_999_999_999)),
        (read_laz, laz_with(table + 4, many)),
        (read_laz, laz_with(start + 8 + 30 + 4, many)),
        (read_laz, laz_with(100, many)),
        (read_laz, laz_with(247, many + bytes(4))),
    ]


@pytest.mark.parametrize("case", range(10))
def test_no_room_is_made_for_what_a_header_only_claims(case: int) -> None:
    reader, data = lying()[case]
    tracemalloc.start()
    with pytest.raises(CloudError, match="lie"):
        reader(data, "lie")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 30e6  # bytes


def test_what_is_no_pcd_ply_or_las_is_told() -> None:
    for reader in (read_pcd, read_ply, read_laz):
        for data in (b"", b"\0" * 5000, b"<html>" * 100):
            with pytest.raises(CloudError, match=r"what\.x"):
                reader(data, "what.x")


def test_points_nowhere_on_earth_are_refused() -> None:
    points = POINTS.copy()
    points[5, 2] = 1e30
    with pytest.raises(CloudError, match="point 6 is further away"):
        read_pcd(pcd(points), "a.pcd")
    with pytest.raises(CloudError, match="point 6 is further than 1 km"):
        read_kitti(kitti(points), "0.bin")

"""Files of points come in as they were written, whoever wrote them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.cloud_file import read_cloud, write_cloud
from navcore.maps.cloud_files.kitti import read_kitti
from navcore.maps.cloud_files.laz import laz_bytes, read_laz
from navcore.maps.cloud_files.lzf import decompress
from navcore.maps.cloud_files.pcd import read_pcd
from navcore.maps.cloud_files.ply import read_ply
from tests.navcore.maps.cloud_files.written_clouds import kitti, lzf, pcd, pcd_body, ply, some_points

CLOUD = some_points()
REAL = "lidar3d/251370668.pcd"


@pytest.mark.parametrize("form", ["ascii", "binary", "binary_compressed"])
def test_every_form_of_pcd_gives_the_same_points(form: str) -> None:
    found = read_pcd(pcd(CLOUD.points, form), "a.pcd")
    assert np.array_equal(found.cloud.points, CLOUD.points)
    assert found.dropped == 0
    assert found.origin == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_every_form_of_ply_gives_the_same_points(form: str) -> None:
    found = read_ply(ply(CLOUD.points, form), "a.ply")
    assert np.array_equal(found.cloud.points, CLOUD.points)
    assert (found.cloud.intensities == 7).all()


def test_kitti_scans_give_points_and_intensity() -> None:
    found = read_kitti(kitti(CLOUD.points), "0.bin")
    assert np.array_equal(found.cloud.points, CLOUD.points)
    assert (found.cloud.intensities == 128).all()  # 0.5 of 255, rounded to even


@pytest.mark.parametrize("form", ["ascii", "binary", "binary_compressed"])
def test_rays_without_an_echo_are_dropped_and_counted(form: str) -> None:
    points = CLOUD.points.copy()
    points[3], points[7, 1] = np.nan, np.inf
    found = read_pcd(pcd(points, form), "organised.pcd")
    assert found.dropped == 2
    assert np.array_equal(found.cloud.points, np.delete(CLOUD.points, (3, 7), axis=0))


@pytest.mark.parametrize("ending", [".pcd", ".laz"])
def test_what_was_written_is_read(tmp_path: Path, ending: str) -> None:
    write_cloud(tmp_path / f"a{ending}", CLOUD)
    found = read_cloud(tmp_path / f"a{ending}").cloud
    assert np.abs(found.points - CLOUD.points).max() <= 0.0005  # m, half a step of LAZ
    assert np.array_equal(found.intensities, CLOUD.intensities)
    assert [file.name for file in tmp_path.iterdir()] == [f"a{ending}"]


def test_pcd_keeps_rings_and_times(tmp_path: Path) -> None:
    write_cloud(tmp_path / "a.pcd", CLOUD)
    found = read_cloud(tmp_path / "a.pcd").cloud
    assert np.array_equal(found.rings, CLOUD.rings)
    assert np.array_equal(found.times, CLOUD.times)


@pytest.mark.parametrize("ending", [".pcd", ".laz"])
def test_a_cloud_without_points_is_a_file_without_points(tmp_path: Path, ending: str) -> None:
    write_cloud(tmp_path / f"none{ending}", PointCloud.of(np.empty((0, 3))))
    assert len(read_cloud(tmp_path / f"none{ending}").cloud) == 0


def test_georeferenced_points_keep_their_millimetres() -> None:
    where = (691_000.0, 5_334_000.0, 520.0)
    found = read_laz(laz_bytes(CLOUD, origin=where, epsg=25832), "farm.laz")
    assert found.crs == "EPSG:25832"
    assert np.abs(found.cloud.points).max() < 1000.0  # m, near their own origin
    assert np.abs(found.cloud.points + found.origin - CLOUD.points - where).max() <= 0.00051  # m


def test_times_that_are_no_seconds_before_a_stamp_are_left_out() -> None:
    body = "".join(f"{k} 0 0 {1.7e9 + k}\n" for k in range(3)).encode()
    data = pcd(np.zeros((3, 3)), "ascii", body=body).replace(b"FIELDS x y _ z", b"FIELDS x y z time")
    data = data.replace(b"SIZE 4 4 1 4", b"SIZE 4 4 4 8").replace(b"TYPE F F U F", b"TYPE F F F F")
    assert (read_pcd(data.replace(b"COUNT 1 1 3 1", b"COUNT 1 1 1 1"), "a.pcd").cloud.times == 0.0).all()


def test_packed_bytes_come_back() -> None:
    data = pcd_body(CLOUD.points, "binary") + bytes(5000) + b"abcabcabc" * 40
    assert decompress(lzf(data), len(data)) == data


def test_a_recorded_scan_is_read(shared_data: Path) -> None:
    if not (shared_data / REAL).exists():
        pytest.skip(f"no {REAL}")
    found = read_cloud(shared_data / REAL)
    assert len(found.cloud) == 69_088
    assert found.dropped == 0
    assert np.abs(found.cloud.points).max() < 120.0  # m, what the sensor reaches


def test_a_file_of_another_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CloudError, match=r"ends in \.pcd, \.ply"):
        read_cloud(tmp_path / "points.xyz")
    with pytest.raises(CloudError, match="cannot be read"):
        read_cloud(tmp_path / "missing.pcd")
    with pytest.raises(CloudError, match=r"\.pcd or \.laz"):
        write_cloud(tmp_path / "a.ply", CLOUD)


def test_pcd_is_not_written_where_it_would_lose_millimetres(tmp_path: Path) -> None:
    with pytest.raises(CloudError, match="write a LAZ file"):
        write_cloud(tmp_path / "far.pcd", PointCloud.of(CLOUD.points + 5e5))

"""`rowpilot register` and `rowpilot odometry`: clouds in, poses out, and a sentence where that cannot be."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.maps.cloud_files.cloud_file import write_cloud
from navcore.maps.cloud_files.laz import laz_bytes
from tests.navcore.localization.ndt.trellis import scan_at

RUN = CliRunner()
TARGET, SOURCE = SE3.from_rpy((1.0, 0.2, 1.2)), SE3.from_rpy((1.5, 0.1, 1.2), yaw=0.08)
MOVED = TARGET.inverse() @ SOURCE


def written(folder: Path, name: str, pose: SE3, seed: int) -> Path:
    write_cloud(folder / name, PointCloud.of(scan_at(pose, seed, n=20_000)))
    return folder / name


def registered(*arguments: object) -> tuple[int, dict[str, object], str]:
    done = RUN.invoke(app, ["register", *map(str, arguments), "--json"])
    return done.exit_code, json.loads(done.stdout) if done.stdout else {}, done.stderr


def test_a_cloud_is_laid_onto_another_of_another_kind(tmp_path: Path) -> None:
    code, told, _ = registered(written(tmp_path, "a.pcd", SOURCE, 1), written(tmp_path, "b.laz", TARGET, 2))
    T = np.array(told["T_target_source"])
    assert code == 0
    np.testing.assert_allclose(T[:3, 3], MOVED.t, atol=0.03)  # m
    np.testing.assert_allclose(T[:3, :3], MOVED.R, atol=0.005)  # rad
    assert np.linalg.eigvalsh(np.array(told["covariance"])).min() > 0.0
    assert {"score", "milliseconds", "converged", "weak"} <= told.keys()


def test_georeferenced_clouds_keep_their_origin(tmp_path: Path) -> None:
    for name, seed in (("a.laz", 1), ("b.laz", 2)):
        origin = (691_000.0, 5_334_000.0, 520.0)
        (tmp_path / name).write_bytes(laz_bytes(PointCloud.of(scan_at(TARGET, seed, n=20_000)), origin=origin))
    code, told, _ = registered(tmp_path / "a.laz", tmp_path / "b.laz")
    assert code == 0
    assert np.abs(np.array(told["T_target_source"])[:3, 3]).max() < 0.03  # m, about the origin that is told
    assert np.array(told["origin"])[0] > 690_000.0


def test_a_recorded_pair_comes_to_where_others_have_it(shared_data: Path) -> None:
    pair = [shared_data / "lidar3d" / f"{name}.pcd" for name in ("251371071", "251370668")]
    if not all(file.exists() for file in pair):
        pytest.skip("no recorded pair")
    code, told, _ = registered(*pair)
    T = np.array(told["T_target_source"])
    assert code == 0
    assert np.linalg.norm(T[:3, 3] - (0.493, 0.127, -0.026)) < 0.05  # m, small_gicp's GICP at 0.25 m
    assert abs(np.degrees(np.arctan2(T[1, 0], T[0, 0])) + 0.85) < 0.5  # deg


def test_clouds_that_do_not_meet_end_with_a_reason(tmp_path: Path) -> None:
    far = PointCloud.of(scan_at(TARGET, 2, n=20_000) + np.array((500.0, 0.0, 0.0)))
    write_cloud(tmp_path / "far.pcd", far)
    code, told, _ = registered(written(tmp_path, "a.pcd", SOURCE, 1), tmp_path / "far.pcd")
    assert code == 1
    assert told["converged"] is False
    assert "where the map has any" in str(told["reason"])


def test_files_that_are_no_clouds_end_with_a_sentence(tmp_path: Path) -> None:
    good = written(tmp_path, "a.pcd", SOURCE, 1)
    (tmp_path / "cut.pcd").write_bytes(good.read_bytes()[:5000])
    write_cloud(tmp_path / "none.pcd", PointCloud.of(np.empty((0, 3))))
    for bad, why in (
        ("cut.pcd", "cut off"),
        ("none.pcd", "SOURCE holds no points"),
        ("missing.pcd", "cannot be read"),
    ):
        code, told, errors = registered(tmp_path / bad, good)
        assert (code, told) == (2, {})
        assert why in errors


def test_a_folder_of_scans_gives_a_trajectory(tmp_path: Path) -> None:
    poses = [SE3.from_rpy((0.4 * k, 0.0, 1.2), yaw=0.02 * k) for k in range(12)]
    for k, pose in enumerate(poses):
        written(tmp_path, f"{k}.pcd", pose, 30 + k)  # 10.pcd comes after 9.pcd
    done = RUN.invoke(app, ["odometry", str(tmp_path), "--period", "0.2", "--output", str(tmp_path / "out.txt")])
    assert done.exit_code == 0
    rows = np.loadtxt(tmp_path / "out.txt")
    expected = np.array([(poses[0].inverse() @ pose).t for pose in poses])
    np.testing.assert_allclose(rows[:, 0], 0.2 * np.arange(12), atol=1e-6)  # s
    np.testing.assert_allclose(rows[:, 1:4], expected, atol=0.05)  # m
    np.testing.assert_allclose(2.0 * np.arctan2(rows[:, 6], rows[:, 7]), 0.02 * np.arange(12), atol=0.005)  # rad
    assert "12 scans, 0 of them not matched" in done.stderr


def test_a_folder_without_scans_ends_with_a_sentence(tmp_path: Path) -> None:
    done = RUN.invoke(app, ["odometry", str(tmp_path)])
    assert done.exit_code == 2
    assert "holds no scan" in done.stderr

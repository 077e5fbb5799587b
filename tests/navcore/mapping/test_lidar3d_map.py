"""A drive with a 3D LiDAR becomes a map: where it truly is, killed or not, and it says what it is not sure of."""

from __future__ import annotations

import dataclasses
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from navcore.errors import InputError, LogError
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive import Drive
from navcore.mapping.lidar3d.map_maker import MadeMap, MapMaker
from navcore.mapping.lidar3d.map_output import write_map
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.maps.cloud_files.cloud_file import read_cloud
from navcore.maps.ndt.ndt_file import ndt_map_bytes, read_ndt_map
from navcore.messages import NavInputs
from tests.navcore.mapping.point_orchard import DATUM, START_NS, TICK_NS, DriveCase, drive, path


def made(folder: Path, a_drive: Drive) -> tuple[MadeMap, list[int]]:
    work = WorkFolder(folder, a_drive.name, "settings")
    done = MapMaker(a_drive, work).make()
    return done, [k.stamp_ns for k in work]


def truth(case: DriveCase, stamps_ns: list[int]) -> list[SE3]:
    poses = path(case)
    return [poses[(ns - START_NS) // TICK_NS] for ns in stamps_ns]


def errors(poses: tuple[SE3, ...], true: list[SE3]) -> np.ndarray:
    """In the plane, m (N,)."""
    return np.array([np.hypot(*(T.t - G.t)[:2]) for T, G in zip(poses, true, strict=True)])


@pytest.fixture(scope="module")
def usual(tmp_path_factory: pytest.TempPathFactory) -> tuple[MadeMap, list[int]]:
    return made(tmp_path_factory.mktemp("usual"), drive())


def test_a_u_shaped_drive_lies_where_it_was_driven(usual: tuple[MadeMap, list[int]]) -> None:
    done, stamps = usual
    assert errors(done.poses, truth(DriveCase(), stamps)).max() < 0.05  # m; the wheels over-read by 3 %
    assert done.report.georeferenced
    assert done.report.loops_taken >= 3
    assert done.report.doubts == ()
    assert done.ndt.datum == DATUM


def test_without_a_receiver_the_map_is_whole_but_lies_nowhere(tmp_path: Path) -> None:
    case = DriveCase(gnss=False)
    done, stamps = made(tmp_path, drive(case))
    true = truth(case, stamps)
    first = true[0] @ done.poses[0].inverse()
    assert errors(tuple(first @ T for T in done.poses), true).max() < 0.15  # m; the first metre is odometry's
    assert not done.report.georeferenced
    assert done.ndt.datum is None
    assert any("not georeferenced" in doubt for doubt in done.report.doubts)


def test_a_run_of_no_known_site_says_that_this_is_why_it_lies_nowhere(tmp_path: Path) -> None:
    done, _ = made(tmp_path, drive(DriveCase(length=3.0), datum=None))
    assert done.report.doubts == ("The map is not georeferenced: the run does not say on which site it was driven.",)
    assert done.report.lost == 0


def test_a_receiver_that_lies_by_two_metres_is_noticed_and_said(tmp_path: Path) -> None:
    case = DriveCase(lies=(700, 1000))
    done, stamps = made(tmp_path, drive(case))
    assert errors(done.poses, truth(case, stamps)).max() < 0.08  # m
    assert done.report.fixes_doubted >= 4
    assert any("contradict the drive by up to 2.0 m" in doubt for doubt in done.report.doubts)


def test_a_drive_cut_anywhere_and_taken_up_again_gives_the_same_map(
    usual: tuple[MadeMap, list[int]], tmp_path: Path
) -> None:
    whole = drive()
    cut = dataclasses.replace(whole, sensed=lambda: islice(whole.sensed(), 1500))
    made(tmp_path, cut)
    (tmp_path / "000007.npz").write_bytes(b"cut off")
    done, stamps = made(tmp_path, whole)
    assert stamps == usual[1]
    assert ndt_map_bytes(done.ndt) == ndt_map_bytes(usual[0].ndt)


def test_what_is_written_is_what_was_made(usual: tuple[MadeMap, list[int]], tmp_path: Path) -> None:
    paths = write_map(tmp_path / "out", usual[0])
    assert [file.name for file in paths] == ["map.ndt", "cloud.laz", "cloud.pcd", "report.json"]
    assert ndt_map_bytes(read_ndt_map(paths[0])) == ndt_map_bytes(usual[0].ndt)
    for file in paths[1:3]:
        read = read_cloud(file)
        assert np.array(read.origin) + read.cloud.points == pytest.approx(usual[0].cloud.points, abs=0.001)  # m


def test_a_work_folder_of_another_drive_is_refused(tmp_path: Path) -> None:
    WorkFolder(tmp_path, "one", "settings")
    with pytest.raises(InputError, match="holds another drive"):
        WorkFolder(tmp_path, "two", "settings")
    with pytest.raises(InputError, match="other settings"):
        WorkFolder(tmp_path, "one", "others")
    strange = tmp_path / "strange"
    strange.mkdir()
    (strange / "letter.txt").write_text("mine")
    with pytest.raises(InputError, match="Name another one"):
        WorkFolder(strange, "one", "settings")


def test_a_drive_without_clouds_says_so(tmp_path: Path) -> None:
    blind = dataclasses.replace(drive(), sensed=lambda: (s for s in drive().sensed() if isinstance(s, NavInputs)))
    with pytest.raises(LogError, match="no clouds of a 3D LiDAR"):
        made(tmp_path, blind)


def test_a_robot_that_stood_still_gives_nothing_to_map(tmp_path: Path) -> None:
    still = dataclasses.replace(drive(), sensed=lambda: islice(drive().sensed(), 24))
    with pytest.raises(LogError, match="did not move"):
        made(tmp_path, still)

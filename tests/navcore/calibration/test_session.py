"""A person with a board before the live camera: poses are taken by themselves, kept on disk, and tell the camera."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from navcore.calibration.board import Image
from navcore.calibration.intrinsics import CameraIntrinsics
from navcore.calibration.session.lidar_job import NO_LIDAR
from navcore.calibration.session.scan_store import ScanStore
from navcore.errors import CalibrationError
from navcore.messages import BoardPhase, LidarScan, RawPicture
from navcore.sim.board_rehearsal import CAMERA, true_mount
from tests.navcore.calibration.rehearsed import (
    FRAME_NS,
    FRONT,
    LIDAR_SETUP,
    MS,
    SETUP,
    Rehearsed,
    begun,
    camera_job,
    lidar_job,
    raw,
)


@pytest.fixture(autouse=True, scope="module")
def one_thread() -> Iterator[None]:
    """As in the process: OpenCV's own threads wait for each other on a busy machine."""
    before = cv2.getNumThreads()
    cv2.setNumThreads(1)
    yield
    cv2.setNumThreads(before)


@pytest.fixture(scope="module")
def blank() -> Image:
    return np.random.default_rng(1).integers(90, 110, (CAMERA.height_px, CAMERA.width_px)).astype(np.uint8)


def test_each_pose_that_is_held_still_is_taken_once_and_the_camera_comes_out(tmp_path: Path) -> None:
    rehearsed = Rehearsed(tmp_path, camera_job(), SETUP, poses=12)
    views = rehearsed.show(12 * 9)
    taken = [view for view in views if view.phase is BoardPhase.TAKEN]
    assert taken
    assert 8 <= views[-1].taken <= 12
    fitted = rehearsed.job.fit(rehearsed.session.poses)
    assert isinstance(fitted.found, CameraIntrinsics)
    assert fitted.found.camera.fx == pytest.approx(CAMERA.fx, rel=0.005)
    assert fitted.result.unit == "px"
    assert set(fitted.errors) | set(fitted.refused) == {pose.name for pose in rehearsed.session.poses}


def test_camera_and_lidar_see_the_board_and_the_mount_comes_out(tmp_path: Path) -> None:
    rehearsed = Rehearsed(tmp_path, lidar_job(), LIDAR_SETUP, poses=14)
    views = rehearsed.show(14 * 9)
    seen = next(view for view in views if view.phase is BoardPhase.TAKEN)
    assert seen.board is not None
    assert len(seen.board.ends) == 2
    assert len(seen.board.rays) > 8
    fitted = rehearsed.job.fit(rehearsed.session.poses)
    values = {value.name: value for value in fitted.result.values}
    for name, true in zip("xyz", true_mount()[:3, 3], strict=True):
        assert values[name].value == pytest.approx(true, abs=0.005)  # m
    assert fitted.result.unit == "sigmas"
    assert len(fitted.result.boards) == fitted.result.poses


def test_nothing_taken_is_lost_when_the_session_begins_again(tmp_path: Path) -> None:
    before = Rehearsed(tmp_path, lidar_job(), LIDAR_SETUP, poses=6)
    before.show(6 * 9)
    count = len(before.session.poses)
    assert count >= 2
    (tmp_path / "099.json").write_text('{"width_px": 960')  # a disk that failed
    after = begun(tmp_path, lidar_job(), LIDAR_SETUP)
    assert (after.resumed, after.lost) == (count, ["099.json"])
    for old, new in zip(before.session.poses, after.poses, strict=True):
        assert np.array_equal(old.sighting.pixels, new.sighting.pixels)
        assert old.scan is not None
        assert new.scan is not None
        assert np.array_equal(old.scan.distances, new.scan.distances)
        assert (old.name, old.kept) == (new.name, new.kept)


def test_a_picture_that_was_thrown_out_stays_out_until_it_is_brought_back(tmp_path: Path) -> None:
    session = Rehearsed(tmp_path, camera_job(), SETUP, poses=1)
    session.show(9)
    session.session.keep("001", kept=False)
    assert not begun(tmp_path, camera_job()).poses[0].kept
    assert session.job.coverage(session.session.poses).share == 0.0
    session.session.keep("001", kept=True)
    assert begun(tmp_path, camera_job()).poses[0].kept
    with pytest.raises(CalibrationError, match="no picture '7'"):
        session.session.keep("7", kept=True)


def test_the_button_takes_a_board_that_is_not_still(tmp_path: Path) -> None:
    rehearsed = Rehearsed(tmp_path, camera_job(), SETUP, poses=1)
    rehearsed.show(1)
    rehearsed.session.ask_to_take()
    assert rehearsed.show(1)[0].phase is BoardPhase.TAKEN
    assert len(rehearsed.session.poses) == 1


def test_a_picture_without_a_board_takes_nothing_even_when_asked_to(tmp_path: Path, blank: Image) -> None:
    session = begun(tmp_path, camera_job())
    session.ask_to_take()
    view = session.see(raw(FRAME_NS), blank)
    assert view.phase is BoardPhase.NO_BOARD
    assert view.words
    assert session.see(raw(2 * FRAME_NS), blank, "A hand is before it.").words == "A hand is before it."
    assert not session.poses


def test_no_camera_is_told_in_its_own_words(tmp_path: Path) -> None:
    told = RawPicture(stamp_ns=1, camera=FRONT, problem="No front camera is set. Name its source in the settings.")
    view = begun(tmp_path, camera_job()).see(told, None)
    assert (view.phase, view.words) == (BoardPhase.NO_PICTURE, told.problem)


def test_pictures_of_another_size_than_before_are_refused(tmp_path: Path, blank: Image) -> None:
    rehearsed = Rehearsed(tmp_path, camera_job(), SETUP, poses=1)
    rehearsed.show(9)
    view = rehearsed.session.see(raw(rehearsed.now_ns + FRAME_NS, 640, 360), blank[:360, :640])
    assert view.phase is BoardPhase.NO_PICTURE
    assert "gives 640x360 pictures now, those taken before are 960x540" in view.words


def test_a_lidar_is_calibrated_only_with_pictures_that_the_lens_is_known_for(tmp_path: Path, blank: Image) -> None:
    session = begun(tmp_path, lidar_job(), LIDAR_SETUP)
    assert "calibrate the camera again first" in session.see(raw(1, 640, 360), blank[:360, :640]).words
    without = replace(raw(2), T_lidar_camera=None)
    assert session.see(without, blank).words == NO_LIDAR
    assert session.see(raw(3), blank).words == "The LiDAR gives no scans. Look at its cable and power."


def test_sensors_out_of_step_are_named_and_nothing_is_taken(tmp_path: Path) -> None:
    rehearsed = Rehearsed(tmp_path, lidar_job(), LIDAR_SETUP, poses=3)
    rehearsed.lidar_late_ns = 400 * MS
    views = rehearsed.show(27)
    assert "LiDAR's scans are 0.4 s older than the pictures" in views[-1].words
    assert views[-1].phase is BoardPhase.NO_PICTURE
    assert views[-1].taken <= 1  # what was held before eight pictures had told


def test_sensors_in_step_within_a_turn_are_not_blamed() -> None:
    store = ScanStore()
    for k in range(40):
        store.hear(LidarScan(stamp_ns=k * 100 * MS, began_ns=(k - 1) * 100 * MS, angles=(0.0,), distances=(1.0,)))
        assert store.problem(k * 100 * MS + (k % 3 - 1) * 60 * MS) == ""


def test_a_board_beside_the_lidars_plane_is_not_taken_and_the_reason_told(tmp_path: Path) -> None:
    """The scan is of an empty room."""
    rehearsed = Rehearsed(tmp_path, lidar_job(), LIDAR_SETUP, poses=4)
    views = []
    for _ in range(4 * 9):
        rehearsed.now_ns += FRAME_NS
        frame = next(rehearsed._frames)
        angles = np.radians(np.arange(0.0, 360.0, 0.5))
        rehearsed.job.hear(
            LidarScan(
                stamp_ns=rehearsed.now_ns, began_ns=rehearsed.now_ns - 100 * MS, angles=tuple(angles),
                distances=tuple(np.full(len(angles), 8.0)),
            )
        )  # fmt: skip
        image = cv2.cvtColor(frame.image, cv2.COLOR_BGR2GRAY).astype(np.uint8)
        views.append(rehearsed.session.see(raw(rehearsed.now_ns), image))
    off = [view for view in views if view.phase is BoardPhase.OFF_SCAN]
    assert off
    assert all("Hold the board into the LiDAR's plane" in view.words for view in off)
    assert views[-1].taken == 0

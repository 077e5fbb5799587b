"""What the rows tell of a camera's mount, over many readings."""

from __future__ import annotations

import pytest

from navcore.messages import CameraMount, CameraName, RowObservation
from navcore.mission.camera_truth import LATELY, CameraTruth


def seen(pitch: float, std: float = 0.01, camera: CameraName = CameraName.FRONT) -> RowObservation:
    mount = CameraMount(pitch=pitch, pitch_std=std, height=0.8 + pitch, height_std=0.03, told_height=0.8)
    return RowObservation(stamp_ns=1, camera=camera, valid=True, reason="", mount=mount)


def told(*rows: RowObservation) -> CameraMount:
    truth = CameraTruth()
    for row in rows:
        truth.take(row)
    assert truth.newest is not None
    return truth.newest


def test_before_the_first_row_nothing_is_known() -> None:
    truth = CameraTruth()
    truth.take(RowObservation(stamp_ns=1, camera=CameraName.FRONT, valid=False, reason="no row"))
    assert truth.newest is None


def test_readings_are_weighed_by_what_they_are_worth() -> None:
    found = told(seen(0.03, std=0.02), seen(0.01, std=0.01), seen(0.01, std=0.01))
    assert found.pitch == pytest.approx(0.01 + 0.02 / 9)  # rad
    assert found.pitch_std < 0.01
    assert found.height_std == 0.03  # wheels slip to the same side


def test_one_reading_alone_tells_nothing() -> None:
    truth = CameraTruth()
    truth.take(seen(0.1))
    assert truth.newest is None


def test_a_mount_that_has_moved_is_believed_after_some_readings() -> None:
    assert told(*[seen(0.0)] * 20, *[seen(0.05)] * LATELY).pitch == pytest.approx(0.05)


def test_each_camera_has_its_own_mount() -> None:
    assert told(*[seen(0.05)] * 3, *[seen(-0.05, camera=CameraName.REAR)] * 3).pitch == pytest.approx(-0.05)

"""A farm hand rehearses both calibrations on Setup, from the first picture to versions that are near the truth."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from navcore.sim.board_rehearsal import CAMERA, true_mount
from tests.browser import driving
from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

HELD_S = 420.0  # 20 poses on a machine that has other work


def test_both_calibrations_are_rehearsed_and_come_out_near_the_truth(
    page: Page, station: RunningStation, witness: Witness
) -> None:
    driving.enter(page, station.address)
    driving.open_page(page, "Setup")
    expect(page.get_by_text("No calibration yet")).to_be_visible()
    expect(page.get_by_text("Calibrate the front camera first")).to_be_visible()

    page.get_by_role("button", name="Calibrate the camera").click()
    expect(page.get_by_text("No board of 8 x 5 inner corners is seen")).to_be_visible(timeout=HELD_S * 1000)
    page.get_by_role("button", name="Leave the calibration").click()

    rehearse(page, 0)
    wait_for_all_poses(page)
    throw_out_and_bring_back(page)
    accept(page, "Ada")
    version = newest(page, station)
    assert version["intrinsics"]["fx"] == pytest.approx(CAMERA.fx, rel=0.004)
    assert version["intrinsics"]["fy"] == pytest.approx(CAMERA.fy, rel=0.004)
    assert version["left_out_px"] < 0.1  # px
    assert version["made_by"] == "Ada"

    rehearse(page, 1)
    wait_for_all_poses(page)
    accept(page, "Ben")
    version = newest(page, station)
    found = np.array(version["T_lidar_camera"]).reshape(4, 4)
    assert np.linalg.norm((found - true_mount())[:3, 3]) < 0.005  # m
    turn = np.arccos(np.clip((np.trace(found[:3, :3].T @ true_mount()[:3, :3]) - 1.0) / 2.0, -1.0, 1.0))
    assert np.degrees(turn) < 0.5
    expect(page.get_by_text("Chosen for rehearsals")).to_have_count(1)
    witness.assert_nothing_happened()


def rehearse(page: Page, job: int) -> None:
    """0: the camera; 1: camera to LiDAR."""
    page.get_by_role("button", name="Rehearse with a simulated board").nth(job).click()
    expect(page.get_by_text("Nothing of it is used for driving")).to_be_visible()


def wait_for_all_poses(page: Page) -> None:
    """The station takes them by itself."""
    done = page.get_by_text("Nothing is missing. Look at the result.")
    expect(done).to_be_visible(timeout=HELD_S * 1000)


def throw_out_and_bring_back(page: Page) -> None:
    first = page.get_by_role("listitem").filter(has=page.get_by_role("button", name="Show picture 1", exact=True))
    first.get_by_role("button", name="Throw out").click()
    expect(first.get_by_text("Thrown out.")).to_be_visible()
    first.get_by_role("button", name="Bring back").click()
    expect(first.get_by_role("button", name="Throw out")).to_be_visible()


def accept(page: Page, name: str) -> None:
    """At once: the station waits until the newest poses are in the result."""
    page.get_by_label("Your name").fill(name)
    page.get_by_role("button", name="Accept the result").click()
    expect(page.get_by_role("heading", name="Calibrations")).to_be_visible()


def newest(page: Page, station: RunningStation) -> dict[str, Any]:
    """The version that is chosen now, which must be of a rehearsal."""
    chosen = [v for v in driving.api(page, f"{station.origin}/api/calibration/versions") if v["in_use"]]
    assert [v["rehearsal"] for v in chosen] == [True]
    version: dict[str, Any] = chosen[0]["version"]
    return version

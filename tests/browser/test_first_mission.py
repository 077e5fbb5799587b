"""What a newcomer does first: open the address, start the ready mission, watch it, stop it, take the log home."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser import driving
from tests.browser.running_station import RunningStation
from tests.browser.witness import Witness

pytestmark = [pytest.mark.browser, pytest.mark.realtime]

READY_MISSION = "1. Row A3, back out in reverse"
STANDING = 0.01  # m/s
JPEG = b"\xff\xd8\xff"
LOGGED = {"nav/inputs", "nav/decision", "nav/status", "nav/plan", "nav/prelude", "chassis/state", "gnss/fix",
          "imu/sample", "sim/truth", "camera/view"}  # fmt: skip


def test_ready_mission_is_started_watched_stopped_and_its_log_taken_home(
    page: Page, station: RunningStation, witness: Witness, tmp_path: Path
) -> None:
    told = driving.record_frames(page)
    driving.enter(page, station.address)
    driving.state_is(page, "Ready")
    expect(page.get_by_role("combobox", name="Mission")).to_have_value(READY_MISSION)
    expect(page.get_by_label("Map").locator("canvas").first).to_be_visible()
    assert driving.api(page, f"{station.origin}/api/sites")[0]["name"] == "Demo farm"

    driving.start_mission(page)
    first = driving.newest(told, "nav/status")
    assert first is not None
    driving.wait_until(page, "the robot has driven five metres", lambda: _way(first, told) > 5.0)
    driving.wait_until(page, "a picture arrives", lambda: driving.newest(told, "camera/view") is not None)
    picture = driving.newest(told, "camera/view")
    assert picture is not None
    assert picture["jpeg"] == JPEG
    assert driving.gauge(page, "Guard") == "armed"

    driving.stop(page)
    driving.wait_until(page, "the robot stands", lambda: _stands(told), timeout_s=20.0)
    driving.open_page(page, "Runs")
    page.get_by_role("link", name="back out in reverse").click()
    expect(page.get_by_text("Stopped", exact=True).first).to_be_visible()
    log = driving.download(page, "MCAP", tmp_path)
    assert driving.topics_of(log) >= LOGGED
    assert driving.driven_states(log)[-1] == "stopped"
    assert "driving" in driving.driven_states(log)
    witness.assert_nothing_happened()


def _way(first: dict[str, Any], told: list[dict[str, Any]]) -> float:
    """Metres between the first pose and the newest."""
    return math.dist(_place(first), _place(driving.newest(told, "nav/status") or first))


def _place(message: dict[str, Any]) -> tuple[float, float]:
    pose = message["data"]["pose"]
    return pose["x"], pose["y"]


def _stands(told: list[dict[str, Any]]) -> bool:
    status = driving.newest(told, "nav/status")
    return status is not None and abs(status["data"]["v"]) < STANDING

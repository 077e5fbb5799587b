"""Messages of a short run."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from navcore.messages import (
    CameraName,
    CameraView,
    FixQuality,
    GnssFix,
    MissionPlan,
    ModeSwitch,
    NavMode,
    NavStatus,
    PathSegment,
    PoseEstimate,
    RowObservation,
    RunState,
    SegmentKind,
)
from navcore.topics import CAMERA_VIEW, GNSS_FIX, NAV_PLAN, NAV_STATUS, NAV_SWITCH
from navcore.transport.codec import encode
from navcore.transport.pubsub import Received

JPEG = b"\xff\xd8 a picture \xff\xd9"
DATUM = (42.0, -8.0, 100.0)


def status(stamp_ns: int, x: float = 0.0, pose: bool = True) -> NavStatus:
    estimate = PoseEstimate(
        stamp_ns=stamp_ns, x=x, y=0.0, yaw=0.0, v=0.8, omega=0.0, covariance=(0.0,) * 9, source="gnss"
    )
    return NavStatus(
        stamp_ns=stamp_ns, state=RunState.DRIVING, mode=NavMode.GNSS_PATH, mode_reason="", run_id="run1", segment=0,
        segments=1, row_id=None, progress=0.5, remaining=5.0, lateral_error=0.02, heading_error=None, v=0.8,
        omega=0.0, speed_limit=0.8, speed_reason="", pose=estimate if pose else None,
        gnss_quality=FixQuality.RTK_FIXED, gnss_age_s=0.1, row_age_s=None, battery_v=26.0, guard="ARMED",
        guard_reason="", events=(),
    )  # fmt: skip


def view(stamp_ns: int) -> CameraView:
    row = RowObservation(stamp_ns=stamp_ns, camera=CameraName.FRONT, valid=False, reason="no row")
    return CameraView(
        stamp_ns=stamp_ns, camera=CameraName.FRONT, width_px=640, height_px=360, objects=(), points=(), left=None,
        right=None, centre=None, row=row, latency_ms=50.0,
    )  # fmt: skip


def fix(stamp_ns: int) -> GnssFix:
    return GnssFix(
        stamp_ns=stamp_ns, utc_s=1.0, quality=FixQuality.RTK_FIXED, lat_deg=42.1, lon_deg=-8.1, height_m=101.0,
        std_east_m=0.01, std_north_m=0.02, std_up_m=0.03,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Drive:
    """Ten metres to the east, at 20 Hz, with everything on the bus that an export shows."""

    start_ns: int = 5_000_000_000
    statuses: int = 100
    name: str = "North & <south>"

    def received(self) -> list[tuple[int, Received]]:
        segment = PathSegment(kind=SegmentKind.ROAD, points=((0.0, 0.0), (10.0, 0.0)), speeds=(0.8, 0.8))
        plan = MissionPlan(mission_id="m", name=self.name, datum=DATUM, segments=(segment,))
        messages = [(self.start_ns, Received(NAV_PLAN.name, encode(plan), b""))]
        for number in range(self.statuses):
            now_ns = self.start_ns + number * 50_000_000
            messages.append((now_ns, Received(NAV_STATUS.name, encode(status(now_ns, number * 0.1)), b"")))
            if number % 2 == 0:
                messages.append((now_ns, Received(CAMERA_VIEW.name, encode(view(now_ns)), JPEG)))
            if number % 4 == 0:
                messages.append((now_ns, Received(GNSS_FIX.name, encode(fix(now_ns)), b"")))
        messages.append((now_ns, Received(NAV_SWITCH.name, encode(switch(now_ns)), b"")))
        return messages


def switch(stamp_ns: int) -> ModeSwitch:
    return ModeSwitch(
        stamp_ns=stamp_ns, before=NavMode.GNSS_PATH, after=NavMode.ROW, reason="row seen", x=9.9, y=0.0,
        along_segment=9.9, gnss_std=0.02, row_quality=0.9, row_offset=0.01, end_distance=None,
    )  # fmt: skip


@pytest.fixture
def drive() -> Drive:
    return Drive()

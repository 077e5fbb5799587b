"""A run log in columns, for replay in the browser."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import sqrt
from pathlib import Path

from backend.schemas import RunTrack
from navcore.errors import LogError
from navcore.messages import ModeSwitch, NavStatus
from navcore.recording.reader import read_log
from navcore.topics import CAMERA_VIEW, NAV_STATUS, NAV_SWITCH
from navcore.transport.codec import decode

STEP_NS = 95_000_000  # 10 Hz from 20 Hz, with room for jitter
READ = (NAV_STATUS.name, NAV_SWITCH.name, CAMERA_VIEW.name)


def read_track(path: Path) -> RunTrack:
    """All of a log. Raises LogError if it holds no status with a pose."""
    statuses: list[NavStatus] = []
    switches: list[ModeSwitch] = []
    camera_ns: list[int] = []
    for message in read_log(path, READ):
        if message.name == NAV_STATUS.name:
            statuses.append(decode(NavStatus, message.payload))
        elif message.name == NAV_SWITCH.name:
            switches.append(decode(ModeSwitch, message.payload))
        else:
            camera_ns.append(message.stamp_ns)
    if not any(status.pose for status in statuses):
        raise LogError("This run's log holds no driven track.")
    return track(statuses, switches, camera_ns)


def track(statuses: list[NavStatus], switches: list[ModeSwitch], camera_ns: list[int]) -> RunTrack:
    """Columns of every status that has a pose, thinned to 10 Hz; `t_s` counts from the first status."""
    start_ns = statuses[0].stamp_ns
    columns: dict[str, list[object]] = {name: [] for name in COLUMN_NAMES}
    for status in thinned(statuses):
        for name, value in columns_of(status, start_ns).items():
            columns[name].append(value)
    camera_t_s = [(stamp_ns - start_ns) / 1e9 for stamp_ns in camera_ns]
    return RunTrack.model_validate({**columns, "switches": switches, "camera_t_s": camera_t_s})


def thinned(statuses: Iterable[NavStatus]) -> Iterator[NavStatus]:
    """At most 10 a second, but each change of mode and state."""
    last: NavStatus | None = None
    for status in statuses:
        if status.pose is None:
            continue
        changed = last is None or (status.mode, status.state) != (last.mode, last.state)
        if changed or last is None or status.stamp_ns - last.stamp_ns >= STEP_NS:
            last = status
            yield status


def columns_of(status: NavStatus, start_ns: int) -> dict[str, object]:
    """One line of the table."""
    pose = status.pose
    assert pose is not None
    return {
        "t_s": (status.stamp_ns - start_ns) / 1e9,
        "x": pose.x,
        "y": pose.y,
        "yaw": pose.yaw,
        "v": status.v,
        "omega": status.omega,
        "lateral_error": status.lateral_error,
        "heading_error": status.heading_error,
        "position_std": sqrt(max(0.0, pose.covariance[0], pose.covariance[4])) if pose.covariance else None,
        "speed_limit": status.speed_limit,
        "progress": status.progress,
        "mode": status.mode,
        "state": status.state,
        "reason": status.mode_reason,
    }


COLUMN_NAMES = tuple(name for name in RunTrack.model_fields if name not in ("switches", "camera_t_s"))

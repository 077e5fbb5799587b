"""A robot played for the station: real sockets and the real recorder, a mind of three lines."""

from __future__ import annotations

import contextlib
import os
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path

from navcore.chassis.protocol import answer_stop
from navcore.messages import (
    CameraName,
    CameraView,
    FixQuality,
    NavMode,
    NavStatus,
    PoseEstimate,
    Reply,
    Request,
    RequestKind,
    RowObservation,
    RunState,
)
from navcore.recording.recorder import Recorder
from navcore.recording.recorder_process import RecorderProcess
from navcore.topics import CAMERA_VIEW, NAV_PLAN, NAV_STATUS
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher
from navcore.transport.request import Replier
from navcore.transport.supervision import SupervisorReply, SupervisorRequest, SupervisorRequestKind

JPEG = b"\xff\xd8" + bytes(range(256)) * 100 + b"\xff\xd9"
AFTER = {
    RequestKind.START: RunState.DRIVING,
    RequestKind.PAUSE: RunState.PAUSED,
    RequestKind.RESUME: RunState.DRIVING,
    RequestKind.STOP: RunState.STOPPED,
    RequestKind.ACKNOWLEDGE: RunState.IDLE,
}


class PlayedRobot:
    """Navigator, guard's stop socket, recorder and supervisor, each in a thread."""

    def __init__(self, bus_dir: Path) -> None:
        self.endpoints = Endpoints(bus_dir)
        self.endpoints.prepare()
        self.state = RunState.IDLE
        self.run_id: str | None = None
        self.x = 0.0
        self.stop_reason = ""
        self.refusals: tuple[str, ...] = ()
        self.refused: dict[RequestKind, tuple[str, ...]] = {}
        self.camera = False
        self.silent = False
        self.requests: list[Request] = []
        self.stops = 0
        self.site_id: str | None = None
        self.calibrations_loaded = 0
        self._ended = threading.Event()
        loops = (self._navigate, self._guard, self._record, self._supervise, self._look)
        self._threads = [threading.Thread(target=loop, daemon=True) for loop in loops]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        self._ended.set()
        for thread in self._threads:
            thread.join(10.0)

    def kinds(self) -> list[RequestKind]:
        return [request.kind for request in self.requests]

    def status(self) -> NavStatus:
        now_ns = time.monotonic_ns()
        moving = self.state is RunState.DRIVING
        self.x += 0.04 if moving else 0.0
        covariance = (0.01, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0, 0.001)
        return NavStatus(
            stamp_ns=now_ns, state=self.state, mode=NavMode.GNSS_PATH, mode_reason="by GNSS", run_id=self.run_id,
            segment=0, segments=1, row_id=None, progress=0.5, remaining=10.0,
            lateral_error=0.03 if moving else None, heading_error=0.0 if moving else None,
            v=0.8 if moving else 0.0, omega=0.0, speed_limit=0.8, speed_reason="", battery_v=25.0,
            pose=PoseEstimate(stamp_ns=now_ns, x=self.x, y=0.0, yaw=0.0, v=0.8, omega=0.0, covariance=covariance,
                              source="filter"),
            gnss_quality=FixQuality.RTK_FIXED, gnss_age_s=0.1, row_age_s=None, guard="armed", guard_reason="",
            events=(), stop_reason=self.stop_reason,
        )  # fmt: skip

    def _navigate(self) -> None:
        with Publisher(self.endpoints, "navigator") as publisher, Replier(self.endpoints.navigator_requests) as door:
            while not self._ended.is_set():
                question = door.receive(50)
                if question is not None:
                    self._answer(decode(Request, question), publisher, door)
                if not self.silent:
                    publisher.publish(NAV_STATUS.name, self.status())

    def _answer(self, request: Request, publisher: Publisher, door: Replier) -> None:
        self.requests.append(request)
        reasons = self.refusals if request.kind is RequestKind.START else self.refused.get(request.kind, ())
        if reasons:
            door.reply(Reply(request_id=request.request_id, accepted=False, reasons=reasons))
            return
        if request.kind is RequestKind.START:
            self.run_id = request.run_id
            publisher.publish(NAV_PLAN.name, request.plan)
        self.state = AFTER.get(request.kind, self.state)
        self.run_id = None if request.kind is RequestKind.ACKNOWLEDGE else self.run_id
        door.reply(Reply(request_id=request.request_id, accepted=True))

    def _guard(self) -> None:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as guard:
            guard.bind(str(self.endpoints.guard_stop))
            guard.settimeout(0.05)
            while not self._ended.is_set():
                with contextlib.suppress(TimeoutError):
                    datagram, sender = guard.recvfrom(64)
                    self._latch(guard, datagram, sender)
        os.unlink(self.endpoints.guard_stop)

    def _latch(self, guard: socket.socket, datagram: bytes, sender: str) -> None:
        answer = answer_stop(datagram)
        if answer is not None:
            self.stops += 1
            guard.sendto(answer, sender)

    def _look(self) -> None:
        with Publisher(self.endpoints, "row_worker") as publisher:
            while not self._ended.wait(0.1):
                if self.camera:
                    publisher.publish(CAMERA_VIEW.name, view(time.monotonic_ns()), JPEG)

    def _record(self) -> None:
        process = RecorderProcess(self.endpoints, Recorder())
        while not self._ended.is_set():
            process.step()
        process.close()

    def _supervise(self) -> None:
        with Replier(self.endpoints.supervisor_requests) as door:
            while not self._ended.is_set():
                question = door.receive(50)
                if question is not None:
                    door.reply(self._place(decode(SupervisorRequest, question)))

    def _place(self, request: SupervisorRequest) -> SupervisorReply:
        if request.kind is SupervisorRequestKind.LOAD_SITE:
            self.site_id = request.site_id
        self.calibrations_loaded += request.kind is SupervisorRequestKind.LOAD_CALIBRATION
        return SupervisorReply(accepted=True, site_id=self.site_id)


def view(stamp_ns: int) -> CameraView:
    """What a camera says that sees no row."""
    row = RowObservation(stamp_ns=stamp_ns, camera=CameraName.FRONT, valid=False, reason="too dark")
    return CameraView(
        stamp_ns=stamp_ns, camera=CameraName.FRONT, width_px=640, height_px=360, objects=(), points=(), left=None,
        right=None, centre=None, row=row, latency_ms=30.0,
    )  # fmt: skip


def until(condition: Callable[[], bool], within_s: float = 20.0) -> bool:
    """Whether it came true in time."""
    deadline = time.monotonic() + within_s
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.02)
    return True

"""World, guard, recorder and navigator as processes of their own, on real sockets and a real bus."""

from __future__ import annotations

import os
import signal
import socket
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from navcore.maps.mission import RowExit
from navcore.messages import MissionPlan, NavStatus, Reply, Request, RequestKind, RunState, SimTruth
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.recording.reader import read_log
from navcore.recording.requests import RecorderReply, RecorderRequest, RecorderRequestKind
from navcore.runtime.child import Child
from navcore.runtime.processes import PROCESSES, CanSettings, Robot
from navcore.runtime.replay_log import replay_log
from navcore.runtime.simulation import SimulationParams
from navcore.sim.demo_farm import demo_farm
from navcore.topics import NAV_DECISION, NAV_INPUTS, NAV_PLAN, NAV_STATUS, SIM_TRUTH
from navcore.transport.codec import decode, encode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber
from navcore.transport.request import Requester
from navcore.transport.stop_client import StopClient
from navcore.vehicle import PAPER_A

pytestmark = pytest.mark.realtime

DEADLINE_S = 60.0
NAMES = ("world", "guard", "recorder", "navigator")


def free_port(kind: socket.SocketKind) -> int:
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Station:
    """The robot's processes without cameras and web."""

    def __init__(self, directory: Path) -> None:
        site = directory / "site.json"
        site.write_bytes(encode(demo_farm()))
        options = {"port": free_port(socket.SOCK_DGRAM), "hop_limit": 0, "fd": 0}
        self.robot = Robot(
            bus=directory / "bus", site=site, vehicle="paper_a", simulation=SimulationParams(),
            can=CanSettings(interface="udp_multicast", channel="239.74.163.2", options=options),
            gnss=f"tcp://127.0.0.1:{free_port(socket.SOCK_STREAM)}",
        )  # fmt: skip
        self.endpoints = Endpoints(self.robot.bus)
        self.endpoints.prepare()
        self.children = {spec.name: Child(spec, {}) for spec in PROCESSES if spec.name in NAMES}
        for child in self.children.values():
            child.start(self.robot, time.monotonic())
        self.navigator = Requester(self.endpoints.navigator_requests, "navigator")
        self.recorder = Requester(self.endpoints.recorder_requests, "recorder")
        self.ears = Subscriber(self.endpoints, (NAV_STATUS.name, SIM_TRUTH.name))
        self.status: NavStatus | None = None
        self.truth: SimTruth | None = None

    def listen_until(self, condition: Callable[[], bool], what: str) -> None:
        deadline = time.monotonic() + DEADLINE_S
        while not condition():
            assert time.monotonic() < deadline, f"{what} did not happen: {self.status}"
            received = self.ears.receive(200)
            if received is not None and received.name == NAV_STATUS.name:
                self.status = decode(NavStatus, received.payload)
            elif received is not None:
                self.truth = decode(SimTruth, received.payload)

    def listen_for(self, ticks: int) -> None:
        """Until so many more ticks of the navigator's clock have passed."""
        assert self.truth is not None
        until_ns = self.truth.stamp_ns + ticks * 20_000_000
        self.listen_until(lambda: self.truth is not None and self.truth.stamp_ns >= until_ns, "time passing")

    def state(self) -> RunState | None:
        return self.status.state if self.status else None

    def speed(self) -> float:
        assert self.truth is not None
        return self.truth.v

    def guard(self) -> str:
        return self.status.guard if self.status else ""

    def record(self, path: Path) -> None:
        request = RecorderRequest(kind=RecorderRequestKind.START, run_id="run1", path=str(path))
        assert self.recorder.ask(request, RecorderReply, 30_000).accepted

    def finish(self) -> RecorderReply:
        return self.recorder.ask(RecorderRequest(kind=RecorderRequestKind.FINISH), RecorderReply, 30_000)

    def ask(self, kind: RequestKind, plan: MissionPlan | None = None) -> Reply:
        return self.navigator.ask(Request(kind=kind, request_id=kind, run_id="run1", plan=plan), Reply, 30_000)

    def drive(self) -> None:
        self.listen_until(lambda: self.status is not None and self.status.pose is not None, "knowing the pose")
        farm = demo_farm()
        reply = self.ask(
            RequestKind.START, plan_mission(farm, mission_for_row(farm, farm.rows[0].id, RowExit.REVERSE), PAPER_A)
        )
        assert reply.accepted, reply.reasons
        self.listen_until(lambda: self.truth is not None and self.truth.v > 0.3, "driving")

    def wait_for_standstill(self) -> None:
        self.listen_until(lambda: self.truth is not None and abs(self.truth.v) < 0.01, "standstill")

    def kill(self, name: str) -> None:
        pid = self.children[name].status().pid
        assert pid is not None
        os.kill(pid, signal.SIGKILL)

    def restart(self, name: str) -> None:
        child = self.children[name]
        self.listen_until(lambda: not child.status().running, f"the end of the {name}")
        child.end()
        child.start(self.robot, time.monotonic())

    def close(self) -> None:
        for asker in (self.navigator, self.recorder, self.ears):
            asker.close()
        for child in reversed(self.children.values()):
            child.end()


@pytest.fixture
def station() -> Iterator[Station]:
    with tempfile.TemporaryDirectory(prefix="rp") as directory:
        station = Station(Path(directory))
        try:
            yield station
        finally:
            station.close()


def test_a_drive_is_logged_whole_and_its_log_replays_bit_for_bit(station: Station, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    station.record(path)
    station.drive()
    station.listen_for(100)
    assert station.ask(RequestKind.STOP).accepted
    station.wait_for_standstill()
    summary = station.finish().summary
    assert summary is not None
    assert summary.messages[NAV_INPUTS.name] == summary.messages[NAV_DECISION.name] > 100
    assert next(read_log(path, (NAV_PLAN.name,))).payload
    result = replay_log(path)
    assert result.difference is None
    assert result.ticks > 100


def test_a_killed_navigator_stops_the_robot_and_its_successor_stays_idle(station: Station) -> None:
    station.drive()
    station.kill("navigator")
    station.wait_for_standstill()
    station.restart("navigator")
    station.listen_until(lambda: station.state() is RunState.IDLE, "the successor's first word")
    station.listen_for(100)
    assert abs(station.speed()) < 0.01  # m/s
    assert station.guard() == "latched"


def test_a_killed_guard_stops_the_robot_and_its_successor_is_silent(station: Station) -> None:
    station.drive()
    station.kill("guard")
    station.wait_for_standstill()
    station.restart("guard")
    station.listen_until(lambda: station.guard() == "silent", "the successor")
    station.listen_for(100)
    assert abs(station.speed()) < 0.01  # m/s
    assert station.state() is RunState.STOPPED


def test_a_killed_recorder_stops_nobody(station: Station, tmp_path: Path) -> None:
    station.record(tmp_path / "run.mcap")
    station.drive()
    station.kill("recorder")
    station.listen_for(100)
    assert station.state() is RunState.DRIVING
    assert any(read_log(tmp_path / "run.mcap", (NAV_STATUS.name,)))


def test_stop_reaches_the_wheels_past_the_navigator_and_the_mission_is_stopped(station: Station) -> None:
    station.drive()
    with StopClient(station.endpoints) as client:
        client.stop(timeout_s=10.0)
    station.wait_for_standstill()
    station.listen_until(lambda: station.state() is RunState.STOPPED, "the mission's stop")
    assert "Stopped by an operator" in (station.status.guard_reason if station.status else "")


def test_after_a_stop_the_mission_can_be_resumed_by_the_operator(station: Station) -> None:
    station.drive()
    with StopClient(station.endpoints) as client:
        client.stop(timeout_s=10.0)
    station.wait_for_standstill()
    station.listen_until(lambda: station.state() is RunState.STOPPED, "the mission's stop")
    assert station.ask(RequestKind.RESUME).accepted
    station.listen_until(lambda: station.truth is not None and station.truth.v > 0.3, "driving on")

"""Processes are started, watched, started again, and ended."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread

import pytest

from navcore.errors import TransportError
from navcore.maps.site_map import SiteMap
from navcore.runtime.processes import PROCESSES, CanSettings, ProcessSpec, Robot
from navcore.runtime.simulation import SimulationParams
from navcore.runtime.supervisor import Supervisor
from navcore.sim.demo_farm import demo_farm
from navcore.transport.codec import encode
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester
from navcore.transport.supervision import ProcessStatus, SupervisorReply, SupervisorRequest, SupervisorRequestKind
from tests.living_process import ends

DEADLINE_S = 20.0
STATUS = SupervisorRequest(kind=SupervisorRequestKind.STATUS)
LOAD_CALIBRATION = SupervisorRequest(kind=SupervisorRequestKind.LOAD_CALIBRATION)


def sleep(robot: Robot) -> tuple[str, ...]:
    """`timeit` makes a patient process of any statement."""
    return ("-n1", "-r1", "import time; time.sleep(60)")


TABLE = (
    ProcessSpec(name="knowing", module="timeit", arguments=sleep, knows_site=True, knows_calibration=True),
    ProcessSpec(name="other", module="timeit", arguments=sleep),
    ProcessSpec(name="world", module="timeit", arguments=sleep, simulated_only=True),
)


class Stand:
    """A supervisor that watches in a process's main thread, here in a thread of the test."""

    def __init__(
        self, directory: Path, *, simulated: bool = True, calibration: Path | None = Path("calibration")
    ) -> None:
        site = directory / "site.json"
        site.write_bytes(encode(demo_farm()))
        self.robot = Robot(
            bus=directory / "bus", site=site, vehicle="paper_a", can=CanSettings(), gnss="tcp://127.0.0.1:1",
            simulation=SimulationParams() if simulated else None, calibration=calibration,
        )  # fmt: skip
        self._ended = Event()
        self._ready = Event()
        self._thread = Thread(target=self._run)
        self._thread.start()
        assert self._ready.wait(DEADLINE_S)
        self.asker = Requester(Endpoints(self.robot.bus).supervisor_requests, "supervisor")

    def _run(self) -> None:
        supervisor = Supervisor(self.robot, "farm1", {}, TABLE)
        supervisor.start()
        self._ready.set()
        while not self._ended.is_set():
            supervisor.watch()
        supervisor.close()

    def status(self) -> SupervisorReply:
        return self.asker.ask(STATUS, SupervisorReply, 20_000)

    def process(self, name: str) -> ProcessStatus:
        return next(process for process in self.status().processes if process.name == name)

    def wait_for(self, condition: Callable[[], bool]) -> None:
        deadline = time.monotonic() + DEADLINE_S
        while not condition():
            assert time.monotonic() < deadline
            time.sleep(0.02)

    def load(self, path: str | None, site_id: str = "farm2") -> SupervisorReply:
        request = SupervisorRequest(kind=SupervisorRequestKind.LOAD_SITE, site_path=path, site_id=site_id)
        return self.asker.ask(request, SupervisorReply, 30_000)

    def close(self) -> None:
        self.asker.close()
        self._ended.set()
        self._thread.join()


@pytest.fixture
def directory() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="rp") as name:
        yield Path(name)


@pytest.fixture
def stand(directory: Path) -> Iterator[Stand]:
    stand = Stand(directory)
    yield stand
    stand.close()


def test_all_processes_of_the_table_run(stand: Stand) -> None:
    reply = stand.status()
    assert [(p.name, p.running, p.restarts) for p in reply.processes] == [
        ("knowing", True, 0),
        ("other", True, 0),
        ("world", True, 0),
    ]
    assert (reply.site_id, reply.simulated) == ("farm1", True)


def test_a_real_robot_has_no_simulated_world(directory: Path) -> None:
    stand = Stand(directory, simulated=False)
    assert [process.name for process in stand.status().processes] == ["knowing", "other"]
    stand.close()


def test_a_killed_process_is_started_again(stand: Stand) -> None:
    before = stand.process("other").pid
    assert before is not None
    os.kill(before, signal.SIGKILL)
    stand.wait_for(lambda: stand.process("other").restarts == 1 and stand.process("other").running)
    assert stand.process("other").pid != before
    assert stand.process("knowing").restarts == 0


def test_another_farm_restarts_only_those_who_know_the_farm(stand: Stand, directory: Path) -> None:
    before = {process.name: process.pid for process in stand.status().processes}
    path = directory / "farm2.json"
    path.write_bytes(encode(demo_farm()))
    reply = stand.load(str(path))
    assert (reply.accepted, reply.site_id, reply.site_path) == (True, "farm2", str(path))
    after = {process.name: process.pid for process in reply.processes}
    assert after["knowing"] != before["knowing"]
    assert after["other"] == before["other"]


@pytest.mark.parametrize("content", [b"", b"{}", b"nonsense"])
def test_a_farm_that_cannot_be_read_is_refused_and_nothing_is_restarted(
    stand: Stand, directory: Path, content: bytes
) -> None:
    before = stand.process("knowing").pid
    path = directory / "broken.json"
    path.write_bytes(content)
    reply = stand.load(str(path))
    assert not reply.accepted
    assert "broken.json" in reply.reason
    assert (reply.site_id, stand.process("knowing").pid) == ("farm1", before)


def test_a_farm_without_a_warehouse_has_no_place_for_the_robot(stand: Stand, directory: Path) -> None:
    farm: SiteMap = replace(demo_farm(), warehouse=None)
    (directory / "bare.json").write_bytes(encode(farm))
    assert "warehouse" in stand.load(str(directory / "bare.json")).reason
    assert "Name the file" in stand.load(None).reason


def test_another_calibration_restarts_only_the_eyes_that_know_it(stand: Stand) -> None:
    before = {process.name: process.pid for process in stand.status().processes}
    assert stand.asker.ask(LOAD_CALIBRATION, SupervisorReply, 30_000).accepted
    after = {process.name: process.pid for process in stand.status().processes}
    assert after["knowing"] not in (before["knowing"], None)
    assert (after["other"], after["world"]) == (before["other"], before["world"])


def test_a_robot_without_stored_calibrations_keeps_its_eyes_open(directory: Path) -> None:
    stand = Stand(directory, calibration=None)
    before = stand.process("knowing").pid
    assert stand.asker.ask(LOAD_CALIBRATION, SupervisorReply, 30_000).accepted
    assert stand.process("knowing").pid == before
    stand.close()


def test_a_second_supervisor_on_the_same_sockets_is_refused(stand: Stand) -> None:
    with pytest.raises(TransportError, match="already running"):
        Supervisor(stand.robot, None, {}, TABLE)


def test_processes_end_with_their_supervisor_even_when_it_is_killed(directory: Path) -> None:
    (directory / "site.json").write_bytes(encode(demo_farm()))
    supervisor = subprocess.Popen(
        [sys.executable, "-c", SUPERVISOR, str(directory)], stdout=subprocess.PIPE, text=True
    )
    assert supervisor.stdout is not None
    with supervisor.stdout as told:
        child = int(told.readline())
    supervisor.kill()  # before its child has asked to be told of that
    supervisor.wait()
    assert ends(child)


SUPERVISOR = """
import sys
from pathlib import Path
from navcore.runtime.processes import CanSettings, ProcessSpec, Robot
from navcore.runtime.supervisor import Supervisor
directory = Path(sys.argv[1])
sleep = lambda robot: ("-n1", "-r1", "import time; time.sleep(600)")
table = (ProcessSpec(name="other", module="timeit", arguments=sleep),)
robot = Robot(
    bus=directory / "bus", site=directory / "site.json", vehicle="paper_a", can=CanSettings(), gnss="tcp://h:1"
)
supervisor = Supervisor(robot, None, {}, table)
supervisor.start()
print(supervisor._children[0].status().pid, flush=True)
while True:
    supervisor.watch()
"""


def test_the_table_starts_the_world_before_the_guard_and_the_station_last() -> None:
    names = [spec.name for spec in PROCESSES]
    assert names == ["world", "guard", "recorder", "navigator", "row_worker", "scan_worker", "station"]
    knowing = {spec.name for spec in PROCESSES if spec.knows_site}
    assert knowing == {"world", "navigator", "row_worker", "scan_worker"}


@pytest.mark.parametrize("lidar3d", [True, False])
def test_only_a_robot_with_a_3d_lidar_has_a_scan_worker(tmp_path: Path, lidar3d: bool) -> None:
    simulation = SimulationParams(lidar3d=lidar3d)
    robot = Robot(
        bus=tmp_path, site=tmp_path / "farm.json", vehicle="paper_a", can=CanSettings(), gnss="tcp://127.0.0.1:1",
        simulation=simulation,
    )  # fmt: skip
    spec = next(spec for spec in PROCESSES if spec.name == "scan_worker")
    assert spec.wanted(robot) is lidar3d

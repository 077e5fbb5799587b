"""The recorder as a process of its own, however it ends."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from navcore.messages import SimTruth
from navcore.recording.reader import read_log, read_typed
from navcore.recording.requests import RecorderReply, RecorderRequest, RecorderRequestKind
from navcore.topics import SIM_TRUTH
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher
from navcore.transport.request import Requester

DEADLINE_S = 20.0


class RecorderRig:
    """A recorder process that writes a run, with the bus it listens to."""

    def __init__(self, folder: Path) -> None:
        self.endpoints = Endpoints(folder)
        self.endpoints.prepare()
        self.path = folder / "run.mcap"
        command = [sys.executable, "-m", "navcore.recording.recorder_process", "--bus", str(folder)]
        self.process = subprocess.Popen(command)

    def record(self) -> None:
        start = RecorderRequest(kind=RecorderRequestKind.START, run_id="run1", path=str(self.path), metadata={})
        with Requester(self.endpoints.recorder_requests, "recorder") as asker:
            assert asker.ask(start, RecorderReply, 20_000).accepted

    def publish_until_on_disk(self) -> None:
        deadline = time.monotonic() + DEADLINE_S
        number = 0
        with Publisher(self.endpoints, "world") as publisher:
            while time.monotonic() < deadline:
                publisher.publish(SIM_TRUTH.name, truth(number))
                number += 1
                time.sleep(0.005)
                if number % 50 == 0 and any(read_log(self.path, (SIM_TRUTH.name,))):
                    return
        raise AssertionError("nothing reached the disk")

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


def truth(stamp_ns: int) -> SimTruth:
    return SimTruth(stamp_ns=stamp_ns, x=0.0, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0)


@pytest.fixture
def rig() -> Iterator[RecorderRig]:
    with tempfile.TemporaryDirectory(prefix="rp") as folder:
        rig = RecorderRig(Path(folder))
        yield rig
        rig.close()


def test_a_killed_recorder_process_leaves_a_readable_log(rig: RecorderRig) -> None:
    rig.record()
    rig.publish_until_on_disk()
    rig.process.kill()
    rig.process.wait()
    stamps = [message.stamp_ns for message in read_typed(rig.path, SIM_TRUTH.name, SimTruth)]
    assert stamps == list(range(stamps[0], stamps[0] + len(stamps)))


def test_a_recorder_process_that_is_asked_to_end_finishes_its_log(rig: RecorderRig) -> None:
    rig.record()
    rig.process.terminate()
    assert rig.process.wait(DEADLINE_S) == 0
    assert rig.path.read_bytes().endswith(b"\x89MCAP0\r\n")

"""The reader thread: an emulated C16 behind real UDP sockets, one that falls silent, and senders that are none."""

from __future__ import annotations

import contextlib
import itertools
import socket
import threading
import time
from collections.abc import Callable, Iterator

import pytest

from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.lidar3d.models import ModelName
from navcore.drivers.lidar3d.reader import Lidar3dReader
from navcore.drivers.lidar3d.turns import Turn
from navcore.errors import ConfigError
from tests.navcore.drivers.lidar3d_scenes import datagrams, off_walls

HOME = "127.0.0.1"
SECOND = tuple(datagrams(ModelName.C16, seconds=1.0))


def wait_for(condition: Callable[[], bool], seconds: float = 30.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "waited in vain"
        time.sleep(0.005)


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind((HOME, 0))
        port: int = probe.getsockname()[1]
        return port


@pytest.fixture
def params() -> Lidar3dParams:
    return Lidar3dParams(
        model="c16", listen=HOME, port=free_port(), device_port=free_port(), silent_s=0.4, reconnect_s=0.01
    )  # fmt: skip


class Sender:
    """Sends datagrams over and over, one each 1.2 ms or as fast as may be, until it is stopped."""

    def __init__(self, data: tuple[bytes, ...], params: Lidar3dParams, address: str = HOME) -> None:
        self._data, self._params = data, params
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind((address, 0))
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        began = time.monotonic()
        for n, data in enumerate(itertools.cycle(self._data)):
            if self._stopping.wait(max(0.0, began + n * 0.0012 - time.monotonic())):
                return
            port = self._params.port if data.startswith(b"\xff\xee") else self._params.device_port
            with contextlib.suppress(ConnectionRefusedError):
                self._socket.sendto(data, (HOME, port))

    def stop(self) -> None:
        self._stopping.set()
        self._thread.join()
        self._socket.close()


@contextlib.contextmanager
def sending(data: tuple[bytes, ...], params: Lidar3dParams, address: str = HOME) -> Iterator[None]:
    sender = Sender(data, params, address)
    try:
        yield
    finally:
        sender.stop()


@contextlib.contextmanager
def reading(params: Lidar3dParams, turns: list[Turn]) -> Iterator[Lidar3dReader]:
    reader = Lidar3dReader(params, turns.append, time.monotonic_ns)
    reader.start()
    try:
        yield reader
    finally:
        reader.stop()


def test_turns_of_a_c16_come_over_udp_with_what_it_tells_of_itself(params: Lidar3dParams) -> None:
    turns: list[Turn] = []
    with reading(params, turns) as reader, sending(SECOND, params):
        wait_for(lambda: len(turns) >= 4 and reader.stream.device is not None)
        assert reader.problem == ""
        assert reader.stream.device is not None
        assert reader.stream.device.rpm == 600
    assert all(off_walls(turn.cloud).max() < 0.002 for turn in turns)  # m
    assert all(turn.stamp_ns < time.monotonic_ns() for turn in turns)


def test_a_lidar_that_is_switched_off_is_told_and_one_that_comes_back_is_read_again(params: Lidar3dParams) -> None:
    turns: list[Turn] = []
    with reading(params, turns) as reader:
        with sending(SECOND, params):
            wait_for(lambda: len(turns) >= 1)
        wait_for(lambda: "nothing comes from the LiDAR on port" in reader.problem)
        assert "is it switched on, and set to send to this computer's address?" in reader.problem
        seen = len(turns)
        with sending(SECOND, params):
            wait_for(lambda: len(turns) > seen and reader.problem == "")
        assert reader.connections >= 2


def test_another_senders_packets_are_passed_over_and_named(params: Lidar3dParams) -> None:
    turns: list[Turn] = []
    only = Lidar3dParams(
        model="c16", listen=HOME, port=params.port, device_port=params.device_port, sender="127.0.0.2", silent_s=0.3, reconnect_s=0.01
    )  # fmt: skip
    with reading(only, turns) as reader:
        with sending(SECOND, only, "127.0.0.3"):
            wait_for(lambda: reader.problem == "packets come from 127.0.0.3, but the LiDAR is set to be at 127.0.0.2")
        assert not turns
        with sending(SECOND, only, "127.0.0.2"):
            wait_for(lambda: len(turns) >= 1)


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (tuple(datagrams(ModelName.C16_FINE)), "The LiDAR's own angles are those of a Leishen C16 (1.33 deg)"),
        (tuple(datagrams(ModelName.VLP16)), "The packets come from a Velodyne VLP-16"),
        ((b"$GPGGA",), "what comes on port {port} is not from a LiDAR that is known here"),
        ((SECOND[1][:100] * 12 + SECOND[1][1200:],), "the LiDAR's head does not turn"),
        (SECOND[1::2], "the LiDAR sends packets, but no whole turn comes of them"),
    ],
)
def test_what_is_no_sound_lidar_is_named(data: tuple[bytes, ...], problem: str, params: Lidar3dParams) -> None:
    turns: list[Turn] = []
    both = Lidar3dParams(
        model="c16", listen=HOME, port=params.port, device_port=params.port, silent_s=0.4, reconnect_s=0.01
    )  # fmt: skip
    with reading(both, turns) as reader, sending(data, both):
        wait_for(lambda: reader.problem.startswith(problem.format(port=params.port)))
    assert not turns


def test_a_port_that_another_program_holds_is_told_and_waited_for(params: Lidar3dParams) -> None:
    turns: list[Turn] = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind((HOME, params.port))
        with reading(params, turns) as reader:
            wait_for(lambda: "cannot be opened" in reader.problem)
            assert f"UDP port {params.port} at {HOME}" in reader.problem
            assert "does another program use it?" in reader.problem
            other.close()
            with sending(SECOND, params):
                wait_for(lambda: len(turns) >= 1)


def test_a_robot_without_a_3d_lidar_has_no_reader() -> None:
    with pytest.raises(ConfigError, match=r"No 3D LiDAR is set\. Name its model: vlp16, c16, c16-fine"):
        Lidar3dReader(Lidar3dParams(), lambda _: None, time.monotonic_ns)

"""8: the guard as it runs, on a bus that fails. The chassis model behind the bus is the oracle."""

from __future__ import annotations

import errno
import os
import socket
import tempfile
import time
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path

import can
import pytest

from navcore.chassis.can_bus import BUS_OFF, OneBus
from navcore.chassis.guard import Guard
from navcore.chassis.guard_process import GuardProcess
from navcore.chassis.protocol import GuardRequest, GuardState, MotionCommand, encode_motion, encode_request
from navcore.chassis.scout_can import Frame, decode_motion_command
from navcore.sim.scout_ecu import ScoutEcu
from navcore.sim.vehicle_dynamics import WheelState
from navcore.transport.endpoints import Endpoints

pytestmark = pytest.mark.realtime

STOPPED = (0.0, 0.0)
PERIOD_NS = 20_000_000
DEADLINE_S = 30.0
Break = Callable[["BrittleBus"], None]


class BrittleBus:
    """python-can's view of a chassis model, as long as nothing is broken."""

    def __init__(self) -> None:
        self.ecu = ScoutEcu()
        self.opened = self.told = 0
        self.speeds: list[tuple[float, float]] = []
        self.fails_to_open: OSError | None = None
        self.fails_to_send: Exception | None = None
        self.fails_to_receive: Exception | None = None
        self.waiting: deque[can.Message] = deque()

    def open(self, **_: object) -> BrittleBus:
        """Stands in for `can.Bus`."""
        if self.fails_to_open:
            raise self.fails_to_open
        self.opened += 1
        return self

    def send(self, message: can.Message, timeout: float) -> None:
        if self.fails_to_send:
            raise self.fails_to_send
        frame = Frame(message.arbitration_id, bytes(message.data))
        self.ecu.receive(frame, time.monotonic_ns())
        if (speeds := decode_motion_command(frame)) is not None:
            self.speeds.append(speeds)

    def recv(self, timeout: float) -> can.Message | None:
        if self.fails_to_receive:
            raise self.fails_to_receive
        now_ns = time.monotonic_ns()
        still = WheelState(stamp_ns=now_ns, left=0.0, right=0.0, left_m=0.0, right_m=0.0, v=0.0, omega=0.0)
        for frame in self.ecu.feedback(now_ns, still):
            self.waiting.append(can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=False))
        self.told += len(self.waiting)
        return self.waiting.popleft() if self.waiting else None

    def fileno(self) -> None:
        """Nothing to wait for."""

    def shutdown(self) -> None:
        self.waiting.clear()

    def target(self) -> tuple[float, float]:
        return self.ecu.target(time.monotonic_ns())


class Stand:
    """The guard's loop in this thread; between its turns a navigator that wants to drive on, whatever happens."""

    def __init__(self, directory: Path, bus: BrittleBus) -> None:
        endpoints = Endpoints(directory)
        endpoints.prepare()
        self.bus, self.guard = bus, Guard()
        sockets = (endpoints.guard_command, endpoints.guard_stop, endpoints.chassis_state)
        self.process = GuardProcess(self.guard, OneBus("brittle", str(directory), {}), *sockets)
        self._outlet = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._outlet.connect(str(endpoints.guard_command))
        self._decided_ns = 0

    def run(self, story: Iterator[Callable[[], bool]]) -> None:
        """The guard runs while the story, which yields what it waits for next, goes on. At the end comes a stop."""
        ends_s = time.monotonic() + DEADLINE_S
        awaited: Callable[[], bool] | None = next(story)

        def finished() -> bool:
            nonlocal awaited
            assert time.monotonic() < ends_s, self.guard.reason
            self._decide(time.monotonic_ns())
            if awaited is not None and awaited():
                awaited = next(story, None)
            return awaited is None

        self.process.run(finished)

    def _decide(self, now_ns: int) -> None:
        if now_ns - self._decided_ns < PERIOD_NS:
            return
        self._decided_ns = now_ns
        self._outlet.send(encode_request(GuardRequest.ARM, now_ns))
        if self.guard.state is GuardState.ARMED:
            deadline_ns = now_ns + 10 * PERIOD_NS
            motion = MotionCommand(v=0.5, omega=0.0, seq=now_ns, stamp_ns=now_ns, deadline_ns=deadline_ns)
            self._outlet.send(encode_motion(motion))

    def close(self) -> None:
        self._outlet.close()
        self.process.close()


@pytest.fixture
def bus(monkeypatch: pytest.MonkeyPatch) -> BrittleBus:
    bus = BrittleBus()
    monkeypatch.setattr(can, "Bus", bus.open)
    return bus


@pytest.fixture
def stand(bus: BrittleBus) -> Iterator[Stand]:
    with tempfile.TemporaryDirectory(prefix="rp") as directory:
        stand = Stand(Path(directory), bus)
        yield stand
        stand.close()


def failing(number: int) -> OSError:
    return OSError(number, os.strerror(number))


def cannot_send(number: int) -> Break:
    return lambda bus: setattr(bus, "fails_to_send", failing(number))


def goes_bus_off(bus: BrittleBus) -> None:
    bus.waiting.appendleft(can.Message(arbitration_id=BUS_OFF, is_error_frame=True, data=b"\0" * 8))


FAULTS: dict[str, Break] = {
    "interface down": cannot_send(errno.ENETDOWN),
    "queue full": cannot_send(errno.ENOBUFS),
    "cable out": lambda bus: setattr(bus, "fails_to_receive", failing(errno.ENETDOWN)),
    "bus off": goes_bus_off,
    "driver error": lambda bus: setattr(bus, "fails_to_send", can.CanOperationError("transmit failed")),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_8_a_bus_that_fails_latches_and_its_return_moves_nothing(stand: Stand, bus: BrittleBus, fault: str) -> None:
    def story() -> Iterator[Callable[[], bool]]:
        yield lambda: bus.target()[0] > 0.3
        FAULTS[fault](bus)
        before = len(bus.speeds)
        yield lambda: stand.guard.state is GuardState.LATCHED
        assert stand.guard.reason.startswith("The CAN bus failed: ")
        bus.fails_to_send = bus.fails_to_receive = None
        told = bus.told
        yield lambda: bus.opened == 2 and bus.told > told + 100 and bus.target() == STOPPED
        assert stand.guard.state is GuardState.LATCHED
        assert set(bus.speeds[before:]) == {STOPPED}

    stand.run(story())


def test_8_a_bus_that_is_not_there_is_told_and_its_coming_moves_nothing(stand: Stand, bus: BrittleBus) -> None:
    def story() -> Iterator[Callable[[], bool]]:
        bus.fails_to_open = failing(errno.ENODEV)
        yield lambda: "No such device" in stand.guard.reason
        bus.fails_to_open = None
        yield lambda: bus.opened == 1 and bus.told > 100
        assert bus.speeds == []
        assert stand.guard.state is GuardState.LATCHED

    stand.run(story())

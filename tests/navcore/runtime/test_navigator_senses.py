"""What a tick consumes is not newer than the tick, however late it was read."""

from __future__ import annotations

import socket
import time
from dataclasses import replace

import pytest

from navcore.chassis.protocol import ChassisState, encode_state
from navcore.runtime.navigator_process import Senses
from navcore.transport.endpoints import Endpoints
from tests.navcore.chassis.test_protocol import known_state


def test_a_chassis_that_reports_while_the_tick_gathers_is_not_from_the_future(
    endpoints: Endpoints, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a busy machine milliseconds pass between a tick's begin and its reading."""
    senses = Senses(endpoints, "tcp://127.0.0.1:9")
    receive = senses.guard.receive

    def reports_late() -> tuple[ChassisState, ...]:
        now_ns = time.monotonic_ns()
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as guard:
            state = replace(known_state(), stamp_ns=now_ns, system_stamp_ns=now_ns)
            guard.sendto(encode_state(state), str(endpoints.chassis_state))
        return receive()

    monkeypatch.setattr(senses.guard, "receive", reports_late)
    inputs = senses.gather()
    senses.close()
    assert len(inputs.chassis) == 1
    assert 0 <= inputs.now_ns - inputs.chassis[0].stamp_ns < 1_000_000_000  # ns

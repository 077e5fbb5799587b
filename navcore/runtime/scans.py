"""Where the row worker's scans come from: a real 2D LiDAR or the simulated one."""

from __future__ import annotations

import sys
import time
from typing import Protocol

from navcore.drivers.rplidar.lidar_params import LidarParams
from navcore.drivers.rplidar.reader import RplidarReader
from navcore.drivers.rplidar.revolutions import Revolution
from navcore.geometry.lidar_mount import LidarMount
from navcore.messages import LidarScan
from navcore.runtime.device_address import DeviceAddress
from navcore.runtime.latest import Inbox
from navcore.topics import SIM_SCAN
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber

MOST_SCANS = 8


class Scans(Protocol):
    """The robot's 2D LiDAR."""

    @property
    def mount(self) -> LidarMount:
        """Where it sits."""

    def take(self) -> tuple[LidarScan, ...]:
        """Scans since the last call, oldest first."""

    def close(self) -> None:
        """Let go of it."""


class RealScans:
    """A LiDAR at an address; its problems are told once each."""

    def __init__(self, params: LidarParams) -> None:
        self.mount = params.mount
        self._turns: Inbox[Revolution] = Inbox(MOST_SCANS)
        self._reader = RplidarReader(
            DeviceAddress(params.address).open, self._turns.put, time.monotonic_ns, params.reader
        )  # fmt: skip
        self._told = self._reader.problem
        self._reader.start()

    def take(self) -> tuple[LidarScan, ...]:
        """See `Scans`."""
        if (problem := self._reader.problem) != self._told:
            self._told = problem
            print(f"LiDAR: {problem or 'it turns'}", file=sys.stderr, flush=True)
        return tuple(turn.scan() for turn in self._turns.take())

    def close(self) -> None:
        """See `Scans`."""
        self._reader.stop()


class SimulatedScans:
    """Those of the simulated world."""

    def __init__(self, endpoints: Endpoints, mount: LidarMount) -> None:
        self.mount = mount
        self._bus = Subscriber(endpoints, (SIM_SCAN.name,), queue_length=MOST_SCANS)

    def take(self) -> tuple[LidarScan, ...]:
        """See `Scans`."""
        scans = []
        while (received := self._bus.receive(0)) is not None:
            scans.append(decode(LidarScan, received.payload))
        return tuple(scans)

    def close(self) -> None:
        """See `Scans`."""
        self._bus.close()

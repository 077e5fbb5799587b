"""Where the scan worker's clouds come from: a real 3D LiDAR or the simulated one."""

from __future__ import annotations

import sys
import time
from typing import NamedTuple, Protocol

from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.lidar3d.reader import Lidar3dReader
from navcore.drivers.lidar3d.turns import Turn
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.runtime.latest import Inbox
from navcore.runtime.simulated_lidar3d import SimulatedLidar3d

# Of a worker that was busy only the newest clouds matter.
MOST_CLOUDS = 2


class StampedCloud(NamedTuple):
    """A turn of the head. `stamp_ns`: when its last point was taken."""

    stamp_ns: int
    cloud: PointCloud


class Clouds(Protocol):
    """The robot's 3D LiDAR."""

    @property
    def T_base_lidar(self) -> SE3:
        """Where it sits."""

    def take(self) -> tuple[StampedCloud, ...]:
        """Turns since the last call, oldest first."""

    def close(self) -> None:
        """Let go of it."""


class RealClouds:
    """A LiDAR on the network; its problems are told once each."""

    def __init__(self, params: Lidar3dParams) -> None:
        self.T_base_lidar = params.T_base_lidar()
        self._turns: Inbox[Turn] = Inbox(MOST_CLOUDS)
        self._reader = Lidar3dReader(params, self._turns.put, time.monotonic_ns)
        self._told = self._reader.problem
        self._reader.start()

    def take(self) -> tuple[StampedCloud, ...]:
        """See `Clouds`."""
        if (problem := self._reader.problem) != self._told:
            self._told = problem
            print(f"3D LiDAR: {problem or 'it turns'}", file=sys.stderr, flush=True)
        return tuple(StampedCloud(turn.stamp_ns, turn.cloud) for turn in self._turns.take() if turn.whole)

    def close(self) -> None:
        """See `Clouds`."""
        self._reader.stop()


class SimulatedClouds:
    """Cast here, from the world's truth, so that no cloud crosses a process on its way to the map."""

    def __init__(self, lidar: SimulatedLidar3d) -> None:
        self._lidar = lidar
        self.T_base_lidar = lidar.mount.T_base_lidar()

    def take(self) -> tuple[StampedCloud, ...]:
        """See `Clouds`."""
        turn = self._lidar.take()
        return () if turn is None else (StampedCloud(turn.stamp_ns, turn.cloud),)

    def close(self) -> None:
        """See `Clouds`."""
        self._lidar.close()

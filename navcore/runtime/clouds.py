"""Where the scan worker's clouds come from: a real 3D LiDAR or the simulated one."""

from __future__ import annotations

import sys
import time
from collections import deque
from typing import NamedTuple, Protocol

from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.lidar3d.reader import Lidar3dReader
from navcore.drivers.lidar3d.turns import Turn
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.messages import SimTruth
from navcore.runtime.latest import Inbox
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.terrain import Terrain
from navcore.sim.trellis.trellised import Trellised
from navcore.topics import SIM_TRUTH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber

NS = 1e-9
# Of a worker that was busy only the newest clouds matter.
MOST_CLOUDS = 2
_KEPT_TRUTHS = 30


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


class SimulatedHead:
    """The simulated LiDAR's head, carried by the true robot."""

    def __init__(self, trellis: Trellised, terrain: Terrain, mount: LidarMount, seed: int) -> None:
        self.T_base_lidar = SE3.from_rpy((mount.x, mount.y, mount.z), mount.roll, mount.pitch, mount.yaw)
        self._lidar = Lidar3d(trellis.scene, mount, C16, seed)
        self._terrain = terrain
        self._turn_ns = round(C16.turn_s / NS)
        self._truths: deque[SimTruth] = deque(maxlen=_KEPT_TRUTHS)
        self._due_ns = 0

    def follow(self, truth: SimTruth) -> None:
        """Where the robot truly is now."""
        self._truths.append(truth)

    def turn(self) -> StampedCloud | None:
        """The turn that ends now, if one is due and the robot's way during it is known."""
        if not self._truths or self._truths[-1].stamp_ns < self._due_ns:
            return None
        stamp_ns = self._truths[-1].stamp_ns
        self._due_ns = max(self._due_ns + self._turn_ns, stamp_ns + self._turn_ns // 2)
        if self._truths[0].stamp_ns > stamp_ns - self._turn_ns:
            return None
        stamps_ns = [truth.stamp_ns for truth in self._truths]
        turn = self._lidar.turn(stamp_ns, stamps_ns, [pose_of(truth, self._terrain) for truth in self._truths])
        return StampedCloud(stamp_ns, turn.cloud)


class SimulatedClouds:
    """Cast here, from the world's truth, so that no cloud crosses a process on its way to the map."""

    def __init__(self, endpoints: Endpoints, head: SimulatedHead) -> None:
        self.T_base_lidar = head.T_base_lidar
        self._head = head
        self._bus = Subscriber(endpoints, (SIM_TRUTH.name,), queue_length=_KEPT_TRUTHS)

    def take(self) -> tuple[StampedCloud, ...]:
        """See `Clouds`."""
        while (received := self._bus.receive(0)) is not None:
            self._head.follow(decode(SimTruth, received.payload))
        turn = self._head.turn()
        return () if turn is None else (turn,)

    def close(self) -> None:
        """See `Clouds`."""
        self._bus.close()


def pose_of(truth: SimTruth, terrain: Terrain) -> SE3:
    """`T_map_base` on the ground, leaning with the land and as it leans against that."""
    roll, pitch = terrain.land_tilt(truth.yaw)
    z = terrain.height(truth.x, truth.y)
    return SE3.from_rpy((truth.x, truth.y, z), truth.roll + roll, truth.pitch + pitch, truth.yaw)

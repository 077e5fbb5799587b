"""The turns of a 3D LiDAR on the simulated robot, from the truths that the world tells of it."""

from __future__ import annotations

import math
from collections import deque

from navcore.errors import ContractError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.messages import SimTruth
from navcore.sim.body_pose import body_pose
from navcore.sim.lidar3d import WORKING_3D, Lidar3d, Lidar3dFaults, Lidar3dParams, SimTurn
from navcore.sim.rays.land_scene import LandScene
from navcore.sim.terrain import Terrain
from navcore.vehicle import VehicleParams

_NS = 1_000_000_000


class Lidar3dFeed:
    """Turn after turn from the first truth on. Same arguments and same truths: the same turns, bit for bit.

    Attributes:
        faults: what is broken of turns that are not cast yet.
    """

    def __init__(
        self, scene: LandScene, terrain: Terrain, vehicle: VehicleParams, mount: LidarMount, params: Lidar3dParams,
        seed: int,
    ) -> None:  # fmt: skip
        self._lidar, self._terrain, self._vehicle = Lidar3d(scene, mount, params, seed), terrain, vehicle
        self._turn_ns = round(params.turn_s * _NS)
        self._poses: deque[tuple[int, SE3]] = deque()
        self._ends_ns = 0
        self.faults: Lidar3dFaults = WORKING_3D

    def add(self, truth: SimTruth) -> None:
        """The robot's next true pose; at least 20 a second, straight between them.

        Raises NotFiniteError for a pose that is no number, ContractError when time runs backwards.
        """
        if not math.isfinite(truth.x + truth.y + truth.yaw + truth.roll + truth.pitch):
            raise NotFiniteError("The robot's true pose must be finite numbers.")
        if self._poses and truth.stamp_ns < self._poses[-1][0]:
            raise ContractError("The LiDAR cannot turn backwards in time.")
        if not self._poses:
            self._ends_ns = truth.stamp_ns + self._turn_ns
        elif truth.stamp_ns == self._poses[-1][0]:
            return
        self._poses.append((truth.stamp_ns, body_pose(truth, self._terrain, self._vehicle)))

    def turn(self) -> SimTurn | None:
        """The oldest turn that is over, None while there is none."""
        if not self._poses or self._ends_ns > self._poses[-1][0]:
            return None
        end_ns = self._ends_ns
        self._forget(end_ns - self._turn_ns)
        stamps, poses = zip(*self._poses, strict=True)
        turn = self._lidar.turn(end_ns, stamps, poses, self.faults)
        self._ends_ns += self._turn_ns
        return turn

    def skip_to_newest(self) -> None:
        """Leave out all turns that are over but the last one: for who came too late to see them."""
        if self._poses and (late := self._poses[-1][0] - self._ends_ns) > 0:
            self._ends_ns += late // self._turn_ns * self._turn_ns

    def _forget(self, before_ns: int) -> None:
        """Poses that the turn beginning at `before_ns` does not need."""
        while len(self._poses) > 2 and self._poses[1][0] <= before_ns:
            self._poses.popleft()

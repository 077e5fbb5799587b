"""Every day, in every row: does the camera still look where the LiDAR says that its trunks stand?

See `MountCheck` for the test. Pictures that follow each other show one trunk with the same sway, so each trunk is
asked once, where it stands near enough to be told and far enough ahead to be in the middle of the picture.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.mount_check import MountCheck, MountCheckParams, TrunkPair
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import MountAgreement, ScannedPlant

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class MountWatchParams:
    """Which trunks are asked, and how well each tells. Ours; set on tuning farms.

    Attributes:
        check: the test.
        nearest, furthest: distance from the camera between which a trunk is asked, m.
        sure: only plants that are as sure as that.
        box_px: 1-sigma of a box's middle, pixels at 640 px image width; sway: of a trunk about its middle, m.
        place_std: 1-sigma of a scanned trunk, m.
        again_s: a number that was not seen for so long is another trunk's.
    """

    check: MountCheckParams = field(default_factory=MountCheckParams)
    nearest: float = 2.0
    furthest: float = 4.0
    sure: float = 0.8
    box_px: float = 1.5
    sway: float = 0.03
    place_std: float = 0.012
    again_s: float = 30.0


class MountWatch:
    """Of one camera beside the LiDAR. It remembers for as long as it lives: a mount does not move back."""

    def __init__(self, camera: PinholeCamera, params: MountWatchParams = MountWatchParams()) -> None:
        """`camera` is mounted in its driving frame."""
        self._camera, self._params = camera, params
        self._check = MountCheck(params.check)
        self._asked: dict[int, int] = {}

    def see(
        self, stamp_ns: int, numbers: Iterable[int], boxed: Iterable[ScannedPlant], bearings: Floats
    ) -> MountAgreement | None:
        """What is known after a picture that shows trunks anew; None where it shows none.

        `numbers` are those of all scanned plants, `boxed` the plants that are objects of the picture, which are seen
        at `bearings` (N,) from the camera, rad to the left.
        """
        self._seen_again(numbers, stamp_ns)
        new = [plant for plant in boxed if self._to_be_asked(plant, stamp_ns)]
        for plant in new:
            self._check.add(self._pair(plant, float(bearings[plant.object or 0])))
        if not new:
            return None
        state = self._check.state()
        return MountAgreement(trunks=state.pairs, yaw=state.yaw, yaw_std=state.yaw_std, moved=state.moved)

    def _seen_again(self, numbers: Iterable[int], stamp_ns: int) -> None:
        """Trunks that were asked are the same ones for as long as they are seen."""
        for number in self._asked.keys() & set(numbers):
            if self._is_known(number, stamp_ns):
                self._asked[number] = stamp_ns

    def _is_known(self, number: int, stamp_ns: int) -> bool:
        since = self._asked.get(number)
        return since is not None and stamp_ns - since < self._params.again_s * 1e9

    def _to_be_asked(self, plant: ScannedPlant, stamp_ns: int) -> bool:
        p = self._params
        if self._is_known(plant.number, stamp_ns) or plant.sureness < p.sure:
            return False
        if not p.nearest <= self._distance(plant) <= p.furthest:
            return False
        self._asked[plant.number] = stamp_ns
        return True

    def _distance(self, plant: ScannedPlant) -> float:
        return math.hypot(plant.x - self._camera.x, plant.y - self._camera.y)

    def _pair(self, plant: ScannedPlant, bearing: float) -> TrunkPair:
        p, away = self._params, self._distance(plant)
        pixel = self._camera.width_px / 640 / self._camera.fx
        return TrunkPair(
            camera_bearing=bearing, camera_std=math.hypot(p.box_px * pixel, p.sway / away),
            lidar_bearing=math.atan2(plant.y - self._camera.y, plant.x - self._camera.x),
            lidar_std=p.place_std / away, distance=away,
        )  # fmt: skip

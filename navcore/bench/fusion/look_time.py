"""How long a look takes: those of one drive, taken again by ours and by the published chain in turn, alone."""

from __future__ import annotations

from statistics import median
from typing import NamedTuple

from navcore.bench.figure import Figure
from navcore.bench.fusion.segment_cases import Chain, SegmentCase
from navcore.bench.fusion.segment_drive import drive_segment
from navcore.bench.fusion.segment_eyes import ChainEye, OurEye, Pictures, new_chain
from navcore.config import RobotConfig
from navcore.geometry.lidar_mount import robot_lidar
from navcore.messages import CameraName, CameraRequest, CameraView, DetectedObject, LidarScan, SimTruth
from navcore.perception.detector import Image
from navcore.runtime.lockstep import Eye
from navcore.sim.world import World

REPEATS = 3
WANTED_MS = 3.0


class Heard(NamedTuple):
    """What one look had to go by."""

    stamp_ns: int
    request: CameraRequest
    objects: tuple[DetectedObject, ...]
    scans: tuple[LidarScan, ...]


class HearingEye:
    """Ours, with a list of what each look had to go by; `image` is the first picture."""

    def __init__(self, case: SegmentCase, world: World, config: RobotConfig) -> None:
        self._pictures = Pictures(world.orchard, case, case.young().seed)
        self._eye = OurEye(self._pictures, config, robot_lidar())
        self.heard: list[Heard] = []
        self.image: Image | None = None

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        if self.image is None:
            self.image = self._pictures.take(truth, request.camera)
        view = self._eye.look(truth, request, scans)
        self.heard.append(Heard(truth.stamp_ns, request, self._pictures.objects, scans))
        return view

    def again(self, config: RobotConfig) -> list[float]:
        """Seconds of each look that shows a row, one look after the other."""
        ours = OurEye(self._pictures, config, robot_lidar())
        for stamp_ns, request, objects, scans in self.heard:
            if self.image is not None:
                ours.see(self.image, objects, stamp_ns, request, scans)
        return ours.seconds

    def published_again(self) -> list[float]:
        """The same of the published chain."""
        published = ChainEye(new_chain(Chain.PUBLISHED, robot_lidar()), None, robot_lidar())
        for stamp_ns, request, objects, scans in self.heard:
            if request.camera is CameraName.FRONT and request.offset is not None:
                published.feed(stamp_ns, request, objects, scans)
        return published.seconds


def look_time_figures(case: SegmentCase) -> list[Figure]:
    """One drive, and its looks again `REPEATS` times when it is over: the median."""
    ears: list[HearingEye] = []

    def listening(case: SegmentCase, world: World, config: RobotConfig) -> Eye:
        ears.append(HearingEye(case, world, config))
        return ears[-1]

    drive_segment(case, listening)
    ours, published = [], []
    for _ in range(REPEATS):
        ours += ears[0].again(RobotConfig())
        published += ears[0].published_again()
    value = 1e3 * median(ours) if ours else None
    return [
        Figure(
            figure="from scan and boxes to the row, one thread, median, ours", value=value, unit="ms", n=len(ours),
            seed=case.young().seed, baseline=1e3 * median(published) if published else None, target=WANTED_MS,
            ok=None if value is None else value <= WANTED_MS,
        )
    ]  # fmt: skip

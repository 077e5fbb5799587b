"""Paper B's rival that segments the ground, as an eye of the robot that drives."""

from __future__ import annotations

from navcore.bench.fusion.segment_eyes import Pictures, bare_view
from navcore.messages import CameraRequest, CameraView, LidarScan, SimTruth
from navcore.perception.published_fusion.ground_segmenter import GroundSegmenter
from navcore.perception.published_fusion.skeleton_chain import SegmentationSkeleton, SkeletonChainParams
from navcore.runtime.simulation import robot_cameras


class SkeletonEye:
    """One chain for each camera, fed with the same pictures as the detector of the other chains."""

    def __init__(self, pictures: Pictures) -> None:
        segmenter, params = GroundSegmenter(), SkeletonChainParams()
        self._pictures = pictures
        self._chains = {n: SegmentationSkeleton(c, segmenter, params) for n, c in robot_cameras().items()}

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`; the scans are not looked at."""
        image = self._pictures.take(truth, request.camera)
        return bare_view(self._chains[request.camera].process(truth.stamp_ns, image).found.row, ())

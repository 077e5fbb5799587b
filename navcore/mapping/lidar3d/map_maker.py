"""Mapping as a whole: drive -> keyframes -> graph -> loops -> graph -> one map."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from navcore.errors import LogError
from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive import Drive
from navcore.mapping.lidar3d.drive_graph import DriveGraphParams, drive_graph
from navcore.mapping.lidar3d.georeference import Georeference, GeoreferenceParams, georeference
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.keyframe_maker import KeyframeMaker, KeyframeMakerParams
from navcore.mapping.lidar3d.loops import Loop, LoopFinder, LoopParams, borne_out
from navcore.mapping.lidar3d.map_report import BELIEVED, MapReport, doubts, fix_figures, loop_rms, lost_turns
from navcore.mapping.lidar3d.voxel_cloud import VoxelCloud
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.mapping.pose_graph.pose_graph import Solution
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams

# Share of the work that is done, 0 to 1, and what is done now.
Tell = Callable[[float, str], None]
# How the work divides: keyframes, loops, the map.
_KEYFRAMES, _LOOPS = 0.75, 0.92
_HECTARE = 10_000.0
_NO_SITE = "The map is not georeferenced: the run does not say on which site it was driven."
# Keyframes that are drawn together: a cell's Gaussian is made once for all of them.
_AT_ONCE = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class MapMakerParams:
    """Parameters of `MapMaker`.

    Attributes:
        keyframes, place, graph, loops: of each step.
        rounds: how often loops are sought, each time at the poses that the loops before gave; 0 for none.
        ndt: of the map. cloud_voxel: one point of the cloud for each, m.
    """

    keyframes: KeyframeMakerParams = field(default_factory=KeyframeMakerParams)
    place: GeoreferenceParams = field(default_factory=GeoreferenceParams)
    graph: DriveGraphParams = field(default_factory=DriveGraphParams)
    loops: LoopParams = field(default_factory=LoopParams)
    rounds: int = 2
    ndt: NdtMapParams = field(default_factory=NdtMapParams)
    cloud_voxel: float = 0.08


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MadeMap:
    """What came of a drive.

    Attributes:
        ndt: the map; its datum is None where it is not georeferenced.
        cloud: what it was made of, thinned. poses: `T_map_base` of each keyframe.
        loops: all that were looked at. report: what it is good for.
    """

    ndt: NdtMap
    cloud: PointCloud
    poses: tuple[SE3, ...]
    loops: tuple[Loop, ...]
    report: MapReport


class MapMaker:
    """Makes one map; a new one on the same work folder goes on where an older one was killed."""

    def __init__(
        self, drive: Drive, work: WorkFolder, params: MapMakerParams = MapMakerParams(),
        tell: Tell = lambda share, words: None,
    ) -> None:  # fmt: skip
        self._drive, self._work, self._params, self._tell = drive, work, params, tell

    def make(self) -> MadeMap:
        """Raises LogError for a drive without clouds, or one that stood still."""
        maker = self._gather()
        heads = [replace(k, points=k.points[:0], intensities=k.intensities[:0]) for k in self._work]
        if len(heads) < 2:
            raise LogError(self._nothing(maker.turns))
        place = self._placed(heads)
        first = place.T_map_odom or SE3.identity()
        poses = [first @ k.T_odom_base for k in heads]
        solution, loops = self._closed(heads, poses, place)
        ndt, cloud = self._map(solution, place)
        report = self._report(heads, place, solution, loops, ndt, cloud, maker)
        self._tell(1.0, "Done")
        return MadeMap(
            ndt=ndt, cloud=cloud, poses=tuple(solution.poses[i] for i in range(len(heads))), loops=tuple(loops),
            report=report,
        )  # fmt: skip

    def _gather(self) -> KeyframeMaker:
        maker = KeyframeMaker(self._drive, self._work, self._params.keyframes)
        for sensed in self._drive.sensed():
            for keyframe in maker.add(sensed):
                self._work.append(keyframe)
                done = maker.turns / self._drive.clouds if self._drive.clouds else 0.0
                driven = f"{keyframe.driven:.0f} m driven, {len(self._work)} places"
                self._tell(_KEYFRAMES * min(done, 1.0), f"Laying scans on each other: {driven}")
        return maker

    def _placed(self, heads: Sequence[Keyframe]) -> Georeference:
        if self._drive.datum is None:
            return Georeference(T_map_odom=None, reason=_NO_SITE)
        return georeference(heads, self._params.place)

    def _nothing(self, turns: int) -> str:
        if not turns:
            return (
                f"{self._drive.name} has no clouds of a 3D LiDAR. Choose a run of a robot that has one, and see that "
                "it was switched on."
            )
        return f"The robot did not move in {self._drive.name}: there is nothing to map. Choose a run that drove."

    def _closed(
        self, heads: Sequence[Keyframe], poses: Sequence[SE3], place: Georeference
    ) -> tuple[Solution, list[Loop]]:
        """The graph without loops, then with those found at its poses, and again."""
        loops: list[Loop] = []
        solution = self._solved(heads, poses, loops, place)
        scores = [k.score for k in heads[1:]]
        finder = LoopFinder(self._work, float(np.mean(scores)), self._params.loops)
        for n in range(self._params.rounds):
            poses = [solution.poses[i] for i in range(len(heads))]
            loops = []
            for share, found in finder.find(poses, [k.driven for k in heads]):
                loops += found
                done = (n + share) / self._params.rounds
                self._tell(_KEYFRAMES + (_LOOPS - _KEYFRAMES) * done, f"Places passed twice: {len(loops)} looked at")
            loops = borne_out(loops, poses, self._params.loops)
            solution = self._solved(heads, poses, loops, place)
        return solution, loops

    def _solved(
        self, heads: Sequence[Keyframe], poses: Sequence[SE3], loops: Sequence[Loop], place: Georeference
    ) -> Solution:
        terms = [loop.term() for loop in loops if not loop.refused]
        georeferenced = place.T_map_odom is not None
        return drive_graph(heads, poses, terms, georeferenced=georeferenced, params=self._params.graph).solve()

    def _map(self, solution: Solution, place: Georeference) -> tuple[NdtMap, PointCloud]:
        datum = self._drive.datum if place.T_map_odom is not None else None
        ndt, cloud = NdtMap(self._params.ndt, datum=datum), VoxelCloud(self._params.cloud_voxel)
        for begin in range(0, len(self._work), _AT_ONCE):
            drawn = [
                (solution.poses[begin + n].apply(k.points.astype(np.float64)), k.intensities)
                for n, k in enumerate(self._work[begin : begin + _AT_ONCE])
            ]
            ndt.add(np.concatenate([points for points, _ in drawn]))
            for points, intensities in drawn:
                cloud.add(points, intensities)
            self._tell(_LOOPS + (1.0 - _LOOPS) * begin / len(self._work), "Drawing the map")
        bare = PointCloud.of(cloud.points)
        return ndt, replace(bare, intensities=cloud.intensities)

    def _report(
        self, heads: Sequence[Keyframe], place: Georeference, solution: Solution, loops: Sequence[Loop], ndt: NdtMap,
        cloud: PointCloud, maker: KeyframeMaker,
    ) -> MapReport:  # fmt: skip
        fixes = fix_figures(heads, solution if place.T_map_odom is not None else None)
        asked = [loop for loop in loops if not loop.refused]
        taken = int((solution.loop_weights >= BELIEVED).sum())
        refused = Counter(loop.refused for loop in loops if loop.refused)
        if taken < len(asked):
            refused["contradicts the rest of the drive"] = len(asked) - taken
        driven = heads[-1].driven
        return MapReport(
            drive=self._drive.name, turns=maker.turns, blurred=maker.blurred, keyframes=len(heads), driven=driven,
            lost=lost_turns(heads), score=float(np.mean([k.score for k in heads[1:]])),
            loops_taken=taken, loops_refused=dict(refused), loop_rms=loop_rms(asked, solution),
            georeferenced=place.T_map_odom is not None, rtk_share=fixes.share, fixes_doubted=fixes.doubted,
            fix_rms=fixes.rms, cells=sum(len(grid) for grid in ndt.grids), map_bytes=ndt.nbytes, points=len(cloud),
            hectares=_area(cloud) / _HECTARE,
            doubts=doubts(place, fixes, heads, maker.blurred, maker.turns, driven, taken),
        )  # fmt: skip


def _area(cloud: PointCloud) -> float:
    """m^2 under the cloud, in squares of 2 m."""
    squares = np.unique(np.floor(cloud.points[:, :2] / 2.0).astype(np.int64), axis=0)
    return 4.0 * len(squares)

"""Plants as their numbers were followed through a run: which of the run's views saw which plant, and where."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from navcore.geometry.se2 import SE2
from navcore.mapping.pose_track import PoseTrack, Std
from navcore.messages import CameraName, CameraView, ScannedPlant


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantTracksParams:
    """Parameters of `PlantTracks`.

    Attributes:
        near: sightings count up to that distance ahead of the robot and behind it, m: there the scan is dense, and an
            error of the yaw moves a plant least.
        jump: a number that stands this far from where it was names another plant, m: its tracker began anew.
        forgotten_s: as does a number that was not told for so long, s.
        least_sightings: fewer are chance. least_sureness: by the plant's surest sighting, 0 to 1.
    """

    near: float = 4.0
    jump: float = 1.0
    forgotten_s: float = 20.0
    least_sightings: int = 5
    least_sureness: float = 0.5


@dataclass(frozen=True, slots=True)
class Sighting:
    """Of one plant in one view: its centre in `map` as the robot's pose has it, m, and its diameter, m."""

    view: int
    x: float
    y: float
    diameter: float


@dataclass(slots=True)
class PlantTrack:
    """One plant for as long as it was followed; `at` is where it was last."""

    last_ns: int
    at: tuple[float, float]
    sureness: float = 0.0
    sightings: list[Sighting] = field(default_factory=list)


class PlantTracks:
    """Feed it the views of a run in order.

    Attributes:
        stds: of each view that saw plants, the pose's 1-sigma along x and y, m.
    """

    def __init__(self, poses: PoseTrack, params: PlantTracksParams = PlantTracksParams()) -> None:
        self._poses, self._params = poses, params
        self._open: dict[int, PlantTrack] = {}
        self._all: list[PlantTrack] = []
        self.stds: list[Std] = []

    def add(self, view: CameraView) -> None:
        """Take in the plants of one view; without a pose at its stamp they are nowhere."""
        placed = self._poses.at(view.stamp_ns) if view.plants else None
        if placed is None:
            return
        T_map_base, std = placed
        turned = SE2(yaw=math.pi) if view.camera is CameraName.REAR else SE2()
        self.stds.append(std)
        for plant in view.plants:
            if all(map(math.isfinite, (plant.x, plant.y, plant.diameter, plant.sureness))):
                self._sight(view.stamp_ns, plant, T_map_base @ turned)

    def good(self) -> list[PlantTrack]:
        """Those with enough sightings, and sure enough, in the order in which they came in sight."""
        p = self._params
        return [t for t in self._all if len(t.sightings) >= p.least_sightings and t.sureness >= p.least_sureness]

    def _sight(self, stamp_ns: int, plant: ScannedPlant, T_map_driving: SE2) -> None:
        at = T_map_driving.apply_point(plant.x, plant.y)
        track = self._track(plant.number, stamp_ns, at)
        track.last_ns, track.at, track.sureness = stamp_ns, at, max(track.sureness, plant.sureness)
        if abs(plant.x) <= self._params.near:
            track.sightings.append(Sighting(len(self.stds) - 1, *at, plant.diameter))

    def _track(self, number: int, stamp_ns: int, at: tuple[float, float]) -> PlantTrack:
        known = self._open.get(number)
        if known is None or not self._follows(known, stamp_ns, at):
            known = self._open[number] = PlantTrack(stamp_ns, at)
            self._all.append(known)
        return known

    def _follows(self, track: PlantTrack, stamp_ns: int, at: tuple[float, float]) -> bool:
        near = math.dist(track.at, at) <= self._params.jump
        return near and abs(stamp_ns - track.last_ns) <= self._params.forgotten_s * 1e9

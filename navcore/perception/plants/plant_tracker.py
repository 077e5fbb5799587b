"""Follows trunks and posts from scan to scan, around the robot and some metres behind it. Ours.

They stand still in a frame of the tracker's own, in which each scan also tells where the robot is: odometry only
leads to the place where the scan is laid over the plants. What a scan cannot know, which of the uprights are trunks,
the camera tells in time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.perception.plants.passing_rays import share_past
from navcore.perception.plants.plant_evidence import PlantEvidence, PlantEvidenceParams
from navcore.perception.plants.scan_alignment import ScanAlignmentParams, align
from navcore.perception.plants.scanned_plants import ScannedPlants, no_plants
from navcore.perception.plants.tracker_kernels import among, in_base, kept, meet
from navcore.perception.scan.scan_clusters import ScanTrunks

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantTrackerParams:
    """Parameters of `PlantTracker`.

    Attributes:
        alignment: of a scan with the plants. evidence: that an upright is a trunk or a post.
        gate: a trunk of the scan belongs to a plant nearer than that, m.
        steady: 1-sigma by which a plant's place may wander between two scans, m: the tracker's frame is not perfect.
        least_std: no plant is known better than that, m: bark, lean.
        anchors: plants met in so many scans tell where the robot is.
        beyond: a ray that ends further beyond a plant than that, m, passes it.
        past: a scan that does not meet a plant looks past it, if more than that share of the rays at it pass.
        behind: plants further away than that are forgotten, m.
        young: one that is not met again is forgotten after so many scans, if it was met in fewer than `anchors`.
    """

    alignment: ScanAlignmentParams = ScanAlignmentParams()
    evidence: PlantEvidenceParams = PlantEvidenceParams()
    gate: float = 0.2
    steady: float = 0.002
    least_std: float = 0.008
    anchors: int = 3
    beyond: float = 0.15
    past: float = 0.7
    behind: float = 14.0
    young: int = 4


class PlantTracker:
    """One LiDAR's. Feed it every scan in order, or `forget` in between."""

    def __init__(self, mount: LidarMount, params: PlantTrackerParams = PlantTrackerParams()) -> None:
        self._mount, self._params = mount, params
        self._axes = np.ascontiguousarray(mount.R_base_lidar()[:2, :2])
        self.forget()

    def forget(self) -> None:
        """The next scan does not follow the last one."""
        self._pose, self._next = SE2(), 0
        self._plants = no_plants(self._mount.z)
        self._since_hit: Ints = np.empty(0, dtype=np.int64)
        self._measured: Floats = np.empty(0)  # weight of all diameters so far, 1/m^2
        self._evidence = PlantEvidence(self._params.evidence)

    def see(self, trunks: ScanTrunks, motion: SE2, turn: SE2 = SE2()) -> SE2:
        """Take in a scan; the motion since the last one as the plants tell it.

        `motion` is `base_link` at this scan's stamp in `base_link` at the last one's, by odometry; `turn` the part of
        it that was driven while the sensor turned.
        """
        p, before = self._params, self._pose
        xy, std = self._in_base(trunks, turn), np.maximum(trunks.range_std, trunks.range * trunks.bearing_std)
        known = self._plants.hits >= p.anchors
        at, at_std = self._plants.xy[known], self._plants.std[known]
        self._pose = align(before @ motion, motion, xy, std, at, at_std, p.alignment)
        self._take_in(self._pose.apply(xy), std, trunks)
        self._clear()
        return before.inverse() @ self._pose

    def look_past(self, angles: Floats, distances: Floats, turn: SE2 = SE2()) -> None:
        """What the rays (N,) of the scan just seen, as in `LidarScan`, say against plants; `turn` as in `see`."""
        p, met = self._params, self._since_hit == 0
        xy = self._pose.inverse().apply(self._plants.xy)
        share = share_past(xy, self._plants.diameter, angles, distances, self._mount, turn, p.beyond)
        self._evidence.scan(met, ~met & (share > p.past))

    def plants(self, since: SE2 = SE2()) -> ScannedPlants:
        """All that were met more than once, in `base_link`, the robot having driven `since` after the last scan."""
        seen = self._plants.hits >= 2
        now = self._plants.only(seen).seen_from((self._pose @ since).inverse())
        return ScannedPlants(
            number=now.number, xy=now.xy, std=now.std, diameter=now.diameter, hits=now.hits,
            sureness=self._evidence.sureness()[seen], height=now.height,
        )  # fmt: skip

    def told_by_camera(self, boxed: Ints, expected: Ints) -> None:
        """Numbers of the plants that a picture shows as trunks or posts, and of those that it should show."""
        shown, missed = (among(self._plants.number, numbers) for numbers in (boxed, expected))
        self._evidence.see(shown, missed & ~shown)

    def _in_base(self, trunks: ScanTrunks, turn: SE2) -> Floats:
        """Centres (K, 2) in `base_link` at the scan's stamp."""
        place, driven = (self._mount.x, self._mount.y), (turn.x, turn.y, turn.yaw)
        return np.asarray(in_base(trunks.bearing, trunks.range, trunks.moment, self._axes, place, driven))

    def _take_in(self, xy: Floats, std: Floats, trunks: ScanTrunks) -> None:
        p, plants, weight = self._params, self._plants, _weight(trunks)
        known = plants.xy, plants.std, plants.diameter, self._measured, plants.hits, self._since_hit
        mine, theirs, new = meet((xy, std, trunks.diameter, weight), known, p.gate, p.steady, p.least_std)
        self._evidence.met(theirs, trunks.diameter[mine], trunks.roughness[mine], trunks.cut[mine])
        if len(new):
            self._add(xy[new], std[new], trunks.diameter[new], weight[new])
            self._evidence.add(trunks.diameter[new], trunks.roughness[new], trunks.cut[new])

    def _add(self, xy: Floats, std: Floats, diameter: Floats, weight: Floats) -> None:
        n, old = len(xy), self._plants
        self._plants = ScannedPlants(
            number=np.concatenate((old.number, self._next + np.arange(n))), xy=np.vstack((old.xy, xy)),
            std=np.concatenate((old.std, std)), diameter=np.concatenate((old.diameter, diameter)),
            hits=np.concatenate((old.hits, np.ones(n, dtype=np.int64))), sureness=np.zeros(len(old) + n),
            height=old.height,
        )  # fmt: skip
        self._since_hit = np.concatenate((self._since_hit, np.zeros(n, dtype=np.int64)))
        self._measured = np.concatenate((self._measured, weight))
        self._next += n

    def _clear(self) -> None:
        """Forget what is far behind, and what was met once and not again."""
        p, plants, here = self._params, self._plants, (self._pose.x, self._pose.y)
        known = kept(plants.xy, plants.hits, self._since_hit, here, p.behind, p.anchors, p.young)
        if known.all():
            return
        self._plants, self._since_hit = plants.only(known), self._since_hit[known]
        self._measured = self._measured[known]
        self._evidence.keep(known)


def _weight(trunks: ScanTrunks) -> Floats:
    """(K,) how much a scan's diameters count, 1/m^2: those of trunks that are cut hardly at all."""
    return np.asarray(np.where(trunks.cut, 1.0, trunks.diameter_std**-2.0), dtype=np.float64)

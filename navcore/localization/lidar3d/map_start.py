"""From not knowing the place to knowing it: a coarse look over the region, places laid onto, and one that leads.

A place is taken only where it fits clearly better than every other that may be meant. Told nothing, that is every
place on the map, and a clear lead is more: of two places that are both wrong, as on another block's map, one fits
better than the other too. Work is divided over clouds, so that each takes about a tenth of a second.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.contest import Contest, ContestParams, Hypothesis, away
from navcore.localization.ndt.birds_eye import BirdsEye
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.place_search import PlaceSearch, PlaceSearchParams, Region
from navcore.localization.ndt.registration import Registration
from navcore.localization.ndt.start_search import StartSearchParams
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]
NS = 1e-9
TURNED = 0.3  # rad, that is worth saying
SEARCHED = "the map is being searched"
_SETTLING = StartSearchParams(
    reach=0.4,
    step=0.2,
    turn=math.radians(3.0),
    turn_step=math.radians(1.5),
    grid=1,
    points=300,
    steepness=0.1,
    doubt=0.0,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class MapStartParams:
    """Parameters of `MapStart`.

    Attributes:
        search: the coarse look. settling: from there to where a cloud lies. contest: among those places.
        at_once: places that are settled on one cloud.
        beyond: places so far beside a region are looked at too, m: the next row on may fit better.
        looks: clouds before a place is taken, at least 1.
        lead: over every other place in the region, see `Contest.lead`; by as much one beside it is better.
        lead_anywhere: over every other place on the map where no region is told. Of two wrong places on another
            block's map one led by up to 6.7.
        again_s, again_step: without a lead, it is looked again after so long, s, or a step, m.
        whole_again: after driving so far all is searched anew, m. nowhere_s: after so long where nothing fits, s.
    """

    search: PlaceSearchParams = field(default_factory=PlaceSearchParams)
    settling: NdtMatcherParams = field(default_factory=lambda: NdtMatcherParams(search=_SETTLING))
    contest: ContestParams = field(default_factory=ContestParams)
    at_once: int = 8
    beyond: float = 7.0
    looks: int = 3
    lead: float = 3.0
    lead_anywhere: float = 8.0
    again_s: float = 2.0
    again_step: float = 0.5
    whole_again: float = 15.0
    nowhere_s: float = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class StartLook:
    """What one cloud brought: the place, or why there is none; `alike` places where several fit as well."""

    found: Registration | None
    reason: str
    alike: int = 0


class MapStart:
    """One cloud after another in; one search at a time."""

    def __init__(self, ndt_map: NdtMap, matcher: NdtMatcher, params: MapStartParams = MapStartParams()) -> None:
        self._map, self._p, self._eye = ndt_map, params, BirdsEye.of(ndt_map)
        self._settler, self._matcher = NdtMatcher(ndt_map, params.settling), matcher
        self.begin_anew()

    def begin_anew(self) -> None:
        """Forget what was found so far."""
        self._search: PlaceSearch | None = None
        self._unsettled: list[SE3] = []
        self._contest: Contest | None = None
        self._began = self._looked = SE3.identity()
        self._began_ns = self._looked_ns = self._looks = 0
        self._told = StartLook(None, SEARCHED)

    def look(self, points: Floats, stamp_ns: int, T_odom_base: SE3, region: Region | None) -> StartLook:
        """One cloud (N, 3) in `base_link`, thinned, and odometry at its capture."""
        if self._eye is None:
            return StartLook(None, "the 3D map is empty: make one from a run, on the Runs page")
        if self._contest is None:
            self._search = self._begin(self._eye, points, stamp_ns, T_odom_base, region)
            self._contest = Contest(self._map, self._matcher, self._p.contest)
        if self._search is not None:
            self._go_on(self._search, self._contest, points, T_odom_base, region)
            return StartLook(None, SEARCHED)
        return self._contested(self._contest, points, stamp_ns, T_odom_base, region)

    def _begin(
        self, eye: BirdsEye, points: Floats, stamp_ns: int, T_odom_base: SE3, region: Region | None
    ) -> PlaceSearch:  # fmt: skip
        self._began, self._began_ns, self._looks = T_odom_base, stamp_ns, 0
        wider = None if region is None else replace(region, reach=region.reach + self._p.beyond)
        return PlaceSearch(eye, _level(points, T_odom_base), wider, self._p.search)

    def _go_on(
        self, search: PlaceSearch, contest: Contest, points: Floats, T_odom_base: SE3, region: Region | None
    ) -> None:  # fmt: skip
        """The coarse look goes on, and then places are settled."""
        if not search.done:
            search.step()
            self._unsettled = [_tie(search.eye, at, self._began) for at in search.places()] if search.done else []
            return
        for tie in self._unsettled[: self._p.at_once]:
            found = self._settler.match(points, tie @ T_odom_base)
            meant = region is None or region.holds(found.T_target_source.se2())
            contest.enter(found, T_odom_base, meant=meant)
        del self._unsettled[: self._p.at_once]
        if not self._unsettled:
            self._search = None
            contest.thin_out()

    def _contested(
        self, contest: Contest, points: Floats, stamp_ns: int, T_odom_base: SE3, region: Region | None
    ) -> StartLook:  # fmt: skip
        if self._is_stale(contest, stamp_ns, T_odom_base):
            self.begin_anew()
        elif self._is_due(stamp_ns, T_odom_base):
            self._looked, self._looked_ns, self._looks = T_odom_base, stamp_ns, self._looks + 1
            contest.look(points, T_odom_base)
            self._told = self._judged(contest, region)
        return self._told

    def _is_due(self, stamp_ns: int, T_odom_base: SE3) -> bool:
        """The first looks at once; then only what may be new."""
        waited = (stamp_ns - self._looked_ns) * NS >= self._p.again_s
        return self._looks < self._p.looks or waited or away(self._looked, T_odom_base) >= self._p.again_step

    def _is_stale(self, contest: Contest, stamp_ns: int, T_odom_base: SE3) -> bool:
        """Too far on for what was searched, or nothing of it is left."""
        over = (stamp_ns - self._began_ns) * NS >= self._p.nowhere_s and not contest.places
        return over or away(self._began, T_odom_base) >= self._p.whole_again

    def _judged(self, contest: Contest, region: Region | None) -> StartLook:
        inside = [place for place in contest.places if region is None or region.holds(_at(place))]
        if self._looks < self._p.looks and contest.places:
            return StartLook(None, SEARCHED)
        if not inside:
            return StartLook(None, _nowhere(contest, region))
        first, needed = inside[0], self._p.lead_anywhere if region is None else self._p.lead
        better = [other for other in contest.places if contest.lead(other, first) >= self._p.lead]
        if better:
            return StartLook(None, _elsewhere(_at(better[0]), _at(first)))
        alike = sum(contest.lead(first, other) < needed for other in inside)
        if alike > 1:  # itself is one of them
            return StartLook(None, f"{alike} places look the same", alike)
        return StartLook(first.found, "")


def _nowhere(contest: Contest, region: Region | None) -> str:
    if region is not None and contest.places:
        return _elsewhere(_at(contest.places[0]), region.at)
    return "the cloud fits nowhere on the 3D map" + ("" if region is None else " near there")


def _elsewhere(there: SE2, told: SE2) -> str:
    away, turned = math.hypot(there.x - told.x, there.y - told.y), abs(wrap(there.yaw - told.yaw))
    where = f"{away:.0f} m from there" + (f", turned by {math.degrees(turned):.0f} deg" if turned > TURNED else "")
    return f"the cloud fits better {where}: look again where the robot stands"


def _level(points: Floats, T_odom_base: SE3) -> Floats:
    """In the robot's frame without its lean."""
    roll, pitch, _ = T_odom_base.rpy()
    return SE3.from_rpy((0.0, 0.0, 0.0), roll, pitch, 0.0).apply(points)


def _tie(eye: BirdsEye, at: SE2, T_odom_base: SE3) -> SE3:
    """`T_map_odom` that puts the robot there, on the ground, with the lean it has."""
    roll, pitch, _ = T_odom_base.rpy()
    place = SE3.from_rpy((at.x, at.y, eye.height(at.x, at.y)), roll, pitch, at.yaw)
    return place @ T_odom_base.inverse()


def _at(place: Hypothesis) -> SE2:
    return place.found.T_target_source.se2()

"""Which missions the bench drives: farms, seasons, lights, seeds, ways out of the row."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from itertools import product

from navcore.maps.mission import RowExit
from navcore.sim.camera_light import LightName
from navcore.sim.orchard import Season


class CaseKind(StrEnum):
    """What is asked of the robot.

    MISSION: warehouse, row, warehouse, all sensors. ROW_CHANGE: a mission into the next row over the headland, RTK
    corrections lost from the first row until the second. GNSS_ONLY: the same as either without a camera. TRACK:
    100 m of road on GNSS.
    """

    MISSION = "mission"
    GNSS_ONLY = "gnss_only"
    ROW_CHANGE = "row_change"
    TRACK = "track"


class Track(StrEnum):
    """Shapes of 100 m on GNSS, as in paper A's Table 12."""

    STRAIGHT = "straight"
    CURVE = "curve"
    Z = "z"


class Farms(StrEnum):
    """Which farms: scores count on farms that nothing was tuned on."""

    SCORING = "scoring"
    TUNING = "tuning"


class EyeKind(StrEnum):
    """PIXELS: rendered pictures through the shipped detector. TRUTH: boxes from the truth, spoilt."""

    PIXELS = "pixels"
    TRUTH = "truth"


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionCase:
    """One drive.

    Attributes:
        farm: index of the layout. seed: of the world.
        speed: in the row, m/s.
        track: for TRACK cases.
    """

    kind: CaseKind
    farms: Farms
    farm: int
    seed: int
    season: Season = Season.GROWING
    light: LightName = LightName.NOON
    row_exit: RowExit = RowExit.REVERSE
    speed: float = 0.6
    eye: EyeKind = EyeKind.PIXELS
    track: Track | None = None

    @property
    def id(self) -> str:
        """Name by which a case is found again."""
        parts = [self.kind, self.farms, self.farm, self.seed, self.season, self.light, self.row_exit, self.speed]
        return "/".join(map(str, [*parts, self.eye, self.track or "-"]))


SEASONS = (Season.BUDDING, Season.GROWING, Season.MATURING)
LIGHTS = (LightName.NOON, LightName.OVERCAST, LightName.BACKLIT)
SPEEDS = (0.6, 0.4, 0.8)
EXITS = (RowExit.REVERSE, RowExit.NEXT_ROW)
# Worlds that somebody has looked into to mend something are not unseen any more: then these move on.
MISSION_SEED, TRACK_SEED, ROW_CHANGE_SEED = 31_000, 32_000, 33_000
QUICK = (Season.GROWING, LightName.OVERCAST)


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseParams:
    """How many cases.

    Attributes:
        farms: number of layouts; each is driven in all seasons and lights.
        row_changes, tracks: seeds of each, and for tracks of each shape.
        quick: one mission (farm 0, growing, overcast, 0.8 m/s, out in reverse) and its ablation, one seed a track, no
            row change.
    """

    source: Farms = Farms.SCORING
    eye: EyeKind = EyeKind.PIXELS
    farms: int = 8
    row_changes: int = 28
    tracks: int = 5
    quick: bool = False


def mission_cases(params: CaseParams) -> tuple[MissionCase, ...]:
    """All cases, each mission followed by its ablation on GNSS alone.

    Kinds, farms, seasons and lights take turns, so that a bench that is broken off has met them all.
    """
    missions = _evenly(_missions(params), _row_changes(params))
    alone = tuple(_like(case, CaseKind.GNSS_ONLY) for case in missions)
    return (*_tracks(params), *(case for pair in zip(missions, alone, strict=True) for case in pair))


def _evenly(*kinds: tuple[MissionCase, ...]) -> tuple[MissionCase, ...]:
    """All of them, each kind in its own order and spread over the whole."""
    placed = [((i + 0.5) / len(cases), case) for cases in kinds for i, case in enumerate(cases)]
    return tuple(case for _, case in sorted(placed, key=lambda p: p[0]))


def _missions(params: CaseParams) -> tuple[MissionCase, ...]:
    """Every farm in every season and light; speeds and exits take turns so that each meets each."""
    weathers = tuple(product(SEASONS, LIGHTS))
    cases = []
    for turn, farm in product(range(len(weathers)), range(1 if params.quick else params.farms)):
        weather = (turn + farm) % len(weathers)
        season, light = weathers[weather]
        number = farm * len(weathers) + weather
        if params.quick and (season, light) != QUICK:
            continue
        cases.append(
            MissionCase(
                kind=CaseKind.MISSION, farms=params.source, farm=farm, seed=MISSION_SEED + number,
                season=season, light=light, row_exit=EXITS[number % 2], speed=SPEEDS[(number // 2) % 3],
                eye=params.eye,
            )
        )  # fmt: skip
    return tuple(cases)


def _like(case: MissionCase, kind: CaseKind) -> MissionCase:
    return MissionCase(
        kind=kind, farms=case.farms, farm=case.farm, seed=case.seed, season=case.season, light=case.light,
        row_exit=case.row_exit, speed=case.speed, eye=case.eye,
    )  # fmt: skip


def _row_changes(params: CaseParams) -> tuple[MissionCase, ...]:
    """In leaf, under a roof, where RTK is gone long before the headland."""
    return tuple(
        MissionCase(
            kind=CaseKind.ROW_CHANGE, farms=params.source, farm=i % params.farms, seed=ROW_CHANGE_SEED + i,
            season=SEASONS[1 + i % 2], light=LIGHTS[i % 3], row_exit=RowExit.NEXT_ROW, eye=params.eye,
        )
        for i in range(0 if params.quick else params.row_changes)
    )  # fmt: skip


def _tracks(params: CaseParams) -> tuple[MissionCase, ...]:
    seeds = range(1 if params.quick else params.tracks)
    return tuple(
        MissionCase(kind=CaseKind.TRACK, farms=params.source, farm=0, seed=TRACK_SEED + s, track=track, speed=0.8)
        for track in Track
        for s in seeds
    )

"""How much the 3D map is worth now: the newest match that is believed, its age, and for how long it has been so."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_watch import MapWatch, MapWatchParams
from navcore.localization.lidar3d.travel_direction import TravelDirection, TravelDirectionParams
from navcore.localization.row_line import RowLine
from navcore.messages import FixQuality, GnssFix, MapMatch, MatchState, RowObservation

NS = 1e-9
# Older than this a LiDAR says nothing of now, s.
FRESH_S = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MapEvidenceParams:
    """Parameters of `MapEvidence`.

    Attributes:
        row_agrees: a row that was seen within this of where it is drawn may be driven by the map, m.
        antenna_x, antenna_y: of GNSS in `base_link`, m.
    """

    row_agrees: float = 0.15
    antenna_x: float = 0.0
    antenna_y: float = 0.0
    watch: MapWatchParams = field(default_factory=MapWatchParams)
    direction: TravelDirectionParams = field(default_factory=TravelDirectionParams)


class MapEvidence:
    """Matches on the 3D map, judged by independent witnesses.

    Attributes:
        newest: the newest match that was believed. told: the newest of all. streak: believed ones in a row.
        T_map_odom: by the newest that was believed. antenna_at: by the newest fix, in `map`, m.
    """

    def __init__(self, frame: EnuFrame, params: MapEvidenceParams) -> None:
        self._frame, self._params = frame, params
        self._watch = MapWatch(params.watch)
        self._direction = TravelDirection(params.direction)
        self._antenna = (params.antenna_x, params.antenna_y)
        self.newest: MapMatch | None = None
        self.told: MapMatch | None = None
        self.streak = 0
        self.T_map_odom = SE2()
        self.antenna_at: tuple[float, float] | None = None

    def add(self, match: MapMatch, T_odom_base: SE2) -> bool:
        """One match with the odometry at its capture; whether it may move the pose."""
        self.told = match
        self._watch_direction(match, T_odom_base)
        if not self._watch.add_match(match, T_odom_base):
            self.streak = 0
            return False
        self.newest, self.streak = match, self.streak + 1
        self.T_map_odom = SE2(match.x, match.y, match.yaw) @ T_odom_base.inverse()
        return True

    def add_fix(self, fix: GnssFix, T_odom_base: SE2) -> None:
        """One fix with the odometry at its capture: only a fixed RTK position is a witness."""
        if self.told is None or fix.lat_deg is None or fix.lon_deg is None:
            return
        east, north = self.antenna_at = self._place(fix.lat_deg, fix.lon_deg, fix.height_m)
        if fix.quality is not FixQuality.RTK_FIXED:
            return
        std = max(fix.std_east_m or 0.0, fix.std_north_m or 0.0)
        self._watch.add_fix(fix.stamp_ns, east, north, std, T_odom_base, self._antenna)

    def base_by_fix(self, yaw: float) -> SE2 | None:
        """Where the newest fix alone puts `base_link`, looking along `yaw`; None before one with a place."""
        if self.antenna_at is None:
            return None
        ax, ay = SE2(0.0, 0.0, yaw).apply_point(*self._antenna)
        return SE2(self.antenna_at[0] - ax, self.antenna_at[1] - ay, yaw)

    def _watch_direction(self, match: MapMatch, T_odom_base: SE2) -> None:
        if match.state is MatchState.MATCHED:
            self._direction.add(SE2(match.x, match.y, match.yaw), T_odom_base)
        else:
            self._direction.pause()

    def _place(self, lat_deg: float, lon_deg: float, height_m: float | None) -> tuple[float, float]:
        east, north, _ = self._frame.to_enu(lat_deg, lon_deg, self._frame.height_m if height_m is None else height_m)
        return float(east), float(north)

    def add_row(self, leg: str, seen: RowObservation, row: RowLine, T_odom_drive: SE2, T_map_odom: SE2) -> None:
        """A row that is seen, where it is drawn, and the pose by the map; `leg` names row and direction."""
        if seen.offset is not None and self.newest is not None:
            by_map = row.coordinates(T_map_odom @ T_odom_drive)
            self._watch.add_row(leg, -seen.offset, by_map.y)

    def leads_through(self, leg: str | None) -> bool:
        """Whether the row was seen to lie where it is drawn."""
        return self._watch.row_agrees(leg, self._params.row_agrees)

    def age_s(self, now_ns: int) -> float | None:
        """Age of the newest match that was believed."""
        return None if self.newest is None else (now_ns - self.newest.stamp_ns) * NS

    def in_use(self, now_ns: int) -> bool:
        """A 3D LiDAR reports, and there is a map to lay its clouds onto."""
        told = self.told
        return told is not None and told.state is not MatchState.NO_MAP and (now_ns - told.stamp_ns) * NS <= FRESH_S

    @property
    def turned(self) -> float:
        """How far the LiDAR looks to the left of where its mount says, rad; 0 until enough was driven."""
        return self._direction.turned or 0.0

    @property
    def disputed(self) -> bool:
        """The clouds fit, but other witnesses say that they fit in the wrong place."""
        return bool(self._watch.reason)

    @property
    def reason(self) -> str:
        """Why there is no place on the map, empty while there is."""
        if self._watch.reason:
            return self._watch.reason
        if self.told is None:
            return "no 3D LiDAR"
        return "" if self.told.state is MatchState.MATCHED else self.told.reason or self.told.state.value

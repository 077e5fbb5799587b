"""What a look at the row does to the path, by what the robot drives on."""

from __future__ import annotations

from dataclasses import replace

import pytest

from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.maps.site_map import Datum
from navcore.messages import CameraName, NavMode, PathSegment, RowObservation, SegmentKind
from navcore.mission.map_evidence import MapEvidence, MapEvidenceParams
from navcore.mission.pilot_params import PilotParams
from navcore.mission.position import Position
from navcore.mission.route import Leg
from navcore.mission.row_looks import Onlooker, RowLooks

ENDS = ((0.0, 0.0), (60.0, 0.0))
ROW = PathSegment(
    kind=SegmentKind.ROW, points=ENDS, speeds=(0.6, 0.6), row_id="r", row_start=ENDS[0], row_end=ENDS[1]
)
SEEN = RowObservation(
    stamp_ns=1, camera=CameraName.FRONT, valid=True, reason="", offset=-0.2, heading=0.0, offset_std=0.03,
    heading_std=0.01, width=3.0, quality=0.9,
)  # fmt: skip
INSIDE, BEFORE = SE2(20.0, 0.0, 0.0), SE2(-1.0, 0.0, 0.0)


class Looking:
    """A robot whose odometry began at the map's origin, and that sees the row 0.2 m to its right."""

    def __init__(self) -> None:
        self.anchor = PathAnchor(SE2(), PathAnchorParams())
        on_map = MapEvidence(EnuFrame(Datum(lat_deg=45.0, lon_deg=9.0, height_m=0.0)), MapEvidenceParams())
        self.looks = RowLooks(self.anchor, on_map, PilotParams())

    def look(self, mode: NavMode, at: SE2, by_gnss: SE2 | None = None, *, comes_from_gnss: bool = True) -> bool:
        """0.1 m after the last look; True if the path was put right."""
        self.anchor.drive(0.1, 0.2, at)
        position = Position(
            now_ns=1, T_odom_base=at, T_map_base=by_gnss, gnss_std=0.02, gnss_streak=9, standing=False
        )  # fmt: skip
        by = Onlooker(mode, Leg((ROW,), 0), max(at.x, 0.0), position, comes_from_gnss)
        return self.looks.take(replace(SEEN, heading=-at.yaw), at, by)

    def moved(self, at: SE2) -> float:
        """How far to the left the path's tie has moved the robot, m."""
        return (self.anchor.T_map_odom @ at).y - at.y


def test_a_look_in_the_row_puts_the_robot_beside_the_drawn_row_as_it_is_beside_the_seen_one() -> None:
    robot = Looking()
    assert all(robot.look(NavMode.ROW, INSIDE) for _ in range(20))
    assert robot.moved(INSIDE) == pytest.approx(0.2, abs=0.01)  # m


def test_a_look_from_the_road_tells_that_the_row_is_there_and_moves_nothing() -> None:
    robot = Looking()
    assert not robot.look(NavMode.GNSS_PATH, INSIDE)
    assert robot.looks.evidence.streak == 1
    assert robot.anchor.T_map_odom == SE2()


def test_on_the_headland_the_next_row_counts_once_it_is_seen_for_sure_by_a_robot_that_is_turned_to_it() -> None:
    robot, aside = Looking(), SE2(-1.0, 0.0, 0.5)
    counted = [robot.look(NavMode.HEADLAND, BEFORE) for _ in range(5)]
    assert counted == [False] * 4 + [True]
    askew = Looking()
    assert not any(askew.look(NavMode.HEADLAND, aside) for _ in range(9))
    assert askew.looks.evidence.streak == 9


def test_on_the_way_in_the_row_has_to_lie_where_gnss_says_that_it_does() -> None:
    beside = SE2(1.0, 2.0, 0.0)
    robot, at = Looking(), SE2(1.0, 0.0, 0.0)
    assert not robot.look(NavMode.ROW_ENTRY, at, by_gnss=beside)
    assert robot.looks.evidence.streak == 0
    assert robot.look(NavMode.ROW_ENTRY, at, by_gnss=beside, comes_from_gnss=False)

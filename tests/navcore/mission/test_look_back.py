"""Out of a row on wet ground: wheels slip, and the plants behind tell by how much."""

from __future__ import annotations

import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.row_line import RowLine
from navcore.messages import CameraName, NavMode, PathSegment, RowObservation, SegmentKind
from navcore.mission.evidence import RowEvidenceParams
from navcore.mission.look_back import LeftRow, LookBack

ROW = LeftRow(RowLine(0.0, 0.0, 0.0), 3.0, 60.0)
EXIT = PathSegment(kind=SegmentKind.EXIT, points=((60.0, 0.0), (66.0, 0.0)), speeds=(0.4, 0.4))


def seen(driven: float | None, since_ns: int = 7, width: float = 3.0) -> RowObservation:
    return RowObservation(
        stamp_ns=9, camera=CameraName.REAR, valid=True, reason="", offset=0.0, heading=0.0, width=width, quality=0.9,
        driven=driven, driven_since_ns=since_ns,
    )  # fmt: skip


@pytest.fixture
def anchor() -> PathAnchor:
    return PathAnchor(SE2(), PathAnchorParams())


@pytest.fixture
def look(anchor: PathAnchor) -> LookBack:
    look = LookBack(anchor, RowEvidenceParams())
    look.row = ROW
    assert look.choose(NavMode.ROW_END, EXIT, sees_row_ahead=False)
    return look


def along(anchor: PathAnchor, odom: SE2) -> tuple[float, float]:
    at, left = anchor.T_map_odom @ odom, anchor.departed @ odom
    return at.x, left.x


def test_the_plants_behind_tell_how_far_the_robot_got_whatever_the_wheels_say(
    look: LookBack, anchor: PathAnchor
) -> None:
    for step in range(51):
        odom = SE2(60.0 + step * 0.11, 0.0, 0.0)
        look.see(seen(-step * 0.1), odom)
    assert along(anchor, odom) == pytest.approx((65.0, 65.0), abs=1e-9)  # m; 65.5 by the wheels


def test_pictures_that_are_dropped_or_not_believed_take_nothing_from_the_way(
    look: LookBack, anchor: PathAnchor
) -> None:
    for step in (0, 1, 4, 5, 9, 10):
        odom = SE2(60.0 + step * 0.11, 0.0, 0.0)
        look.see(seen(-step * 0.1, width=6.0 if step == 5 else 3.0), odom)
    assert along(anchor, odom)[0] == pytest.approx(61.0, abs=1e-9)  # m


def test_plants_that_come_in_sight_anew_count_from_there(look: LookBack, anchor: PathAnchor) -> None:
    look.see(seen(-1.0), SE2(60.0, 0.0, 0.0))
    look.see(seen(0.0, since_ns=8), SE2(62.0, 0.0, 0.0))
    assert along(anchor, SE2(62.0, 0.0, 0.0))[0] == pytest.approx(62.0, abs=1e-9)  # m
    look.see(seen(-0.9, since_ns=8), SE2(63.0, 0.0, 0.0))
    assert along(anchor, SE2(63.0, 0.0, 0.0))[0] == pytest.approx(62.9, abs=1e-9)  # m


def test_what_tells_no_way_moves_nothing(look: LookBack, anchor: PathAnchor) -> None:
    look.see(seen(None), SE2(60.0, 0.0, 0.0))
    look.see(seen(None), SE2(62.0, 0.0, 0.0))
    assert along(anchor, SE2(62.0, 0.0, 0.0))[0] == pytest.approx(62.0, abs=1e-9)  # m

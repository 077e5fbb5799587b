"""The switches between GNSS and camera: each happens when it should, and none twice in a row."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

from navcore.messages import NavMode, SegmentKind
from navcore.mission.mode_facts import ModeFacts, ModeSelectorParams
from navcore.mission.mode_selector import select_mode

PARAMS = ModeSelectorParams()
OPEN_ROAD = ModeFacts(
    segment=SegmentKind.ROAD, to_start=None, to_end=None, row_follows=False, turn_follows=False,
    row_streak=0, row_age_s=None, looks=True, seen_end=None, seen_to=None, gnss_std=0.02,
    gnss_streak=100,
)  # fmt: skip
BEFORE_ROW = replace(OPEN_ROAD, segment=SegmentKind.ENTRY, to_start=3.0, to_end=63.0, row_streak=5, row_age_s=0.1)
IN_ROW = replace(BEFORE_ROW, segment=SegmentKind.ROW, to_start=-30.0, to_end=30.0, gnss_std=1.5, gnss_streak=0)
AT_END = replace(IN_ROW, to_end=1.0, seen_end=1.0)
LEFT_ROW = replace(AT_END, segment=SegmentKind.EXIT, to_end=-2.0, row_streak=0, gnss_std=0.02, gnss_streak=10)


def mode_after(before: NavMode, facts: ModeFacts) -> NavMode:
    return select_mode(before, facts, PARAMS)[0]


def test_camera_takes_over_before_the_entrance_once_the_row_is_seen_repeatedly() -> None:
    assert mode_after(NavMode.GNSS_PATH, BEFORE_ROW) is NavMode.ROW_ENTRY
    assert mode_after(NavMode.GNSS_PATH, replace(BEFORE_ROW, row_streak=4)) is NavMode.GNSS_PATH


def test_no_row_is_entered_from_the_road() -> None:
    assert mode_after(NavMode.GNSS_PATH, replace(OPEN_ROAD, row_streak=50)) is NavMode.GNSS_PATH


def test_entry_becomes_row_inside() -> None:
    assert mode_after(NavMode.ROW_ENTRY, BEFORE_ROW) is NavMode.ROW_ENTRY
    assert mode_after(NavMode.ROW_ENTRY, replace(BEFORE_ROW, to_start=-0.1)) is NavMode.ROW


def test_row_lost_before_the_entrance_goes_back_to_gnss() -> None:
    lost = replace(BEFORE_ROW, row_streak=0, row_age_s=1.5)
    assert mode_after(NavMode.ROW_ENTRY, lost) is NavMode.GNSS_PATH


def test_gnss_never_takes_over_inside_a_row() -> None:
    good_gnss = replace(IN_ROW, gnss_std=0.01, gnss_streak=1000, row_streak=0, row_age_s=9.0)
    assert mode_after(NavMode.ROW, good_gnss) is NavMode.ROW


def test_row_end_is_driven_on_odometry_until_gnss_is_good() -> None:
    assert mode_after(NavMode.ROW, AT_END) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(LEFT_ROW, gnss_std=0.8)) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(LEFT_ROW, gnss_streak=2)) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, LEFT_ROW) is NavMode.GNSS_PATH


def test_an_end_that_is_seen_counts_before_its_last_plants_leave_the_picture() -> None:
    near = replace(IN_ROW, to_end=3.0, seen_end=2.9)
    assert mode_after(NavMode.ROW, near) is NavMode.ROW_END
    assert mode_after(NavMode.ROW, replace(near, seen_end=None)) is NavMode.ROW
    gap_mid_row = replace(near, to_end=40.0)
    assert mode_after(NavMode.ROW, gap_mid_row) is NavMode.ROW


def test_a_row_goes_on_beyond_its_seeming_end_where_plants_are_seen_there() -> None:
    gap = replace(IN_ROW, to_end=3.5)
    assert mode_after(NavMode.ROW_END, gap) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(gap, to_end=20.0)) is NavMode.ROW
    assert mode_after(NavMode.ROW_END, replace(gap, seen_to=2.5)) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(gap, seen_to=8.0)) is NavMode.ROW
    assert mode_after(NavMode.ROW_END, replace(gap, seen_end=8.0)) is NavMode.ROW


def test_a_place_that_slides_back_over_the_entry_does_not_end_the_row_ahead() -> None:
    """The row's end comes into sight of the next row's entry, and puts the robot back onto the turn for a moment."""
    back = replace(BEFORE_ROW, segment=SegmentKind.HEADLAND)
    assert mode_after(NavMode.ROW_ENTRY, back) is NavMode.ROW_ENTRY


def test_headland_is_turned_without_gnss_and_leads_into_the_next_row() -> None:
    turning = replace(LEFT_ROW, segment=SegmentKind.HEADLAND, gnss_std=1.5, gnss_streak=0)
    assert mode_after(NavMode.ROW_END, turning) is NavMode.HEADLAND
    assert mode_after(NavMode.HEADLAND, turning) is NavMode.HEADLAND
    assert mode_after(NavMode.HEADLAND, replace(IN_ROW, to_start=-0.1, gnss_std=1.5)) is NavMode.ROW


def test_a_robot_stopped_before_the_last_plants_goes_on_to_the_end_unless_its_camera_is_silent() -> None:
    few_left = replace(IN_ROW, to_end=4.0, row_streak=0, row_age_s=5.0)
    assert mode_after(NavMode.ROW, few_left) is NavMode.ROW_END
    assert mode_after(NavMode.ROW, replace(few_left, looks=False)) is NavMode.ROW
    assert mode_after(NavMode.ROW, replace(few_left, to_end=8.0)) is NavMode.ROW


def test_on_the_way_to_the_next_row_gnss_does_not_move_the_path_off_the_row_just_left() -> None:
    assert mode_after(NavMode.ROW_END, LEFT_ROW) is NavMode.GNSS_PATH
    assert mode_after(NavMode.ROW_END, replace(LEFT_ROW, row_follows=True)) is NavMode.ROW_END


def test_out_of_a_row_gnss_takes_over_wherever_it_is_sure() -> None:
    for segment in (SegmentKind.EXIT, SegmentKind.HEADLAND, SegmentKind.ROAD):
        assert mode_after(NavMode.HEADLAND, replace(LEFT_ROW, segment=segment)) is NavMode.GNSS_PATH
    assert mode_after(NavMode.HEADLAND, replace(LEFT_ROW, gnss_std=0.3)) is NavMode.HEADLAND


def test_the_row_is_left_on_the_straight_before_the_turn_and_not_in_it() -> None:
    no_fix = replace(LEFT_ROW, gnss_streak=0, turn_follows=True)
    assert mode_after(NavMode.ROW_END, no_fix) is NavMode.HEADLAND
    assert mode_after(NavMode.ROW_END, replace(no_fix, to_end=-0.5)) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(no_fix, turn_follows=False)) is NavMode.ROW_END


def test_on_the_straight_the_row_is_not_left_while_the_camera_sees_its_end_ahead() -> None:
    sees_more = replace(LEFT_ROW, gnss_streak=0, turn_follows=True, seen_end=3.1, row_age_s=0.1)
    assert mode_after(NavMode.ROW_END, sees_more) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(sees_more, row_age_s=4.0)) is NavMode.HEADLAND


def test_out_of_a_turn_the_camera_takes_over_at_the_entrance() -> None:
    assert mode_after(NavMode.HEADLAND, replace(BEFORE_ROW, to_start=0.1)) is NavMode.HEADLAND
    assert mode_after(NavMode.HEADLAND, replace(IN_ROW, to_start=-0.1)) is NavMode.ROW
    assert mode_after(NavMode.HEADLAND, replace(IN_ROW, to_start=-0.1, row_streak=0)) is NavMode.HEADLAND


def test_reversing_out_begins_on_the_rear_camera() -> None:
    back = replace(IN_ROW, to_start=-0.5, to_end=59.5)
    assert mode_after(NavMode.ROW_END, back) is NavMode.ROW


def test_every_switch_says_why() -> None:
    for before, facts in product(NavMode, (OPEN_ROAD, BEFORE_ROW, IN_ROW, AT_END, LEFT_ROW)):
        after, reason = select_mode(before, facts, PARAMS)
        assert (reason is not None) == (after is not before)


def test_the_same_facts_never_switch_back_and_forth() -> None:
    for before, facts in product(NavMode, (OPEN_ROAD, BEFORE_ROW, IN_ROW, AT_END, LEFT_ROW)):
        modes = [before]
        for _ in range(4):
            modes.append(mode_after(modes[-1], facts))
        assert modes[-1] is modes[-2]


ON_MAP: dict[str, Any] = {"map_streak": 10, "map_age_s": 0.1}


def test_the_3d_map_takes_over_where_gnss_has_no_fix() -> None:
    no_fix = replace(OPEN_ROAD, gnss_streak=0, gnss_std=0.05)
    assert mode_after(NavMode.GNSS_PATH, no_fix) is NavMode.GNSS_PATH
    assert mode_after(NavMode.GNSS_PATH, replace(no_fix, **ON_MAP)) is NavMode.MAP
    assert mode_after(NavMode.GNSS_PATH, replace(no_fix, **ON_MAP, gnss_std=0.3)) is NavMode.GNSS_PATH
    assert mode_after(NavMode.GNSS_PATH, replace(OPEN_ROAD, **ON_MAP)) is NavMode.GNSS_PATH
    assert mode_after(NavMode.MAP, OPEN_ROAD) is NavMode.GNSS_PATH


def test_the_3d_map_leads_through_a_row_only_if_the_row_lies_where_it_is_drawn() -> None:
    gone = replace(IN_ROW, row_streak=0, row_age_s=0.4, gnss_std=0.03, **ON_MAP)
    assert mode_after(NavMode.ROW, gone) is NavMode.ROW
    assert mode_after(NavMode.ROW, replace(gone, map_leads=True)) is NavMode.MAP
    assert mode_after(NavMode.MAP, replace(IN_ROW, row_streak=5, row_age_s=0.1)) is NavMode.ROW


def test_gnss_does_not_take_over_from_the_map_inside_a_row() -> None:
    inside = replace(IN_ROW, row_streak=0, row_age_s=5.0, gnss_std=0.02, gnss_streak=100, map_leads=True, **ON_MAP)
    assert mode_after(NavMode.MAP, inside) is NavMode.MAP


def test_the_3d_map_takes_the_robot_from_the_row_to_the_road_without_waiting_for_gnss() -> None:
    left = replace(LEFT_ROW, gnss_std=0.03, gnss_streak=0)
    assert mode_after(NavMode.ROW_END, left) is NavMode.ROW_END
    assert mode_after(NavMode.ROW_END, replace(left, **ON_MAP)) is NavMode.MAP

"""A trunk's address is its row, its side and its number from the row's start."""

from __future__ import annotations

import pytest

from navcore.maps.site_map import Row
from navcore.maps.trunk_map import MappedTrunk, TrunkMap, trunks_of_row

NORTH = Row(id="7", start=(10.0, 5.0), end=(10.0, 45.0), width=3.0)


def trunk(name: str, x: float, y: float) -> MappedTrunk:
    return MappedTrunk(id=name, x=x, y=y, std=0.02, diameter=0.1)


def test_trunks_count_from_the_start_of_the_row_on_each_side() -> None:
    known = TrunkMap(
        trunks=(trunk("c", 8.6, 20.0), trunk("a", 8.5, 6.0), trunk("b", 11.4, 6.2), trunk("d", 8.4, 30.0))
    )
    left_1, left_2, left_3, right_1 = trunks_of_row(known, NORTH)
    assert [t.trunk.id for t in (left_1, left_2, left_3, right_1)] == ["a", "c", "d", "b"]
    assert (left_2.number, left_2.of, left_2.side) == (2, 3, 1)
    assert left_2.along == pytest.approx(15.0)  # m
    assert left_2.lateral == pytest.approx(1.4)  # m
    assert right_1.name == "right trunk 1 of 1"


def test_a_trunk_between_two_rows_is_one_of_both() -> None:
    east = Row(id="8", start=(13.0, 5.0), end=(13.0, 45.0), width=3.0)
    shared = TrunkMap(trunks=(trunk("s", 11.5, 20.0),))
    assert [t.side for t in trunks_of_row(shared, NORTH)] == [-1]
    assert [t.side for t in trunks_of_row(shared, east)] == [1]


@pytest.mark.parametrize("place", [(10.0, 20.0), (8.5, 3.9), (8.5, 46.1), (7.8, 20.0)])
def test_what_stands_on_no_line_of_the_row_is_none_of_its_trunks(place: tuple[float, float]) -> None:
    assert trunks_of_row(TrunkMap(trunks=(trunk("x", *place),)), NORTH) == ()

"""Large farms are planned about as fast as small ones, and lanes as they are recorded do no harm."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from navcore.maps.mission import Mission, RowExit
from navcore.maps.site_map import Lane, Row, SiteMap
from navcore.planning.detour import detour
from navcore.planning.free_space import FreeSpace
from navcore.planning.lane_graph import LaneGraph
from navcore.planning.mission_planner import draft_mission, mission_for_row, plan_mission
from navcore.planning.params import PlanningParams
from navcore.vehicle import PAPER_A
from tests.navcore.planning.farms import farm

PARAMS = PlanningParams()


def processor_s(site: SiteMap, mission: Mission) -> float:
    """Time of this process alone, so that others do not count."""
    before = time.process_time()
    plan, problems = draft_mission(site, mission, PAPER_A)
    assert plan is not None
    assert not problems
    return time.process_time() - before


@pytest.mark.parametrize("row_exit", RowExit)
def test_a_thousand_rows_are_planned_in_about_a_second(row_exit: RowExit) -> None:
    site = farm(rows=1000, width=3.0)
    assert (
        processor_s(site, mission_for_row(site, "R500", row_exit)) < 6.0
    )  # 0.6 on one core of 2020; a busy computer may take several times that


def test_blocks_without_lanes_are_gone_round_whatever_their_number() -> None:
    """Every alley stands alone here: 1000 blocks would have 8 million ways between their corners."""
    rows = tuple(Row(id=f"R{n}", start=(n * 7.0, 0.0), end=(n * 7.0, 60.0), width=3.0) for n in range(1000))
    site = replace(farm(), rows=rows, lanes=())
    way = detour(FreeSpace(site, PAPER_A, PARAMS), (3500.0, -10.0), (3500.0, 70.0))
    assert way
    assert len(way) < 10


def test_wide_alleys_are_no_gap_to_drive_through() -> None:
    site = replace(farm(rows=6, width=5.0), lanes=())
    way = detour(FreeSpace(site, PAPER_A, PARAMS), (10.0, -10.0), (10.0, 70.0))
    assert way
    assert all(x < -2.5 or x > 27.5 or not 0.0 < y < 60.0 for x, y in way)


def test_a_lane_recorded_by_gnss_is_driven_like_one_drawn() -> None:
    """Ten centimetres a step, some centimetres of noise: hundreds of corners too sharp for any robot."""
    site = farm()
    noise = np.random.default_rng(3).normal(0.0, 0.02, (400, 2))
    recorded = tuple((-24 + 0.1 * n + dx, -6 + dy) for n, (dx, dy) in enumerate(noise.tolist()))
    lanes = (replace(site.lanes[0], points=recorded),)
    mission = mission_for_row(replace(site, lanes=lanes), "R2", RowExit.REVERSE)
    assert len(mission.outbound) < 6
    plan_mission(replace(site, lanes=lanes), mission, PAPER_A)


def test_a_lane_that_is_a_point_is_no_lane() -> None:
    graph = LaneGraph((Lane(id="a", points=((1.0, 1.0), (1.0, 1.0))),), 3.0)
    assert graph.empty
    site = replace(farm(), lanes=(Lane(id="a", points=((1.0, -9.0), (1.0, -9.0), (1.0, -9.0))),))
    assert mission_for_row(site, "R2", RowExit.REVERSE).outbound == ()

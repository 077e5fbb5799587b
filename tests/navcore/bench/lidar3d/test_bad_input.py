"""The arithmetic of the bad input's figures, on drives whose events are known; and files that are no map."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.figure import Figure
from navcore.bench.lidar3d.bad_input import CASES, BadInput, Heard, case_figures, file_figures, heard
from navcore.bench.lidar3d.localization_drive import Placed
from navcore.bench.lidar3d.ndt_scans import NdtScanParams, ndt_scans
from navcore.geometry.se2 import SE2
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Datum
from navcore.messages import MapMatch, MatchState
from navcore.sim.block_drive import START_NS, BlockDriveParams
from navcore.sim.pear_block import BlockSize, tuning_block

TURN_NS = 100_000_000
LEANS = BadInput(name="leans", said=("lidar3d_leans",), from_s=1.0)
WELL = BadInput(name="well", said=())


def turn(k: int, off: float, *events: str) -> Heard:
    """The k-th; the match lies `off` m to the left and is believed."""
    match = MapMatch(stamp_ns=0, state=MatchState.MATCHED, y=off)
    placed = Placed(
        stamp_ns=START_NS + k * TURN_NS, truth=SE2(), rtk=None, fused=None, match=match, T_odom_base=SE2(),
        believed=True,
    )  # fmt: skip
    return Heard(placed=placed, events=frozenset(events))


def figures(case: BadInput, *drives: list[Heard]) -> dict[str, Figure]:
    return {f.figure.partition(": ")[2]: f for f in case_figures(case, drives, 1)}


def test_what_is_said_counts_from_the_fault_on_and_not_before() -> None:
    found = figures(LEANS, [turn(k, 0.02, *(["lidar3d_leans"] if k in (5, 30) else [])) for k in range(40)])
    assert (found["noticed and said"].value, found["noticed and said"].ok) == (1.0, True)
    assert found["said after"].value == pytest.approx(2.0)  # s
    assert found["lateral mean of believed matches"].value == pytest.approx(0.02)  # m


def test_what_is_never_said_fails_and_so_does_another_word() -> None:
    found = figures(LEANS, [turn(k, 0.0, "lidar3d_drops") for k in range(40)], [turn(1, 0.0, "lidar3d_leans")])
    assert (found["noticed and said"].value, found["noticed and said"].ok) == (0.0, False)
    assert found["said after"].value is None


def test_a_false_word_on_a_healthy_drive_fails_and_a_start_is_none() -> None:
    assert figures(WELL, [turn(0, 0.0, "map_unsure", "no_position")])["drives without a word"].ok is True
    assert figures(WELL, [turn(9, 0.0, "map_outdated")])["drives without a word"].ok is False


def test_a_wrong_place_that_was_believed_is_counted() -> None:
    found = figures(LEANS, [turn(k, 0.5 if k < 10 else 0.0) for k in range(40)])
    assert found["believed matches within 0.3 m"].value == pytest.approx(0.75)
    assert found["believed matches within 0.3 m"].ok is False


def test_cut_off_changed_and_foreign_map_files_are_refused_with_a_reason() -> None:
    ndt_map = NdtMap(datum=Datum(lat_deg=36.0, lon_deg=119.0, height_m=30.0))
    ndt_map.add(np.random.default_rng(1).uniform(-5.0, 5.0, (2000, 3)))
    assert [(f.value, f.ok) for f in file_figures(ndt_map, 1)] == [(1.0, True)] * 3


@pytest.mark.slow
def test_a_lidar_that_sees_nothing_is_said_in_a_driven_block() -> None:
    size = BlockSize(alleys=1, length=12.0)
    ndt_map = ndt_scans(NdtScanParams(block=1, tuning=True, size=size, scans=0)).ndt_map
    case = next(c for c in CASES if c.name == "empty scans")
    drive = list(heard(tuning_block(1, size), case, ndt_map, 115, 3, BlockDriveParams()))
    found = {f.figure: f for f in case_figures(case, [drive], 3)}
    assert found["empty scans: noticed and said"].ok is True
    after = found["empty scans: said after"].value
    assert after is not None
    assert after < 0.5  # s

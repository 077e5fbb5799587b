"""What is taken for the row that is meant."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from navcore.geometry.se2 import SE2
from navcore.localization.row_line import RowLine
from navcore.messages import CameraName, RowObservation
from navcore.mission.evidence import Doubt, RowEvidence, RowEvidenceParams

ROW = RowLine(0.0, 0.0, 0.0)
SEEN = RowObservation(
    stamp_ns=1, camera=CameraName.FRONT, valid=True, reason="", offset=0.1, heading=0.02, width=3.1, quality=0.9,
)  # fmt: skip


def judged(seen: RowObservation, *expected: SE2) -> bool:
    return RowEvidence(RowEvidenceParams()).judge(seen, ROW, expected or (SE2(5.0, -0.1, 0.0),), 3.0)


def test_a_row_a_quarter_of_a_width_away_is_another_one_where_its_place_is_well_known() -> None:
    """A fit that began between two rows, in a turn, once took the robot to the wrong one."""
    evidence, expected = RowEvidence(RowEvidenceParams()), (SE2(5.0, 0.7, 0.0),)
    assert evidence.judge(SEEN, ROW, expected, 3.0, Doubt(0.45, 0.05))
    assert not evidence.judge(SEEN, ROW, (SE2(5.0, -0.1, 0.1),), 3.0, Doubt(0.45, 0.03))
    assert not evidence.judge(SEEN, ROW, expected, 3.0, Doubt(0.15, 0.05))


def test_the_row_where_it_is_expected_is_the_one_that_is_meant() -> None:
    assert judged(SEEN)


@pytest.mark.parametrize(
    "other",
    [
        {"offset": 1.6},
        {"heading": 0.3},
        {"width": 6.0},
        {"width": 1.5},
        {"quality": 0.1},
        {"curvature": 0.8},
        {"curvature": -0.8},
        {"curvature": math.nan},
        {"valid": False},
        {"carried": 1.1},
    ],
)
def test_a_row_elsewhere_askew_bent_of_another_width_or_out_of_sight_is_not(other: dict[str, Any]) -> None:
    assert not judged(replace(SEEN, **other))


def test_all_who_know_the_place_must_agree() -> None:
    assert not judged(SEEN, SE2(5.0, -0.1, 0.0), SE2(5.0, 1.5, 0.0))

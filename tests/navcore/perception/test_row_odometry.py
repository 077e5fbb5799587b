"""Wheels slip; the plants beside the row stay where they are."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, RowObservation
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from tests.navcore.perception.corridor_views import boxes_at, corridor_feet, picture

Floats = NDArray[np.float64]

FRONT = robot_camera()
STEP = 0.05


def driven(
    way: float = 1.0,
    *,
    metres: float = 4.0,
    told: float = 1.0,
    scatter: float = 0.0,
    weeds: float = 0.015,
    **orchard: object,
) -> list[RowObservation]:
    """Along a corridor, ahead or back (`way` -1); the wheels tell `told` times what is driven.

    `scatter` of feet in every picture, m; `weeds` hide them so far up, m.
    """
    detector, rng = Told(()), np.random.default_rng(3)
    perception = RowPerception(FRONT, detector, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0, pitch=0.0, roll=0.0)
    rows = []
    for k in range(round(metres / STEP) + 1):
        feet = corridor_feet(SE2(way * k * STEP, 0.0, 0.0), lines=1, **orchard)  # type: ignore[arg-type]
        seen = hidden(feet, weeds) + rng.normal(0.0, 1e-9 + scatter, feet.shape)
        detector.objects = boxes_at(FRONT, seen)
        motion = SE2(way * STEP * told, 0.0, 0.0) if k else None
        rows.append(perception.process(picture(FRONT), k, CameraName.FRONT, prior=prior, motion=motion).row)
    return rows


def hidden(feet: Floats, weeds: float) -> Floats:
    """Where on the ground feet (N, 2) seem to stand whose lowest part weeds hide, m."""
    below = np.array((FRONT.x, FRONT.y))
    return np.asarray(below + (feet - below) * FRONT.z / (FRONT.z - weeds))


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("told", [1.0, 1.1, 0.95])
def test_the_plants_tell_what_was_driven_whatever_the_wheels_say(way: float, told: float) -> None:
    last = driven(way, told=told)[-1]
    assert last.driven == pytest.approx(way * 4.0, abs=0.06)  # m; 0.2 or 0.4 by the wheels
    assert last.driven_since_ns == 0


@pytest.mark.parametrize("weeds", [0.0, 0.03])
def test_a_centimetre_more_or_less_of_weeds_is_a_hundredth_of_the_way(weeds: float) -> None:
    assert driven(-1.0, told=1.1, weeds=weeds)[-1].driven == pytest.approx(-4.0, abs=0.18)  # m; 0.4 by the wheels


def test_feet_that_scatter_by_centimetres_do_not_carry_the_robot_off() -> None:
    assert driven(-1.0, told=1.1, scatter=0.03)[-1].driven == pytest.approx(-4.0, abs=0.12)  # m


def test_where_no_plant_is_near_the_wheels_slip_as_they_did() -> None:
    """Plants end 6.5 m ahead of where the robot begins; the row is carried on for a metre."""
    rows = [row for row in driven(metres=10.0, told=1.15, end=6.5) if row.driven is not None]
    last = [row.driven or 0.0 for row in rows[-2:]]
    assert last[1] - last[0] == pytest.approx(STEP, abs=0.04 * STEP)  # m; 0.15 of it by the wheels


def test_a_row_seen_anew_counts_anew() -> None:
    detector = Told(boxes_at(FRONT, corridor_feet(SE2(), lines=1)))
    perception = RowPerception(FRONT, detector, RowPerceptionParams())
    prior = RowPrior(offset=0.0, heading=0.0, std=0.3, width=3.0, pitch=0.0, roll=0.0)
    for stamp_ns, motion in ((1, None), (2, SE2(0.1, 0.0, 0.0)), (3, None)):
        row = perception.process(picture(FRONT), stamp_ns, CameraName.FRONT, prior=prior, motion=motion).row
    assert (row.driven, row.driven_since_ns) == (0.0, 3)

"""A drive recorded elsewhere becomes one that our robot can follow."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.planning.recorded_drive import Stretch, followable_drive, plan_for_drive
from navcore.vehicle import PAPER_A

Floats = NDArray[np.float64]
TIGHTEST = 1.0 / 0.85


def nearest(points: Floats, drive: tuple[Stretch, ...]) -> Floats:
    """Distance of each point from the drive, m."""
    line = np.vstack([stretch.course.points for stretch in drive])
    return np.array([np.hypot(*(line - point).T).min() for point in points])


@pytest.mark.parametrize("seed", [1, 2])
def test_noise_and_jumps_are_taken_out(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = np.linspace(0.0, 60.0, 3000)
    true = np.column_stack((t, 3.0 * np.sin(t / 6.0)))
    recorded = true + 0.02 * rng.standard_normal(true.shape)
    recorded[rng.choice(3000, 20)] += rng.uniform(-1.0, 1.0, (20, 2))
    (stretch,) = followable_drive(recorded)
    assert not stretch.reverse
    assert nearest(true[::10], (stretch,)).mean() < 0.10
    assert np.abs(stretch.course.curvatures).max() < TIGHTEST


def test_a_turn_on_the_spot_becomes_a_swing_in_reverse() -> None:
    out = np.column_stack((np.arange(0.0, 20.0, 0.1), np.zeros(200)))
    home = np.column_stack((out[::-1, 0], np.full(200, 0.1)))
    there, swing, back = followable_drive(np.vstack((out, home)))
    assert [s.reverse for s in (there, swing, back)] == [False, True, False]
    assert there.course.points[:, 0].max() > 20.5
    for a, b in ((there, swing), (swing, back)):
        np.testing.assert_allclose(a.course.points[-1], b.course.points[0], atol=1e-6)
        turn = math.remainder(a.course.headings[-1] - b.course.headings[0], 2 * math.pi)
        assert abs(abs(turn) - math.pi) < 0.12
    assert np.abs(back.course.points[20:, 1] - 0.1)[back.course.points[20:, 0] < 15.0].max() < 0.1


def test_the_recorded_drive_through_riseholme_can_be_followed(shared_data: Path) -> None:
    table = np.genfromtxt(shared_data / "riseholme" / "tue02sep.csv", delimiter=",", names=True)
    recorded = np.column_stack((table["x_m"], table["y_m"]))
    jumps = np.hypot(*np.diff(recorded, axis=0).T) > 0.5
    assert jumps.sum() == 152
    drive = followable_drive(recorded)
    assert [s.reverse for s in drive] == [False, True, False]
    off = nearest(recorded[::10], drive)
    assert off.mean() < 0.10
    assert np.percentile(off, 95) < 0.35
    assert sum(s.course.length for s in drive) == pytest.approx(505.0, abs=10.0)
    for stretch in drive:
        assert np.diff(stretch.course.s).max() < 0.15
        assert np.abs(stretch.course.curvatures).max() < TIGHTEST
    plan = plan_for_drive(
        drive, mission_id="drive", name="Riseholme", datum=(53.26810042662116, -0.5244249078498293, 0.0),
        vehicle=PAPER_A,
    )  # fmt: skip
    assert [len(s.points) for s in plan.segments] == [len(s.speeds) for s in plan.segments]
    assert max(max(s.speeds) for s in plan.segments) <= 0.8


def test_a_drive_without_sound_positions_is_refused() -> None:
    with pytest.raises(InputError, match="five"):
        followable_drive(np.zeros((100, 2)))
    with pytest.raises(NotFiniteError):
        followable_drive(np.array([(0.0, math.nan)] * 10))

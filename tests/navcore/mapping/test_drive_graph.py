"""What a drive's fixes weigh together: as much as they tell anew."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive_graph import DriveGraphParams, fix_terms
from navcore.mapping.lidar3d.keyframe import Keyframe, PlacedFix

PARAMS = DriveGraphParams(lasting_s=60.0)


def keyframe(second: float, fixed: bool = True) -> Keyframe:
    fix = PlacedFix(antenna=np.zeros(3), place=np.zeros(3), std=np.ones(3), quality=4)
    return Keyframe(
        stamp_ns=round(second * 1e9), driven=second, T_odom_base=SE3.identity(), covariance=np.eye(6),
        up=np.array((0.0, 0.0, 1.0)), points=np.zeros((0, 3), np.float32), intensities=np.zeros(0, np.uint8),
        fix=fix if fixed else None, scans=1, lost=0, score=1.0,
    )  # fmt: skip


def weight(seconds: np.ndarray) -> float:
    return sum(term.share for term in fix_terms([keyframe(s) for s in seconds], PARAMS))


def test_twice_as_many_fixes_in_the_same_time_weigh_no_more() -> None:
    few, many = weight(np.arange(0.0, 600.0, 2.0)), weight(np.arange(0.0, 600.0, 1.0))
    assert few == pytest.approx(10.0, rel=0.1)  # of 60 s each
    assert many == pytest.approx(few, rel=0.05)


def test_a_fix_after_a_long_way_without_one_counts_almost_in_full() -> None:
    drive = [keyframe(0.0), *(keyframe(float(s), fixed=False) for s in range(1, 3600)), keyframe(3600.0)]
    terms = list(fix_terms(drive, PARAMS))
    assert [term.i for term in terms] == [0, 3600]
    assert terms[1].share > 0.98

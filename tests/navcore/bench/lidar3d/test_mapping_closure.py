"""A map in which a line of posts stands twice is told from one in which it stands once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from navcore.bench.lidar3d.block_run import BlockRun
from navcore.bench.lidar3d.mapping_closure import _closed, _fixes_until, closure_figures
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.drive import Drive, Rig
from navcore.mapping.lidar3d.keyframe import Keyframe, PlacedFix
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, tuning_block

POSTS = tuning_block(0, BlockSize(alleys=1, length=36.0)).trellised(Season.DORMANT).posts
RIG = Rig()


def truth(count: int = 14) -> list[SE3]:
    """Along one line of posts and back again, 0.5 m beside it."""
    line = POSTS.axis_at(1.0)[POSTS.lines == 0]
    shares = np.linspace(0.0, 1.0, count // 2)
    way = [line[0] + share * (line[-1] - line[0]) for share in (*shares, *shares[::-1])]
    return [SE3.from_rpy((float(p[0]) + 0.5, float(p[1]) + 0.5, 0.0)) for p in way]


def keyframes(poses: list[SE3]) -> list[Keyframe]:
    """Each sees every post as a thin upright on its axis, less what the map adds behind what is seen."""
    made = []
    for k, T in enumerate(poses):
        heights = np.repeat(np.linspace(0.35, 0.9, 12), 4)
        shafts = [POSTS.feet[i] + (POSTS.tops - POSTS.feet)[i] * (heights / (POSTS.tops - POSTS.feet)[i, 2])[:, None]
                  for i in range(len(POSTS.feet))]  # fmt: skip
        fix = PlacedFix(antenna=np.zeros(3), place=T.t, std=np.ones(3), quality=4)
        made.append(Keyframe(
            stamp_ns=k, driven=5.0 * k, T_odom_base=T, covariance=np.eye(6), up=np.array((0.0, 0.0, 1.0)),
            points=T.inverse().apply(np.concatenate(shafts)).astype(np.float32), intensities=np.zeros(0, np.uint8),
            fix=fix, scans=1, lost=0, score=1.0,
        ))  # fmt: skip
    return made


def run(poses: list[SE3]) -> BlockRun:
    drive = Drive(name="U", rig=RIG, datum=None, sensed=list)
    return BlockRun(drive=drive, truth=dict(enumerate(poses)), posts=POSTS)


def test_legs_that_are_laid_apart_show_posts_that_stand_twice() -> None:
    poses = truth()
    right = _closed("right", run(poses), keyframes(poses), poses)
    assert right.apart.mean() < 0.03  # m: seen from two sides, each post's face is another
    assert right.poses_off.max() == 0.0
    assert len(right.far.errors) > 0
    aside = SE3.from_rpy((0.0, 0.2, 0.0))
    apart = _closed("apart", run(poses), keyframes(poses), [*poses[:7], *(aside @ T for T in poses[7:])])
    assert apart.apart.mean() == pytest.approx(0.2, abs=0.04)  # m
    assert apart.poses_off.max() == pytest.approx(0.2)  # m
    figures = {f.figure: f.value for f in closure_figures([(Season.DORMANT, apart)])}
    assert figures["long U, dormant, apart: keyframes off the truth, largest"] == pytest.approx(0.2)


def test_fixes_end_where_the_begin_ends(tmp_path: Path) -> None:
    poses = truth()
    work = WorkFolder(tmp_path / "all", "U", "bench")
    for keyframe in keyframes(poses):
        work.append(keyframe)
    fewer = _fixes_until(work, 20.0, tmp_path / "few", run(poses))
    assert [k.fix is not None for k in fewer] == [k.driven < 20.0 for k in work]

"""A pose graph holds a drive together: truth stays, drift is pulled straight, a lie changes next to nothing."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.errors import ContractError, NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.mapping.pose_graph import rotations
from navcore.mapping.pose_graph.linear import LevelTerms, PositionTerms, RelativeTerms
from navcore.mapping.pose_graph.pose_graph import PoseGraph, Solution
from navcore.mapping.pose_graph.poses import Poses
from navcore.mapping.pose_graph.terms import LevelTerm, PositionTerm, RelativeTerm

Floats = NDArray[np.float64]
STEP_STD = np.array((0.02, 0.02, 0.02, 0.002, 0.002, 0.002))  # m, rad
STEP = np.diag(STEP_STD**-2)
LOOP = np.diag(np.array((0.03, 0.03, 0.03, 0.005, 0.005, 0.005)) ** -2.0)
ANTENNA = np.array((0.1, 0.0, 1.2))
seeds = st.integers(0, 10_000)


def u_shaped(seed: int = 0) -> list[SE3]:
    """Down one row of 40 m, round, and back up the next, 6 m away, on bumpy ground."""
    rng = np.random.default_rng(seed)
    xy = [(float(x), 0.0, 0.0) for x in range(40)]
    xy += [(40.0 + 3.0 * math.sin(a), 3.0 - 3.0 * math.cos(a), a) for a in np.linspace(0.2, math.pi - 0.2, 9)]
    xy += [(float(x), 6.0, math.pi) for x in range(40, -1, -1)]
    lean = 0.02 * rng.standard_normal((len(xy), 2))
    return [
        SE3.from_rpy((x, y, 0.01 * x), roll=float(r), pitch=float(p), yaw=yaw)
        for (x, y, yaw), (r, p) in zip(xy, lean, strict=True)
    ]


def measured(truth: list[SE3], seed: int, scale: float) -> list[RelativeTerm]:
    rng = np.random.default_rng((seed, 1))
    return [
        RelativeTerm(
            i=i, j=i + 1, information=STEP,
            T_i_j=noisy(truth[i].inverse() @ truth[i + 1], scale * STEP_STD * rng.standard_normal(6)),
        )
        for i in range(len(truth) - 1)
    ]  # fmt: skip


def noisy(T: SE3, step: Floats) -> SE3:
    moved = SE3.exp(step)
    return SE3(moved.R @ T.R, T.t + moved.t)


def chained(first: SE3, steps: list[RelativeTerm]) -> list[SE3]:
    poses = [first]
    for step in steps:
        poses.append(poses[-1] @ step.T_i_j)
    return poses


def worst(found: Solution, truth: list[SE3]) -> float:
    """m."""
    return float(np.linalg.norm(found.poses.t - Poses.of(truth).t, axis=1).max())


def loop(truth: list[SE3], i: int, j: int) -> RelativeTerm:
    return RelativeTerm(i=i, j=j, T_i_j=truth[i].inverse() @ truth[j], information=LOOP, loop=True)


def neighbours(truth: list[SE3]) -> list[RelativeTerm]:
    """Loops between the two rows, each 6 m wide."""
    return [loop(truth, k, len(truth) - 1 - k) for k in range(0, 40, 4)]


def position(T: SE3, i: int, lie: Floats | float = 0.0, std: float = 0.02) -> PositionTerm:
    return PositionTerm(i=i, antenna=ANTENNA, place=T.apply(ANTENNA) + lie, information=np.eye(3) / std**2)


def graph_of(start: list[SE3], *terms: RelativeTerm | PositionTerm | LevelTerm) -> PoseGraph:
    graph = PoseGraph(start)
    for term in terms:
        graph.add(term)
    return graph


@given(seed=seeds)
@settings(max_examples=10, deadline=None)
def test_a_graph_without_noise_stays(seed: int) -> None:
    truth = u_shaped(seed)
    places = [position(truth[i], i) for i in range(0, 80, 7)]
    found = graph_of(truth, *measured(truth, seed, 0.0), *neighbours(truth), *places).solve()
    assert worst(found, truth) < 1e-7  # m
    assert found.converged
    assert found.loop_weights.min() > 0.999
    assert found.position_weights.min() > 0.999


@given(seed=seeds)
@settings(max_examples=8, deadline=None)
def test_loops_pull_a_drift_straight(seed: int) -> None:
    truth = u_shaped(seed)
    steps = measured(truth, seed, 1.0)
    drifted = chained(truth[0], steps)
    ends = float(np.linalg.norm(drifted[-1].t - truth[-1].t))
    found = graph_of(drifted, *steps, *neighbours(truth)).solve()
    closed = float(np.linalg.norm(found.poses.t[-1] - truth[-1].t))
    assert closed < 0.10  # m: the last loop ties it to the first pose
    assert closed < max(0.5 * ends, 0.05)
    assert found.loop_weights.min() > 0.1


def test_a_loop_far_beyond_its_own_gate_still_pulls_when_the_drive_allows_it() -> None:
    truth = u_shaped(3)
    bend = SE3.from_rpy((0.0, 0.0, 0.0), yaw=0.0016)  # a gyro off by 0.1 deg a metre
    steps = [
        RelativeTerm(i=k, j=k + 1, T_i_j=bend @ step.T_i_j, information=STEP)
        for k, step in enumerate(measured(truth, 3, 0.0))
    ]
    drifted = chained(truth[0], steps)
    assert np.linalg.norm(drifted[-1].t - truth[-1].t) > 2.0  # m, more than sixty sigmas of a loop
    found = graph_of(drifted, *steps, *neighbours(truth)).solve()
    assert np.linalg.norm(found.poses.t[-1] - truth[-1].t) < 0.15  # m
    assert found.loop_weights.min() > 0.2


@given(seed=seeds, at=st.integers(0, 35), off=st.sampled_from([-3.0, 3.0, 6.0]))
@settings(max_examples=8, deadline=None)
def test_one_lying_loop_changes_next_to_nothing(seed: int, at: int, off: float) -> None:
    truth = u_shaped(seed)
    steps = measured(truth, seed, 0.5)
    start, honest = chained(truth[0], steps), neighbours(truth)
    true = loop(truth, at, len(truth) - 1 - at)
    lie = RelativeTerm(
        i=true.i, j=true.j, T_i_j=noisy(true.T_i_j, np.array((off, 0, 0, 0, 0, 0))), information=LOOP, loop=True
    )
    without = graph_of(start, *steps, *honest).solve()
    lied_to = graph_of(start, *steps, *honest, lie).solve()
    apart = np.linalg.norm(lied_to.poses.t - without.poses.t, axis=1).max()
    assert apart < 0.01  # m; a tree further along is 3 m away
    assert lied_to.loop_weights[-1] < 1e-3


@given(seed=seeds)
@settings(max_examples=8, deadline=None)
def test_a_receiver_that_lies_by_two_metres_for_a_while_is_outvoted(seed: int) -> None:
    truth = u_shaped(seed)
    steps = measured(truth, seed, 0.3)
    honest = [position(T, i) for i, T in enumerate(truth) if i % 2 == 0]
    lies = [position(truth[i], i, np.array((2.0, 0.0, 0.0))) for i in range(21, 31, 2)]
    found = graph_of(chained(truth[0], steps), *steps, *honest, *lies).solve()
    assert worst(found, truth) < 0.06  # m
    assert found.position_weights[-len(lies) :].max() < 0.01
    assert found.position_weights[: -len(lies)].min() > 0.3


def test_fixes_that_share_one_slow_error_do_not_stretch_a_drive() -> None:
    truth = u_shaped(5)
    steps = measured(truth, 5, 0.1)
    drifting = [position(T, i, np.array((0.3 * i / len(truth), 0.0, 0.0)), std=0.3) for i, T in enumerate(truth)]
    shared = [replace(fix, share=1.0 / 60.0) for fix in drifting]

    def stretch(fixes: list[PositionTerm]) -> float:
        found = graph_of(chained(truth[0], steps), *steps, *fixes).solve().poses.t
        return abs(float(np.linalg.norm(found[39] - found[0]) - np.linalg.norm(truth[39].t - truth[0].t)))

    assert stretch(drifting) > 0.05  # m: each is taken for news
    assert stretch(shared) < 0.02  # m


def test_without_positions_the_first_pose_stays_where_it_is() -> None:
    truth = u_shaped(1)
    steps = measured(truth, 1, 1.0)
    found = graph_of(chained(truth[0], steps), *steps, *neighbours(truth)).solve()
    assert np.array_equal(found.poses.t[0], truth[0].t)
    assert np.array_equal(found.poses.R[0], truth[0].R)


def test_a_drive_that_begins_anywhere_ends_where_its_positions_say() -> None:
    truth = u_shaped(2)
    steps = measured(truth, 2, 0.1)
    T_map_wrong = SE3.from_rpy((30.0, -12.0, 4.0), yaw=0.5)
    start = [T_map_wrong @ T for T in chained(truth[0], steps)]
    found = graph_of(start, *steps, *(position(T, i) for i, T in enumerate(truth))).solve()
    assert worst(found, truth) < 0.05  # m


def test_gravity_levels_a_drive_that_bends_upwards() -> None:
    truth = u_shaped(4)
    nose_up = SE3.from_rpy((0.0, 0.0, 0.0), pitch=-0.002)
    steps = [
        RelativeTerm(i=k, j=k + 1, T_i_j=nose_up @ s.T_i_j, information=STEP)
        for k, s in enumerate(measured(truth, 4, 0.0))
    ]
    levels = [LevelTerm(i=i, up=T.R.T[:, 2], std=0.01) for i, T in enumerate(truth)]
    start = chained(truth[0], steps)
    bent = graph_of(start, *steps).solve()
    levelled = graph_of(start, *steps, *levels).solve()
    assert worst(bent, truth) > 1.0  # m
    assert worst(levelled, truth) < 0.25  # m


@given(seed=seeds)
@settings(max_examples=10, deadline=None)
def test_jacobians_are_the_slopes_of_the_residuals(seed: int) -> None:
    rng = np.random.default_rng(seed)
    poses = Poses.of([SE3.exp(rng.uniform(-1.5, 1.5, 6)) for _ in range(2)])
    off = 0.3 * rng.standard_normal(6)
    Z = noisy(poses[0].inverse() @ poses[1], off)
    up = rng.standard_normal(3)
    for terms in (
        RelativeTerms([RelativeTerm(i=0, j=1, T_i_j=Z, information=np.eye(6))]),
        PositionTerms([PositionTerm(i=1, antenna=ANTENNA, place=rng.standard_normal(3), information=np.eye(3))]),
        LevelTerms([LevelTerm(i=1, up=up / np.linalg.norm(up), std=1.0)]),
    ):
        at = terms.at(poses)
        for n, node in enumerate(at.nodes[0]):
            for axis in range(6):
                step = np.zeros((2, 6))
                step[node, axis] = 1e-6
                slope = (terms.at(poses.moved(step)).e - terms.at(poses.moved(-step)).e)[0] / 2e-6
                assert at.J[0, :, 6 * n + axis] == pytest.approx(slope, abs=1e-5)


@given(v=st.lists(st.floats(-1.8, 1.8), min_size=3, max_size=3))
def test_log_undoes_exp(v: list[float]) -> None:
    vector = np.array([v])
    assert rotations.log(rotations.exp(vector)) == pytest.approx(vector, abs=1e-9)


def test_log_of_almost_half_a_turn_keeps_its_axis() -> None:
    vector = np.array(((math.pi - 1e-7, 0.0, 0.0), (0.0, -(math.pi - 1e-9), 0.0)))
    assert rotations.exp(rotations.log(rotations.exp(vector))) == pytest.approx(rotations.exp(vector), abs=1e-6)


def test_a_measurement_that_is_no_number_is_refused() -> None:
    graph = PoseGraph(u_shaped())
    broken = position(SE3.identity(), 0, np.array((np.nan, 0.0, 0.0)))
    with pytest.raises(NotFiniteError, match="leave it out"):
        graph.add(broken)
    with pytest.raises(NotFiniteError, match="leave such poses out"):
        PoseGraph([SE3(np.eye(3), np.full(3, np.inf))])
    with pytest.raises(ContractError, match="node 200"):
        graph.add(LevelTerm(i=200, up=np.array((0.0, 0.0, 1.0)), std=0.1))

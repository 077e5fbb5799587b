"""Posts show the side that faces the robot; scans are laid on their middles, which do not turn with it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.scan_tracker import ScanTracker, ScanTrackerParams
from navcore.mapping.lidar3d.upright_faces import UprightFaces, UprightFacesParams

Floats = NDArray[np.float64]
RADIUS = 0.05  # m
EYE = np.array((0.2, 0.0, 0.6))
POSTS = np.array([(x + 0.3 * side, side * 3.0) for x in np.arange(-12.0, 40.0, 3.0) for side in (-1.0, 1.0)])


def face(foot: Floats, eye: Floats, rng: np.random.Generator, count: int = 60) -> Floats:
    """Points (N, 3) of the side of a post that faces `eye`, as rays spread evenly over its width meet it."""
    toward = math.atan2(eye[1] - foot[1], eye[0] - foot[0])
    turned = toward + np.arcsin(rng.uniform(-1.0, 1.0, count))
    ring = foot + RADIUS * np.column_stack((np.cos(turned), np.sin(turned)))
    return np.column_stack((ring, rng.uniform(0.1, 1.4, count)))


def test_both_sides_of_a_post_are_brought_to_its_middle() -> None:
    rng, foot = np.random.default_rng(1), np.array((0.25, 0.25))
    eyes = (np.array((-6.0, 1.0, 0.6)), np.array((6.0, 1.0, 0.6)))
    sides = [face(foot, eye, rng) for eye in eyes]
    faces = UprightFaces(np.concatenate(sides))
    middles = [faces.middles(side, eye).mean(axis=0) for side, eye in zip(sides, eyes, strict=True)]
    assert abs(sides[0][:, 0].mean() - sides[1][:, 0].mean()) > 0.06  # m
    assert abs(middles[0][0] - middles[1][0]) < 0.015  # m
    assert middles[0][2] == pytest.approx(sides[0][:, 2].mean())


def test_ground_and_walls_stay_where_they_are() -> None:
    rng = np.random.default_rng(2)
    ground = np.column_stack((rng.uniform(-5.0, 5.0, (4000, 2)), 0.02 * rng.standard_normal(4000)))
    wall = np.column_stack((rng.uniform(-5.0, 5.0, 4000), np.full(4000, 5.1), rng.uniform(0.0, 2.0, 4000)))
    points = np.concatenate((ground, wall))
    assert (UprightFaces(points).middles(points, EYE) == points).all()


def test_points_above_the_robot_go_nowhere() -> None:
    post = face(np.array((0.25, 0.25)), EYE, np.random.default_rng(3))
    over = np.array((*post[0, :2], 0.6))
    assert (UprightFaces(post).middles(post[:1], over) == post[:1]).all()


def driven(behind: float) -> float:
    """How far along 16 m the tracker has a robot that passes posts, less how far it truly was, m."""
    rng, params = np.random.default_rng(4), UprightFacesParams(behind=behind)
    tracker = ScanTracker(EYE, replace(ScanTrackerParams(), faces=params))
    at = SE3.identity()
    for k in range(17):
        true = SE3.from_rpy((float(k), 0.0, 0.0))
        points = true.inverse().apply(_seen(true.apply(EYE[None])[0], rng))
        guess = at @ SE3.from_rpy((1.0, 0.0, 0.0)) if k else at
        at = tracker.place(points, guess).T_odom_base
        tracker.add(_keyframe(k, at, points))
    return float(at.t[0]) - 16.0


def test_a_robot_that_passes_posts_is_not_held_back_by_their_faces() -> None:
    held_back, free = driven(behind=0.0), driven(behind=0.75 * RADIUS)
    assert held_back < -0.01  # m
    assert abs(free) < 0.4 * abs(held_back)


def _seen(eye: Floats, rng: np.random.Generator) -> Floats:
    """Posts and ground within 12 m of the eye."""
    near = POSTS[np.hypot(*(POSTS - eye[:2]).T) < 12.0]
    ground = np.column_stack((eye[:2] + rng.uniform(-8.0, 8.0, (1500, 2)), 0.01 * rng.standard_normal(1500)))
    return np.concatenate([*(face(foot, eye, rng) for foot in near), ground])


def _keyframe(k: int, T: SE3, points: Floats) -> Keyframe:
    return Keyframe(
        stamp_ns=k, driven=float(k), T_odom_base=T, covariance=np.eye(6), up=np.array((0.0, 0.0, 1.0)),
        points=points.astype(np.float32), intensities=np.zeros(len(points), np.uint8), fix=None, scans=1, lost=0,
        score=1.0,
    )  # fmt: skip

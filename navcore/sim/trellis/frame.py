"""Arms and wires of a Y-trellis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.posts import Posts
from navcore.sim.trellis.shapes import Shapes, rods

Floats = NDArray[np.float64]

_WIRE_PIECE_M = 0.75


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameParams:
    """Shape of the Y, m. Paper C: Y-trellis pear, 3 m high; the rest is chosen.

    Attributes:
        fork: height at which the two arms leave the post, 0.3 to 2.
        top: height of the arms' ends, above `fork`, to 5. spread: how far out they reach to either side, 0 to 3; 0
            is a single wall.
        arm_radius: 0.01 to 0.1.
        wires: places of the wires along an arm, shares from fork (0) to end (1), each side.
        low_wire: height of the wire along the posts, 0.2 to 2.
        wire_radius: 0.0005 to 0.005 (2.5 mm galvanised). sag: in the middle between two posts, 0 to 0.2.
        lean_std_deg: 1-sigma of the posts' lean each way, 0 to 5.
    """

    fork: float = 1.0
    top: float = 3.0
    spread: float = 1.35
    arm_radius: float = 0.03
    wires: tuple[float, ...] = (0.2, 0.47, 0.73, 0.98)
    low_wire: float = 0.7
    wire_radius: float = 0.00125
    sag: float = 0.02
    lean_std_deg: float = 0.8

    def __post_init__(self) -> None:
        bounds = {
            "fork": (0.3, 2.0), "top": (self.fork + 0.1, 5.0), "spread": (0.0, 3.0), "arm_radius": (0.01, 0.1),
            "low_wire": (0.2, 2.0), "wire_radius": (0.0005, 0.005), "sag": (0.0, 0.2), "lean_std_deg": (0.0, 5.0),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            if not low <= getattr(self, name) <= high:
                value = getattr(self, name)
                raise InputError(f"The trellis' {name} must lie between {low} and {high}, but is {value}.")


def arm_rods(posts: Posts, lefts: Floats, params: FrameParams) -> Shapes:
    """Both arms of every post that stands in a line; `lefts` (L, 2) is the unit vector left of each line."""
    held = posts.standing & (posts.lines >= 0)
    fork = posts.axis_at(params.fork)[held]
    begin = np.tile(fork, (2, 1))
    end = np.concatenate([_along_arm(posts, lefts, params, side, 1.0)[held] for side in (1.0, -1.0)])
    radius = np.full(len(begin), params.arm_radius)
    return rods(begin, end, radius, radius * 0.8, Part.ARM)


def wire_rods(built: Posts, lefts: Floats, params: FrameParams) -> Shapes:
    """All wires, strung when the posts were new: they stay where a post is gone."""
    courses = [built.axis_at(params.low_wire)]
    courses += [_along_arm(built, lefts, params, side, share) for side in (1.0, -1.0) for share in params.wires]
    spans = [_spans(built, course, len(lefts)) for course in courses]
    pieces = np.concatenate([_hung(begin, end, params.sag) for begin, end in spans])
    radius = np.full(len(pieces), params.wire_radius)
    return rods(pieces[:, :3], pieces[:, 3:], radius, radius, Part.WIRE)


def _along_arm(posts: Posts, lefts: Floats, params: FrameParams, side: float, share: float) -> Floats:
    """Points (P, 3) at a share of the way along the arm on one side, +1 for left."""
    left = np.concatenate((lefts, np.zeros((1, 2))))[posts.lines]
    points = posts.axis_at(params.fork)
    points[:, :2] += side * share * params.spread * left
    points[:, 2] += share * (params.top - params.fork)
    return points


def _spans(posts: Posts, course: Floats, lines: int) -> tuple[Floats, Floats]:
    """From post to next post of each line, (S, 3) each, of points (P, 3) at the posts."""
    begins, ends = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for line in range(lines):
        at = course[posts.lines == line]
        if len(at) < 2:
            continue
        axis = at[-1, :2] - at[0, :2]
        at = at[np.argsort(at[:, :2] @ axis, kind="stable")]
        begins.append(at[:-1])
        ends.append(at[1:])
    return np.concatenate(begins), np.concatenate(ends)


def _hung(begin: Floats, end: Floats, sag: float) -> Floats:
    """Spans (S, 3) cut into pieces (N, 6) that sag as a parabola."""
    longest = float(np.linalg.norm(end - begin, axis=1).max(initial=0.0))
    count = max(int(np.ceil(longest / _WIRE_PIECE_M)), 1)
    t = np.linspace(0.0, 1.0, count + 1)[None, :, None]
    points = begin[:, None] + t * (end - begin)[:, None]
    points[..., 2] -= 4.0 * sag * (t * (1.0 - t))[..., 0]
    return np.concatenate((points[:, :-1], points[:, 1:]), axis=2).reshape(-1, 6)

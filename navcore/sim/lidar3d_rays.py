"""Rays of the simulated 3D LiDAR, compiled: from the robot's poses during a turn to what the sensor would say."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from navcore.sim.rays.cast import GROUND, NOTHING
from navcore.sim.rays.fan import GRASS, Beams, Hits, cast_fan
from navcore.sim.rays.grid import Ints
from navcore.sim.rays.land_scene import ALBEDO, LandScene, Part
from navcore.sim.rays.shapes import SPOT_GAIN, SPOT_M, squareness
from navcore.sim.render.buffers import Floats, Vector
from navcore.sim.render.compiled import compiled, inlined, uncounted

# Blades stand in every direction; bare soil is rough and throws some light back even at a graze.
_GRASS_SQUARE, _SOIL_SQUARE, _THREAD_SQUARE = 0.5, 0.12, 0.7
# Share of the light on a round spot that a thread through its middle meets, per radius over half width.
_THREAD_FILL = 4.0 / math.pi
# Echoes as near as this to each other are one.
_SAME_M = 0.05
_GRASS_PART, _SOIL_PART, _MIXED_PART = int(Part.GRASS), int(Part.SOIL), int(Part.MIXED)
_WIRE_PART, _SHOOT_PART, _FENCE_PART = int(Part.WIRE), int(Part.SHOOT), int(Part.FENCE)


class Optics(NamedTuple):
    """One sensor, as in `Lidar3dParams`; `strength` is scaled to 1 m.

    Attributes:
        least, most: range, m. strength: mean photons, so to say, from a white surface met squarely at 1 m.
        missing: share of rays lost. edge_reach: of the spot over a neighbour, share of the step between two rays.
        edge_gap: two surfaces under one spot nearer to each other than this are mixed, m.
        noise: white 1-sigma, m. step: resolution of the distances, m.
    """

    least: float
    most: float
    strength: float
    missing: float
    edge_reach: float
    edge_gap: float
    noise: float
    step: float


class Rig(NamedTuple):
    """Where the rays of a turn start and where they go.

    Attributes:
        knots: (K, 7) time, x, y, z, roll, pitch, yaw of the robot in `map`, times ascending, s; angles unwrapped.
        arm: (3,) the sensor in `base_link`, m. R_base_lidar: (3, 3).
        times: (A,) when each column of rays is fired, s, ascending. azimuths: (A,) rad.
    """

    knots: Floats
    arm: Floats
    R_base_lidar: Floats
    times: Floats
    azimuths: Floats


class Echoes(NamedTuple):
    """What comes back of each ray, (A, C): distance (m), light over a white square surface at 1 m, `Part`."""

    distances: Floats
    light: Floats
    parts: Ints


@compiled
def cast_turn(scene: LandScene, beams: Beams, rig: Rig, ways: Floats, hits: Hits, echoes: Echoes) -> None:
    """All rays of a turn, in place; distance 0 for nothing. `ways` (A, C): how far, m, each ray gets in grass."""
    R, place, pose, knot = np.empty((3, 3)), np.empty(3), np.empty(6), 0
    for i in range(len(rig.times)):
        knot = pose_at(rig.knots, rig.times[i], knot, pose)
        put(pose, rig.arm, rig.R_base_lidar, R, place)
        ca, sa = math.cos(rig.azimuths[i]), math.sin(rig.azimuths[i])
        along = ca * R[0, 0] + sa * R[0, 1], ca * R[1, 0] + sa * R[1, 1], ca * R[2, 0] + sa * R[2, 1]
        cast_column(
            scene, beams, (place[0], place[1], place[2]), along, (R[0, 2], R[1, 2], R[2, 2]), ways, i, hits, echoes
        )


@uncounted
def cast_column(
    scene: LandScene, beams: Beams, origin: Vector, along: Vector, up: Vector, ways: Floats, i: int, hits: Hits,
    echoes: Echoes,
) -> None:  # fmt: skip
    """Column i of a turn, in place."""
    cast_fan(scene, beams, origin, along, up, ways[i], i, hits)
    for b in range(len(hits.solid)):
        echoes.distances[i, b], echoes.light[i, b], echoes.parts[i, b] = echo(scene, hits, b, origin)


@inlined
def pose_at(knots: Floats, time: float, knot: int, pose: Floats) -> int:
    """The robot's pose (6,) at a time, in place, straight between knots; the knot before it, at or after `knot`."""
    while knot < len(knots) - 2 and knots[knot + 1, 0] <= time:
        knot += 1
    share = (time - knots[knot, 0]) / (knots[knot + 1, 0] - knots[knot, 0])
    for j in range(6):
        pose[j] = knots[knot, j + 1] + share * (knots[knot + 1, j + 1] - knots[knot, j + 1])
    return knot


@inlined
def put(pose: Floats, arm: Floats, R_base_lidar: Floats, R: Floats, origin: Floats) -> None:
    """The sensor's axes `R` and place `origin` in `map` of a robot at x, y, z, roll, pitch, yaw, in place."""
    cr, sr, cp, sp = math.cos(pose[3]), math.sin(pose[3]), math.cos(pose[4]), math.sin(pose[4])
    cy, sy = math.cos(pose[5]), math.sin(pose[5])
    body = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    for i in range(3):
        b = body[i]
        for j in range(3):
            R[i, j] = b[0] * R_base_lidar[0, j] + b[1] * R_base_lidar[1, j] + b[2] * R_base_lidar[2, j]
        origin[i] = pose[i] + b[0] * arm[0] + b[1] * arm[1] + b[2] * arm[2]


@uncounted
def echo(scene: LandScene, hits: Hits, b: int, origin: Vector) -> tuple[float, float, int]:
    """The strongest echo of ray b: distance (0 for none), light at 1 m, `Part`."""
    t, k, near, thread = hits.solid[b], hits.shapes[b], hits.thread[b], hits.threads[b]
    light, part, dx, dy, dz = 0.0, _MIXED_PART, hits.rays[b, 0], hits.rays[b, 1], hits.rays[b, 2]
    if k >= 0:
        part = scene.parts[k]
        x, y, z = origin[0] + t * dx, origin[1] + t * dy, origin[2] + t * dz
        light = ALBEDO[part] * squareness(scene.kinds[k], scene.shapes, k, x, y, z, dx, dy, dz)
    elif k == GRASS:
        part, light = _GRASS_PART, ALBEDO[_GRASS_PART] * _GRASS_SQUARE
    elif k == GROUND:
        part, light = _SOIL_PART, ALBEDO[_SOIL_PART] * max(-dz, _SOIL_SQUARE)
    if thread != NOTHING:
        fill = min(_THREAD_FILL * scene.shapes[thread, 6] / (SPOT_M + SPOT_GAIN * near), 1.0)
        thin = fill * _THREAD_SQUARE * ALBEDO[scene.parts[thread]]
        light *= 1.0 - fill
        if k == NOTHING or thin * t * t > light * near * near:
            return near, thin, scene.parts[thread]
    return (t, light, part) if k != NOTHING else (0.0, 0.0, part)


@uncounted
def measure(
    optics: Optics, echoes: Echoes, lies: Floats, luck: Floats, normal: Floats, told: Echoes
) -> None:  # fmt: skip
    """What the sensor tells of the echoes of a turn, in place; distance 0 for nothing.

    `lies` and `luck` (A, C) are uniform numbers: where each spot lies, and whether it returns.
    """
    columns, beams = echoes.distances.shape
    for i in range(columns):
        for c in range(beams):
            side = 1 if lies[i, c] < 0.5 else -1
            lie = 2.0 * lies[i, c] - (0.0 if side == 1 else 1.0)
            t, light, part = beside_an_edge(optics, echoes, i, (i + side) % columns, c, lie)
            lost = optics.missing + (1.0 - optics.missing) * math.exp(-optics.strength * light / max(t * t, 1e-9))
            said = optics.step * math.floor((t + optics.noise * normal[i, c]) / optics.step + 0.5)
            seen = t > 0.0 and luck[i, c] >= lost and optics.least <= said <= optics.most
            told.distances[i, c], told.light[i, c], told.parts[i, c] = said if seen else 0.0, light, part


@uncounted
def beside_an_edge(optics: Optics, echoes: Echoes, i: int, j: int, c: int, lie: float) -> tuple[float, float, int]:
    """Distance, light and part of ray (i, c) whose spot may lie partly on what the ray beside it, (j, c), met.

    The edge is `lie` (0 to 1) of the step between the two away. Echoes from far apart are told apart and the own one
    is kept.
    """
    t, light, part = echoes.distances[i, c], echoes.light[i, c], echoes.parts[i, c]
    beside, other = echoes.distances[j, c], echoes.parts[j, c]
    if part == other or lie >= optics.edge_reach or t == 0.0 or beside == 0.0 or thin(part) or thin(other):
        return t, light, part
    if not _SAME_M < abs(beside - t) <= optics.edge_gap:
        return t, light, part
    share = 0.5 * (1.0 - lie / optics.edge_reach)
    return t + share * (beside - t), light + share * (echoes.light[j, c] - light), _MIXED_PART


@inlined
def thin(part: int) -> bool:
    """Whether such parts are threads, which do not fill a spot."""
    return part in (_WIRE_PART, _SHOOT_PART, _FENCE_PART)

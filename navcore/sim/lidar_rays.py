"""Rays of the simulated LiDAR, compiled: from the robot's pose to what the sensor would say."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.rays.cast import GROUND, NOTHING, cast
from navcore.sim.rays.scene import RayScene
from navcore.sim.rays.shapes import squareness
from navcore.sim.render.buffers import Floats
from navcore.sim.render.compiled import compiled, inlined
from navcore.sim.textures.atlas import Material

Ints = NDArray[np.int64]


def _albedos() -> tuple[float, ...]:
    """Share of near infrared light (785 nm) that each `Material` throws back, chosen: leaves shine, bark is dark."""
    shine = dict.fromkeys(Material, 0.45)
    shine |= {
        Material.BARK: 0.22, Material.LEAVES_A: 0.5, Material.LEAVES_B: 0.5, Material.LEAVES_C: 0.5,
        Material.STEEL: 0.3, Material.WIRE: 0.3, Material.WALL: 0.6, Material.SOIL: 0.25, Material.ROAD: 0.3,
    }  # fmt: skip
    return tuple(shine[m] for m in Material)


ALBEDO = np.array(_albedos())
GROUND_ALBEDO = 0.3
# In the glare of the sun so many rays still return something, anywhere within so many metres.
_FALSE_SHARE, _FALSE_REACH = 0.06, 4.0


class Device(NamedTuple):
    """One sensor: `Lidar2dParams` with its own errors drawn.

    Attributes:
        least, most: range, m. scale, offset: systematic error. noise_share, noise_floor: white 1-sigma.
        half_beam: rad. edge_gap: m. missing, strength: as in `Lidar2dParams`.
    """

    least: float
    most: float
    scale: float
    offset: float
    noise_share: float
    noise_floor: float
    half_beam: float
    edge_gap: float
    missing: float
    strength: float


class Beam(NamedTuple):
    """Where rays start.

    Attributes:
        before, after: x, y, yaw, roll, pitch of the robot at both ends of a span of time.
        first, step: share of the span at ray 0 and from ray to ray.
        arm: (3,) the sensor in `base_link`, m. R_base_lidar: (3, 3).
        sun, glare: azimuth in `map` and half width of what the sun blinds, rad; a glare below 0 is none.
    """

    before: Floats
    after: Floats
    first: float
    step: float
    arm: Floats
    R_base_lidar: Floats
    sun: float
    glare: float


class Draws(NamedTuple):
    """Randomness of one turn: (N,) standard normal, (N, 4) uniform: spot, mix, return, glare."""

    normal: Floats
    uniform: Floats


@compiled
def measure(
    scene: RayScene, device: Device, beam: Beam, draws: Draws, angles: Floats, begin: int, end: int,
    distances: Floats, met: Ints,
) -> None:  # fmt: skip
    """Rays `begin` to `end` of a turn: measured distances (m, 0 for none) and shapes met, in place.

    A ray whose spot lies on two surfaces has met neither. Only where neighbouring rays meet different things is the
    spot's width looked at.
    """
    R, origin, n, step = np.empty((3, 3)), np.empty(3), end - begin, angles[1] - angles[0]
    true, seen, shape = np.empty(n + 2), np.empty(n + 2, np.bool_), np.empty(n + 2, np.int64)
    for j in range(n + 2):
        i = begin + j - 1
        place_sensor(beam, beam.first + i * beam.step, R, origin)
        luck = draws.uniform[min(max(i, 0), len(angles) - 1), 2]
        true[j], shape[j], seen[j] = look(scene, device, R, origin, i * step, luck)
    for i in range(begin, end):
        j = i - begin + 1
        t, k, back = true[j], shape[j], seen[j]
        if device.half_beam > 0.0 and (shape[j - 1] != k or shape[j + 1] != k):
            place_sensor(beam, beam.first + i * beam.step, R, origin)
            t, k, back = spread(scene, device, R, origin, i * step, t, k, back, draws.uniform[i])
        if beam.glare >= 0.0:
            place_sensor(beam, beam.first + i * beam.step, R, origin)
            t, k, back = dazzled(device, beam, R, i * step, t, k, back, draws.uniform[i, 3])
        distances[i] = reading(device, t, draws.normal[i]) if back else 0.0
        met[i] = k if distances[i] > 0.0 else NOTHING


@compiled
def spread(
    scene: RayScene, device: Device, R: Floats, origin: Floats, angle: float, true: float, k: int, seen: bool,
    draw: Floats,
) -> tuple[float, int, bool]:  # fmt: skip
    """What a ray that met `k` at `true` meets with the rest of its spot: distance, shape, and whether it returns."""
    aside = device.half_beam * (2.0 * draw[0] - 1.0)
    beside, other, also = look(scene, device, R, origin, angle + aside, draw[2])
    if k == other:
        return true, k, seen
    if k == NOTHING:  # half the light is lost
        return beside, other, also and draw[1] < 0.5
    if other == NOTHING:
        return true, k, seen and draw[1] < 0.5
    if abs(beside - true) <= device.edge_gap:
        return true, k, seen
    return mixed(true, beside, draw[1]), NOTHING, seen and also


@inlined
def place_sensor(beam: Beam, share: float, R: Floats, origin: Floats) -> None:
    """The sensor's axes `R` and place `origin` in `map` after a share of the span."""
    p = beam.before + share * (beam.after - beam.before)
    cy, sy, cr, sr = math.cos(p[2]), math.sin(p[2]), math.cos(p[3]), math.sin(p[3])
    cp, sp = math.cos(p[4]), math.sin(p[4])
    body = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    for i in range(3):
        b = body[i]
        for j in range(3):
            R[i, j] = b[0] * beam.R_base_lidar[0, j] + b[1] * beam.R_base_lidar[1, j] + b[2] * beam.R_base_lidar[2, j]
        origin[i] = b[0] * beam.arm[0] + b[1] * beam.arm[1] + b[2] * beam.arm[2]
    origin[0] += p[0]
    origin[1] += p[1]


@inlined
def look(
    scene: RayScene, device: Device, R: Floats, origin: Floats, angle: float, luck: float
) -> tuple[float, int, bool]:
    """True distance along one ray, what it meets, and whether enough light comes back."""
    c, s = math.cos(angle), math.sin(angle)
    dx, dy, dz = c * R[0, 0] + s * R[0, 1], c * R[1, 0] + s * R[1, 1], c * R[2, 0] + s * R[2, 1]
    t, k = cast(scene, origin[0], origin[1], origin[2], dx, dy, dz, device.most)
    if k == NOTHING or t < device.least:
        return t, k, False
    if k == GROUND:
        light = GROUND_ALBEDO * -dz
    else:
        x, y, z = origin[0] + t * dx, origin[1] + t * dy, origin[2] + t * dz
        light = ALBEDO[scene.materials[k]] * squareness(scene.kinds[k], scene.shapes, k, x, y, z, dx, dy, dz)
    light *= device.strength * (device.most / t) ** 2
    return t, k, luck >= device.missing and luck < 1.0 - (1.0 - device.missing) * math.exp(-light)


@inlined
def mixed(true: float, beside: float, share: float) -> float:
    """Distance told of a spot with a share on a second surface: one over the distance is their mean."""
    return 1.0 / ((1.0 - share) / true + share / beside)


@inlined
def reading(device: Device, true: float, normal: float) -> float:
    """What the sensor says of a true distance, 0 if that is out of its range."""
    sigma = max(device.noise_floor, device.noise_share * true)
    said = device.scale * true + device.offset + sigma * normal
    return said if device.least <= said <= device.most else 0.0


@inlined
def dazzled(
    device: Device, beam: Beam, R: Floats, angle: float, true: float, k: int, seen: bool, luck: float
) -> tuple[float, int, bool]:
    """What a ray returns in the sun's glare: nothing, or rarely something that is not there."""
    c, s = math.cos(angle), math.sin(angle)
    azimuth = math.atan2(c * R[1, 0] + s * R[1, 1], c * R[0, 0] + s * R[0, 1])
    away = azimuth - beam.sun
    if abs(away - 2.0 * math.pi * math.floor(away / (2.0 * math.pi) + 0.5)) > beam.glare:
        return true, k, seen
    return device.least + luck / _FALSE_SHARE * _FALSE_REACH, NOTHING, luck < _FALSE_SHARE


def owners_of(owners: Ints, met: Ints) -> Ints:
    """Numbers (N,) of the trunks and posts met (N,), 0 for anything else."""
    if not len(owners):
        return np.zeros(len(met), np.int64)
    return np.where(met >= 0, owners[np.maximum(met, 0)], 0)

"""What stands between the antenna and the sky: leaves, posts and the warehouse, as loss in dB per satellite."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard, Trellis

Floats = NDArray[np.float64]

# Columns of a box: x, y of its start, direction cosine and sine, length, half width, bottom, top, dB per m.
_COLUMNS = 9
_SOLID_DB_PER_M = 1000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class CanopyParams:
    """How much foliage costs.

    Attributes:
        leaf_db_per_m: loss in closed foliage, trellis wires included, dB/m. Trees alone take 1 to 2 dB/m at L band
            (Goldhirsh and Vogel, Handbook of propagation effects, 1998); raised until a receiver with the rules of
            `GnssReceiver` fails under a roof in leaf as paper A reports. Not calibrated against a real receiver.
        wood_share: loss of bare wood and wires as a share of that of closed foliage.
        cone_deg: half width of the Fresnel cone that four rays stand for.
        solid_db: loss behind a post, trunk or wall.
    """

    leaf_db_per_m: float = 16.0
    wood_share: float = 0.08
    cone_deg: float = 4.0
    solid_db: float = 25.0


class Canopy:
    """Losses towards the sky from anywhere on the site."""

    def __init__(self, orchard: Orchard, params: CanopyParams, seed: int) -> None:
        self._params, self._seed = params, seed & 0x7FFFFFFF
        density = params.wood_share + (1.0 - params.wood_share) * orchard.leaf_density
        self._boxes = _boxes(orchard, params.leaf_db_per_m * density)
        posts = np.concatenate((orchard.posts, orchard.trunks))
        self._posts = np.ascontiguousarray(posts[:, [0, 1, 3, 4]])

    def loss_db(self, x: float, y: float, height: float, towards: Floats) -> Floats:
        """Loss (N,) in dB on the way to satellites in directions (N, 3) from an antenna `height` above the ground."""
        p, loss = self._params, np.zeros(len(towards))
        near = self._posts[np.abs(self._posts[:, :2] - (x, y)).max(axis=1) < 4.0]
        _losses(x, y, height, towards, self._boxes, near, math.radians(p.cone_deg), p.solid_db, self._seed, loss)
        return loss


def _boxes(orchard: Orchard, db_per_m: float) -> Floats:
    """Foliage along every line of plants, and the warehouse."""
    boxes = np.empty((len(orchard.plant_lines) + (orchard.shed is not None), _COLUMNS))
    for i, (x0, y0, x1, y1) in enumerate(orchard.plant_lines):
        length, heading = math.hypot(x1 - x0, y1 - y0), math.atan2(y1 - y0, x1 - x0)
        roof = orchard.trellis is Trellis.ROOF
        half_width = orchard.line_reach[i] if roof else orchard.canopy_half_width_m
        boxes[i] = (x0, y0, math.cos(heading), math.sin(heading), length, half_width, orchard.canopy_bottom_m,
                    orchard.canopy_top_m, db_per_m)  # fmt: skip
    if orchard.shed is not None:
        s = orchard.shed
        c, n = math.cos(s.yaw), math.sin(s.yaw)
        x, y = s.x - c * s.length / 2, s.y - n * s.length / 2
        boxes[-1] = (x, y, c, n, s.length, s.depth / 2, 0.0, s.height, _SOLID_DB_PER_M)
    return boxes


@njit(cache=True)
def _losses(  # type: ignore[no-untyped-def]
    x, y, height, towards, boxes, posts, cone, solid_db, seed, out
):  # pragma: no cover - compiled
    for k in range(towards.shape[0]):
        e, n, u = towards[k]
        azimuth, elevation = math.atan2(n, e), math.asin(u)
        total = 0.0
        for j in range(4):
            a = azimuth + ((j % 2) - 0.5) * 2.0 * cone / max(math.cos(elevation), 0.1)
            b = elevation + ((j // 2) - 0.5) * 2.0 * cone
            dx, dy, dz = math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), math.sin(b)
            loss = 0.0
            for i in range(boxes.shape[0]):
                loss += _through_box(x, y, height, dx, dy, dz, boxes[i], seed + 7919 * i)
            if _hits_post(x, y, height, dx, dy, dz, posts):
                loss += solid_db
            total += min(loss, solid_db)
        out[k] = total / 4.0


@njit(cache=True)
def _through_box(x, y, height, dx, dy, dz, box, seed):  # type: ignore[no-untyped-def]  # pragma: no cover - compiled
    """Loss of one ray in one box: its path inside times the foliage's local density."""
    c, s = box[2], box[3]
    rx, ry = x - box[0], y - box[1]
    along, across = rx * c + ry * s, ry * c - rx * s
    ux, uy = dx * c + dy * s, dy * c - dx * s
    near, far = 0.0, 60.0
    for position, direction, low, high in (
        (along, ux, 0.0, box[4]),
        (across, uy, -box[5], box[5]),
        (height, dz, box[6], box[7]),
    ):
        if abs(direction) < 1e-9:
            if position < low or position > high:
                return 0.0
            continue
        t0, t1 = (low - position) / direction, (high - position) / direction
        near, far = max(near, min(t0, t1)), min(far, max(t0, t1))
    if far <= near:
        return 0.0
    if box[8] >= 1000.0:
        return (far - near) * box[8]
    middle = (near + far) / 2.0
    local = _leafiness(along + middle * ux, across + middle * uy, height + middle * dz, seed)
    return (far - near) * box[8] * local


@njit(cache=True)
def _leafiness(along, across, height, seed):  # type: ignore[no-untyped-def]  # pragma: no cover - compiled
    """Local density of the foliage, 0.3 to 1.7 with mean 1, by a hash of the half-metre cell."""
    a, b, c = math.floor(along * 2.0), math.floor(across * 2.0), math.floor(height * 2.0)
    h = (a * 73856093) ^ (b * 19349663) ^ (c * 83492791) ^ (seed * 2654435761)
    h &= 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 0x45D9F3B) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 0x45D9F3B) & 0xFFFFFFFF
    h ^= h >> 16
    return 0.3 + 1.4 * (h & 0xFFFF) / 65535.0


@njit(cache=True)
def _hits_post(x, y, height, dx, dy, dz, posts):  # type: ignore[no-untyped-def]  # pragma: no cover - compiled
    """Whether the ray passes through a post or trunk; posts (N, 4) x, y, height, radius."""
    flat = math.sqrt(dx * dx + dy * dy)
    if flat < 1e-6:
        return False
    for i in range(posts.shape[0]):
        rx, ry = posts[i, 0] - x, posts[i, 1] - y
        ahead = (rx * dx + ry * dy) / flat
        beside = abs(rx * dy - ry * dx) / flat
        if ahead > 0.0 and beside < posts[i, 3] and height + ahead / flat * dz < posts[i, 2]:
            return True
    return False

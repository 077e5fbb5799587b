"""Primitives of an orchard's wood: trunks, posts, branches, wires and the shed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.sim.orchard import Orchard, Standing, Trellis
from navcore.sim.render.buffers import Floats
from navcore.sim.render.primitives import RINGS, Primitives, upright
from navcore.sim.render.undergrowth import stake_tubes, weed_stalks
from navcore.sim.shed import Shed
from navcore.sim.textures.atlas import Material

_POST_LOOK = {
    Standing.CEMENT: Material.CEMENT, Standing.STEEL: Material.STEEL, Standing.WOOD: Material.WOOD,
}  # fmt: skip
_WIRE_RADIUS_M = 0.002
_WIRE_PIECE_M = 2.5


def planted(orchard: Orchard, cards: Floats) -> Primitives:
    """All primitives of an orchard with the given leaf cards.

    Owners count trunks first, then posts, from 1; their tubes come first. Stakes have no owner: 0.
    """
    rng = np.random.default_rng((orchard.params.seed, 11))
    trunks, posts = _trunks(orchard.trunks, rng), _posts(orchard.posts, rng)
    stakes = stake_tubes(orchard.clutter)
    wood = np.full(len(stakes), Material.WOOD, dtype=np.int64)
    look = np.concatenate((np.full(len(trunks), Material.BARK), _post_materials(orchard.posts[:, 5]), wood))
    owners = np.concatenate((np.arange(1, len(trunks) + len(posts) + 1), np.zeros(len(stakes), np.int64)))
    stalks = weed_stalks(orchard.clutter, orchard.params.seed)
    panels, panel_look = shed_panels(orchard.shed)
    standing = Primitives(
        tubes=np.concatenate((trunks, posts, stakes)),
        tube_look=np.column_stack((look, owners)).astype(np.int64),
        beams=np.concatenate((_branches(orchard, trunks, rng), _wires(orchard), stalks)),
        cards=cards, panels=panels, panel_look=panel_look,
    )  # fmt: skip
    return upright(standing, orchard.uphill) if any(orchard.uphill) else standing


def _trunks(trunks: Floats, rng: np.random.Generator) -> Floats:
    """Crooked tapering tubes (T, 5, 4), feet a little below the ground."""
    n = len(trunks)
    share = np.linspace(0.0, 1.0, RINGS)
    sway = np.cumsum(rng.normal(0.0, 0.018, (n, RINGS, 2)), axis=1) * np.sqrt(trunks[:, 3])[:, None, None]
    sway[:, 0] = 0.0
    tubes = np.empty((n, RINGS, 4))
    tubes[..., :2] = trunks[:, None, :2] + sway
    tubes[..., 2] = trunks[:, None, 2] + share * trunks[:, 3, None] - 0.04 * (share == 0)
    tubes[..., 3] = trunks[:, 4, None] * (1.15 - 0.3 * share) * rng.uniform(0.88, 1.12, (n, RINGS))
    return tubes


def _posts(posts: Floats, rng: np.random.Generator) -> Floats:
    """Straight tubes (P, 5, 4) that lean a little."""
    n = len(posts)
    share = np.linspace(0.0, 1.0, RINGS)[None, :]
    lean = rng.normal(0.0, 0.014, (n, 2)) * posts[:, 3, None]
    tubes = np.empty((n, RINGS, 4))
    tubes[..., :2] = posts[:, None, :2] + lean[:, None] * share[..., None]
    tubes[..., 2] = posts[:, None, 2] + share * posts[:, 3, None] - 0.04 * (share == 0)
    tubes[..., 3] = posts[:, 4, None]
    return tubes


def _post_materials(standing: Floats) -> NDArray[np.int64]:
    return np.array([_POST_LOOK[Standing(int(s))] for s in standing], dtype=np.int64)


def _branches(orchard: Orchard, trunks: Floats, rng: np.random.Generator) -> Floats:
    """Beams (B, 9) from the trunks' heads into the canopy."""
    if not len(trunks):
        return np.zeros((0, 9))
    along = _directions(orchard)[orchard.trunk_line]
    left = np.column_stack((-along[:, 1], along[:, 0]))
    arms = []
    for forward, sideways, up in _arms(orchard):
        reach = forward * along + sideways * left
        end = trunks[:, -1, :3].copy()
        end[:, :2] += reach * rng.uniform(0.7, 1.2, (len(trunks), 1))
        end[:, 2] += up * rng.uniform(0.7, 1.2, len(trunks))
        arms.append(np.column_stack((trunks[:, -1, :3], end, trunks[:, -1, 3] * 0.7, trunks[:, -1, 3] * 0.3)))
    beams = np.concatenate(arms)
    return np.column_stack((beams, np.full(len(beams), float(Material.BARK))))


def _arms(orchard: Orchard) -> tuple[tuple[float, float, float], ...]:
    """Forward, left and up of each branch, m."""
    if orchard.trellis is Trellis.VSP:
        return (0.55, 0.0, 0.04), (-0.55, 0.0, 0.04)
    if orchard.trellis is Trellis.ROOF:
        out = orchard.canopy_half_width_m * 0.7
        return (0.3, out, 0.18), (-0.3, -out, 0.18), (0.6, 0.3, 0.15), (-0.6, -0.3, 0.15)
    arms = (0.1, 0.05, 1.6), (0.5, 0.4, 1.0), (-0.5, -0.4, 1.0), (0.4, -0.5, 0.8), (-0.4, 0.5, 0.8)
    if orchard.params.canopy is None:
        return arms
    wide, high = orchard.canopy_half_width_m / 0.8, (orchard.canopy_top_m - orchard.canopy_bottom_m) / 2.3
    return tuple((wide * forward, wide * left, high * up) for forward, left, up in arms)


def _directions(orchard: Orchard) -> Floats:
    """Unit vector along each line (L + 1, 2); the last is for trunks that stand alone."""
    d = orchard.plant_lines[:, 2:] - orchard.plant_lines[:, :2]
    return np.concatenate((d / np.maximum(np.linalg.norm(d, axis=1), 1e-9)[:, None], [(1.0, 0.0)]))


def _wires(orchard: Orchard) -> Floats:
    """Beams (B, 9): the trellis' wires in short pieces."""
    pieces = [np.zeros((0, 9))]
    for (x0, y0, x1, y1), reach in zip(orchard.plant_lines, orchard.line_reach, strict=True):
        length = math.hypot(x1 - x0, y1 - y0)
        n = max(math.ceil(length / _WIRE_PIECE_M), 1)
        nx, ny = -(y1 - y0) / max(length, 1e-9), (x1 - x0) / max(length, 1e-9)
        t = np.linspace(0.0, 1.0, n + 1)
        for left, height in _wire_places(orchard, reach):
            x, y = x0 + t * (x1 - x0) + left * nx, y0 + t * (y1 - y0) + left * ny
            z = np.full(n, height)
            size = np.full((n, 2), _WIRE_RADIUS_M)
            pieces.append(
                np.column_stack((x[:-1], y[:-1], z, x[1:], y[1:], z, size, np.full(n, float(Material.WIRE))))
            )
    return np.concatenate(pieces)


def _wire_places(orchard: Orchard, reach: float) -> tuple[tuple[float, float], ...]:
    """Offset from the line of plants and height of each wire, m."""
    if orchard.trellis is Trellis.VSP:
        return tuple((0.0, h) for h in (0.86, 1.2, 1.55, 1.9))
    if orchard.trellis is Trellis.ROOF:
        return tuple((s * reach, orchard.canopy_bottom_m + 0.15) for s in (-0.98, -0.5, 0.0, 0.5, 0.98))
    return ()


def shed_panels(shed: Shed | None) -> tuple[Floats, Floats]:
    """Walls and a gable roof: corners (Q, 4, 5) and (normal, material) (Q, 4)."""
    if shed is None:
        return np.zeros((0, 4, 5)), np.zeros((0, 4))
    a, b, h, ridge = shed.length / 2, shed.depth / 2, shed.height, shed.height + shed.depth * 0.2
    wall, roof = Material.WALL, Material.ROOF
    eave = 0.4
    drop = eave * (ridge - h) / b
    faces = [
        ([(-a, -b, 0), (a, -b, 0), (a, -b, h), (-a, -b, h)], (0, -1, 0), wall),
        ([(a, b, 0), (-a, b, 0), (-a, b, h), (a, b, h)], (0, 1, 0), wall),
        ([(a, -b, 0), (a, b, 0), (a, b, h), (a, -b, h)], (1, 0, 0), wall),
        ([(-a, b, 0), (-a, -b, 0), (-a, -b, h), (-a, b, h)], (-1, 0, 0), wall),
        ([(a, -b, h), (a, b, h), (a, 0, ridge), (a, 0, ridge)], (1, 0, 0), wall),
        ([(-a, b, h), (-a, -b, h), (-a, 0, ridge), (-a, 0, ridge)], (-1, 0, 0), wall),
        (
            [(-a, -b - eave, h - drop), (a, -b - eave, h - drop), (a, 0, ridge), (-a, 0, ridge)],
            (0, -0.37, 0.93),
            roof,
        ),
        ([(a, b + eave, h - drop), (-a, b + eave, h - drop), (-a, 0, ridge), (a, 0, ridge)], (0, 0.37, 0.93), roof),
    ]
    panels = np.array([_panel(np.array(corners, dtype=np.float64), shed) for corners, _, _ in faces])
    look = np.array([(*_turned(np.array([normal]), shed.yaw)[0], float(m)) for _, normal, m in faces])
    return panels, look


def _panel(corners: Floats, shed: Shed) -> Floats:
    """Corners (4, 5) in `map` with texture coordinates, one texture per 4 m."""
    u = np.where(np.ptp(corners[:, 0]) > 1.0, corners[:, 0], corners[:, 1]) / 4.0 + 8.0
    placed = _turned(corners, shed.yaw) + np.array((shed.x, shed.y, 0.0))
    return np.column_stack((placed, u, corners[:, 2] / 4.0))


def _turned(vectors: Floats, yaw: float) -> Floats:
    c, s = math.cos(yaw), math.sin(yaw)
    return np.asarray(vectors @ np.array(((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))))

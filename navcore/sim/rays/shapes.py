"""Where a ray meets one shape, and how squarely. A ray is a start and a unit direction; a miss is infinite.

Shapes are rows of 15 numbers in `map`, m:
    TUBE   lower ring x, y, z, radius, upper ring x, y, z, radius: level circles with straight lines between them
    BEAM   two ends x, y, z each, radius at each end
    CARD   middle, half edges u and v, unit normal, 1 / |u|^2, 1 / |v|^2, share that is leaf (less than 0: a tuft)
    PANEL  four corners in order around, unit normal
    THREAD two ends x, y, z each, radius: thinner than a LiDAR's spot, within whose reach it is met
"""

from __future__ import annotations

import math

from navcore.sim.render.buffers import Floats
from navcore.sim.render.compiled import inlined

TUBE, BEAM, CARD, PANEL, THREAD = 0, 1, 2, 3, 4
NUMBERS = 15
MISS = math.inf
# Half width of a LiDAR's spot: at the lens, m, and what it gains per metre (VLP-16: 9.5 mm, 3 mrad).
SPOT_M, SPOT_GAIN = 0.005, 0.0015
_LEAF_CELLS = 12.0
_LEAF_RIM = 0.8


@inlined
def meet_tube(
    s: Floats, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float
) -> float:  # fmt: skip
    """Distance along the ray to tube k: |o + t d - c(z)| = r(z) with axis c and radius r linear in height."""
    rise = s[k, 6] - s[k, 2]
    slope_x, slope_y, taper = (s[k, 4] - s[k, 0]) / rise, (s[k, 5] - s[k, 1]) / rise, (s[k, 7] - s[k, 3]) / rise
    up = oz - s[k, 2]
    ax, ay, r = ox - s[k, 0] - slope_x * up, oy - s[k, 1] - slope_y * up, s[k, 3] + taper * up
    bx, by, q = dx - slope_x * dz, dy - slope_y * dz, taper * dz
    a, b, c = bx * bx + by * by - q * q, ax * bx + ay * by - r * q, ax * ax + ay * ay - r * r
    root = b * b - a * c
    if root < 0.0 or a < 1e-12:
        return MISS
    t = (-b - math.sqrt(root)) / a
    z = oz + t * dz
    return t if t > 0.0 and s[k, 2] <= z <= s[k, 6] else MISS


@inlined
def meet_beam(
    s: Floats, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float
) -> float:  # fmt: skip
    """Distance along the ray to beam k: where it passes the axis nearest, less half the chord there."""
    ex, ey, ez = s[k, 3] - s[k, 0], s[k, 4] - s[k, 1], s[k, 5] - s[k, 2]
    wx, wy, wz = ox - s[k, 0], oy - s[k, 1], oz - s[k, 2]
    length2, along = ex * ex + ey * ey + ez * ez, ex * dx + ey * dy + ez * dz
    across2 = length2 - along * along
    if across2 < 1e-12:
        return MISS
    we, wd = wx * ex + wy * ey + wz * ez, wx * dx + wy * dy + wz * dz
    share = (we - along * wd) / across2
    if share < 0.0 or share > 1.0:
        return MISS
    t = share * along - wd
    gx, gy, gz = wx + t * dx - share * ex, wy + t * dy - share * ey, wz + t * dz - share * ez
    radius = s[k, 6] + share * (s[k, 7] - s[k, 6])
    depth2 = radius * radius - gx * gx - gy * gy - gz * gz
    if depth2 < 0.0:
        return MISS
    t -= math.sqrt(depth2 * length2 / across2)
    return t if t > 0.0 else MISS


@inlined
def meet_thread(
    s: Floats, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float
) -> float:  # fmt: skip
    """Distance along the ray to where it passes thread k nearest, if the spot there touches it."""
    ex, ey, ez = s[k, 3] - s[k, 0], s[k, 4] - s[k, 1], s[k, 5] - s[k, 2]
    wx, wy, wz = ox - s[k, 0], oy - s[k, 1], oz - s[k, 2]
    length2, along = ex * ex + ey * ey + ez * ez, ex * dx + ey * dy + ez * dz
    across2 = length2 - along * along
    if across2 < 1e-12:
        return MISS
    we, wd = wx * ex + wy * ey + wz * ez, wx * dx + wy * dy + wz * dz
    share = (we - along * wd) / across2
    if share < 0.0 or share > 1.0:
        return MISS
    t = share * along - wd
    gx, gy, gz = wx + t * dx - share * ex, wy + t * dy - share * ey, wz + t * dz - share * ez
    reach = s[k, 6] + SPOT_M + SPOT_GAIN * t
    return t if t > 0.0 and gx * gx + gy * gy + gz * gz < reach * reach else MISS


@inlined
def meet_card(
    s: Floats, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float
) -> float:  # fmt: skip
    """Distance along the ray to card k where there is a leaf, which a hash of the place on the card decides."""
    towards = dx * s[k, 9] + dy * s[k, 10] + dz * s[k, 11]
    if abs(towards) < 1e-6:
        return MISS
    rx, ry, rz = s[k, 0] - ox, s[k, 1] - oy, s[k, 2] - oz
    t = (rx * s[k, 9] + ry * s[k, 10] + rz * s[k, 11]) / towards
    if t <= 0.0:
        return MISS
    px, py, pz = t * dx - rx, t * dy - ry, t * dz - rz
    a = (px * s[k, 3] + py * s[k, 4] + pz * s[k, 5]) * s[k, 12]
    b = (px * s[k, 6] + py * s[k, 7] + pz * s[k, 8]) * s[k, 13]
    if abs(a) > 1.0 or abs(b) > 1.0:
        return MISS
    return t if leaf_there(k, a, b, s[k, 14]) else MISS


@inlined
def leaf_there(k: int, a: float, b: float, share: float) -> bool:
    """Whether card k has a leaf at (a, b), each -1 to 1, b up.

    The drawn textures, measured: leaves fill `share` of a disc of 0.8 and a tenth of its rim; blades of a tuft fill
    four fifths at the root and thin out towards the tips.
    """
    there: float = 0.0
    if share < 0.0:
        there = 0.85 * (1.0 - max(0.5 * (b + 1.0), 0.0) ** 2.5)
    else:
        away2 = a * a + b * b
        there = share if away2 < _LEAF_RIM * _LEAF_RIM else (0.15 * share if away2 < 1.0 else 0.0)
    column, row = int((a + 1.0) * _LEAF_CELLS), int((b + 1.0) * _LEAF_CELLS)
    h = (k * 73856093) ^ (column * 19349663) ^ (row * 83492791)
    h &= 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 0x45D9F3B) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 0x45D9F3B) & 0xFFFFFFFF
    drawn: float = ((h ^ (h >> 16)) & 0xFFFF) / 65536.0
    return drawn < there


@inlined
def meet_panel(
    s: Floats, k: int, ox: float, oy: float, oz: float, dx: float, dy: float, dz: float
) -> float:  # fmt: skip
    """Distance along the ray to panel k, from either side."""
    nx, ny, nz = s[k, 12], s[k, 13], s[k, 14]
    towards = dx * nx + dy * ny + dz * nz
    if abs(towards) < 1e-9:
        return MISS
    t = ((s[k, 0] - ox) * nx + (s[k, 1] - oy) * ny + (s[k, 2] - oz) * nz) / towards
    if t <= 0.0:
        return MISS
    x, y, z = ox + t * dx, oy + t * dy, oz + t * dz
    left, right = False, False
    for i in range(4):
        j = 3 * ((i + 1) & 3)
        ex, ey, ez = s[k, j] - s[k, 3 * i], s[k, j + 1] - s[k, 3 * i + 1], s[k, j + 2] - s[k, 3 * i + 2]
        gx, gy, gz = x - s[k, 3 * i], y - s[k, 3 * i + 1], z - s[k, 3 * i + 2]
        turn = nx * (ey * gz - ez * gy) + ny * (ez * gx - ex * gz) + nz * (ex * gy - ey * gx)
        left, right = left or turn > 1e-9, right or turn < -1e-9
    return MISS if left and right else t


@inlined
def squareness(kind: int, s: Floats, k: int, x: float, y: float, z: float, dx: float, dy: float, dz: float) -> float:
    """Cosine between the ray and the normal of shape k where it was met in (x, y, z), 0 to 1."""
    nx, ny, nz = 0.0, 0.0, 0.0
    if kind == CARD:
        nx, ny, nz = s[k, 9], s[k, 10], s[k, 11]
    elif kind == PANEL:
        nx, ny, nz = s[k, 12], s[k, 13], s[k, 14]
    elif kind == TUBE:
        share = (z - s[k, 2]) / (s[k, 6] - s[k, 2])
        nx, ny = x - s[k, 0] - share * (s[k, 4] - s[k, 0]), y - s[k, 1] - share * (s[k, 5] - s[k, 1])
    else:
        ex, ey, ez = s[k, 3] - s[k, 0], s[k, 4] - s[k, 1], s[k, 5] - s[k, 2]
        gx, gy, gz = x - s[k, 0], y - s[k, 1], z - s[k, 2]
        share = (gx * ex + gy * ey + gz * ez) / (ex * ex + ey * ey + ez * ez)
        nx, ny, nz = gx - share * ex, gy - share * ey, gz - share * ez
    cosine: float = abs(dx * nx + dy * ny + dz * nz) / max(math.sqrt(nx * nx + ny * ny + nz * nz), 1e-12)
    return min(cosine, 1.0)

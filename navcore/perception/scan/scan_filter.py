"""Paper B's filter of a scan (2.5.1): the window beside the robot in which trunks can stand, then spikes.

The paper's "limited to the [1, 1.5] m range window according to the row spacing" is read as the lateral distance to
either side: as a range it would leave one or two trunks of a whole scan.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.errors import ConfigError
from navcore.perception.scan.scan_points import ScanPoints

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanFilterParams:
    """Attributes:
    nearest, furthest: lateral distance to either side between which points count, m, 0 <= nearest < furthest. Paper
        B has [1, 1.5] for rows 2 to 3 m apart; ours leaves room for a robot that is off the centre line.
    window: of the median along the scan, rays, odd (paper B: 5).
    spike: a ray further off its median takes the median's distance, m, > 0 (paper B: 0.15).
    """

    nearest: float = 0.5
    furthest: float = 2.0
    window: int = 5
    spike: float = 0.15

    def __post_init__(self) -> None:
        if not (0.0 <= self.nearest < self.furthest and math.isfinite(self.furthest)):
            raise ConfigError(
                f"The scan's window needs 0 <= nearest < furthest, not {self.nearest}, {self.furthest}."
            )
        if self.window < 1 or self.window % 2 == 0 or not self.spike > 0.0:
            raise ConfigError("The scan's median needs an odd window and a spike above 0 m.")


def scan_filter(points: ScanPoints, params: ScanFilterParams) -> ScanPoints:
    """The same rays, of which only those in the window are valid, with spikes moved along their rays.

    The median is taken over a ray's neighbours along the scan that are in the window too; of an even number of them
    the nearer middle one is the median, so that no distance is made up.
    """
    across = np.abs(points.xy[:, 1])
    valid = points.valid & (across >= params.nearest) & (across <= params.furthest)
    distances = _without_spikes(points.distances, valid, params.window // 2, params.spike)
    stretch = np.divide(distances, points.distances, out=np.ones_like(distances), where=valid)
    xy = points.origins + stretch[:, None] * (points.xy - points.origins)
    return replace(points, xy=xy, distances=distances, valid=valid)


@njit(cache=True)
def _without_spikes(distances: Floats, valid: Mask, half: int, spike: float) -> Floats:
    smooth, near = distances.copy(), np.empty(2 * half + 1)
    for i in range(len(distances)):
        if not valid[i]:
            continue
        n = 0
        for j in range(max(0, i - half), min(len(distances), i + half + 1)):
            if valid[j]:
                n = _insert(near, n, distances[j])
        median = near[(n - 1) // 2]
        if abs(distances[i] - median) > spike:
            smooth[i] = median
    return smooth


@njit(cache=True)
def _insert(ascending: Floats, n: int, value: float) -> int:
    """Put `value` among the first `n`; how many there are now."""
    k = n
    while k > 0 and ascending[k - 1] > value:
        ascending[k] = ascending[k - 1]
        k -= 1
    ascending[k] = value
    return n + 1

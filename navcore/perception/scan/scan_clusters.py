"""Things in a scan, found in the order of its rays, and the trunks among them. Ours, in place of DBSCAN.

Rays come in order, so that a thing is a run of neighbours: no search for neighbours, and no count of points that must
hold at 1 m and at 10 m alike. How many rays a trunk of some diameter returns from some range is known, paper B's
N = 360 D / (2 pi r 0.225), and is asked for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.perception.scan.cluster_kernels import things

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanClusterParams:
    """Parameters of `ScanClusters`; lengths in m.

    Attributes:
        near, far: rays shorter or longer are passed over.
        jump: ranges of neighbours of one thing differ by less; slope_deg: and by no more than on a surface which the
            rays meet at that angle.
        bridge: so many empty rays may lie inside a thing.
        ray_std, ray_std_share: 1-sigma of a range: a part that is always there, and a share of the range.
        thinnest, thickest: diameters of trunks and posts.
        fewest: a trunk returns at least that share of the rays that its thinnest would, and one at least.
        rough: a thing whose rays scatter by so many 1-sigma about its circle is no trunk.
        hidden: a thing nearer by so much hides the edge beside it.
        cut_std: 1-sigma of the centre of a trunk of which an edge is hidden.
    """

    near: float = 0.2
    far: float = 12.0
    jump: float = 0.06
    slope_deg: float = 12.0
    bridge: int = 2
    ray_std: float = 0.01
    ray_std_share: float = 0.004
    thinnest: float = 0.03
    thickest: float = 0.40
    fewest: float = 0.6
    rough: float = 2.5
    hidden: float = 0.25
    cut_std: float = 0.04


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScanTrunks:
    """What may be trunks or posts, in the order of the rays, in the frame of the sensor (polar, from its origin).

    Attributes:
        bearing, range: (K,) of the centre, rad and m.
        range_std, bearing_std: (K,) 1-sigma, m and rad.
        diameter, diameter_std: (K,) m. cut: (K,) an edge is hidden: the diameter is the least it can be.
        rays: (K,) how many came back. moment: (K,) when its middle was met, 0 to 1 of the turn.
        roughness: (K,) RMS of the ranges about the circle, in 1-sigma of a range.
    """

    bearing: Floats
    range: Floats
    range_std: Floats
    bearing_std: Floats
    diameter: Floats
    diameter_std: Floats
    cut: NDArray[np.bool_]
    rays: Ints
    moment: Floats
    roughness: Floats

    def __len__(self) -> int:
        return len(self.bearing)


class ScanClusters:
    """Finds trunks and posts in scans."""

    def __init__(self, params: ScanClusterParams = ScanClusterParams()) -> None:
        self._params = params

    def find(self, angles: Floats, distances: Floats) -> ScanTrunks:
        """Of one turn: bearings (N,) rad and ranges (N,) m, 0 where nothing came back, as in `LidarScan`."""
        p, step = self._params, ray_step(angles)
        slope, beside = math.radians(p.slope_deg), p.bridge + 1
        found = things(angles, distances, p.near, p.far, step, p.jump, slope, p.bridge, p.hidden, beside)
        return self._trunks(found[self._may_be_trunk(found, step)], len(angles), step)

    def _may_be_trunk(self, found: Floats, step: float) -> NDArray[np.bool_]:
        """Thick enough or cut, not too thick, of enough rays, round enough."""
        p, (rho, radius, rays, rms) = self._params, found[:, 1:5].T
        fewest = np.maximum(1.0, np.floor(p.fewest * expected_rays(p.thinnest, rho, step)))
        slack = step * rho  # the silhouette is told to a ray on either side
        fits = (2.0 * radius >= p.thinnest - slack) & (2.0 * radius <= p.thickest + slack)
        return np.asarray(fits & (rays >= fewest) & (rms <= p.rough * self._ray_std(rho)))

    def _trunks(self, found: Floats, n: int, step: float) -> ScanTrunks:
        p, (bearing, rho, radius, rays, rms) = self._params, found[:, :5].T
        first, last, cut = found[:, 5], found[:, 6], found[:, 7] > 0
        ray_std, edge = self._ray_std(rho), 0.41 * step * rho  # two edges, each known to a step: sqrt(2 / 12)
        loose = np.where(cut, p.cut_std, 0.0)
        return ScanTrunks(
            bearing=bearing, range=rho, range_std=np.sqrt(ray_std**2 / rays + (0.5 * edge) ** 2 + loose**2),
            bearing_std=np.hypot(0.5 * edge, loose) / rho, diameter=2.0 * radius, diameter_std=np.hypot(edge, loose),
            cut=cut, rays=rays.astype(np.int64), moment=0.5 * (first + last) / max(n - 1, 1), roughness=rms / ray_std,
        )  # fmt: skip

    def _ray_std(self, rho: Floats) -> Floats:
        p = self._params
        return np.asarray(np.hypot(p.ray_std, p.ray_std_share * rho))


def ray_step(angles: Floats) -> float:
    """Angle between two rays, rad: the median, for a turn may have gaps. 0.225 deg for fewer than two."""
    return float(np.median(np.abs(np.diff(angles)))) if len(angles) > 1 else math.radians(0.225)


def expected_rays(diameter: float | Floats, ranges: Floats, step: float) -> Floats:
    """Rays that a trunk returns from a range: N = 360 D / (2 pi r 0.225) (paper B), `step` rad for its 0.225 deg."""
    return np.asarray(diameter / (ranges * step))

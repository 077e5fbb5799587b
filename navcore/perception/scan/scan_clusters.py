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

from navcore.perception.scan.cluster_kernels import ThingRules, TrunkRules, trunks

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
        first, last: (K,) which of the turn's rays met it first and last.
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
    first: Ints
    last: Ints

    def __len__(self) -> int:
        return len(self.bearing)


class ScanClusters:
    """Finds trunks and posts in scans."""

    def __init__(self, params: ScanClusterParams = ScanClusterParams()) -> None:
        p = params
        self._of_things = ThingRules(p.near, p.far, p.jump, math.radians(p.slope_deg), p.bridge, p.hidden)
        self._of_trunks = TrunkRules(
            p.thinnest, p.thickest, p.fewest, p.rough, p.ray_std, p.ray_std_share, p.cut_std
        )  # fmt: skip

    def find(self, angles: Floats, distances: Floats) -> ScanTrunks:
        """Of one turn: bearings (N,) rad and ranges (N,) m, 0 where nothing came back, as in `LidarScan`."""
        told = trunks(np.ascontiguousarray(angles), np.ascontiguousarray(distances), self._of_things, self._of_trunks)
        bearing, rho, range_std, bearing_std, diameter, diameter_std, cut, rays, moment, roughness = told[:10]
        first, last = told[10:].astype(np.int64)
        return ScanTrunks(
            bearing=bearing, range=rho, range_std=range_std, bearing_std=bearing_std, diameter=diameter,
            diameter_std=diameter_std, cut=cut > 0.0, rays=rays.astype(np.int64), moment=moment, roughness=roughness,
            first=first, last=last,
        )  # fmt: skip

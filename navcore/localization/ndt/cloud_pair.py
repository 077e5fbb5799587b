"""Two clouds laid onto each other, without a map made before."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.registration import Floats, Registration
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams


@dataclass(frozen=True, slots=True, kw_only=True)
class CloudPairParams:
    """Parameters of `CloudPair`.

    Attributes:
        thinned: the source is thinned to the means of voxels of this size, m, above 0: as fine as two sparse scans
            of a street gain from.
        target: how the target becomes Gaussians. matcher: of the match.
    """

    thinned: float = 0.25
    target: NdtMapParams = field(default_factory=NdtMapParams)
    matcher: NdtMatcherParams = field(default_factory=NdtMatcherParams)


class CloudPair:
    """A target that sources are laid onto. Raises NdtMapError for points that no map can hold."""

    def __init__(self, target: Floats, params: CloudPairParams = CloudPairParams()) -> None:
        self._params = params
        self._map = NdtMap(params.target)
        self._map.add(target)
        self._matcher = NdtMatcher(self._map, params.matcher)

    def register(self, source: Floats, guess: SE3) -> Registration:
        """`T_target_source` of points (N, 3), m. Raises NotFiniteError."""
        return self._matcher.match(voxel_means(source, self._params.thinned), guess)

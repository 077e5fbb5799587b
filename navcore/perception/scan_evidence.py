"""What a 2D LiDAR adds to a picture: plants to the centimetre, and which objects of the picture they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScanEvidence:
    """Plants around the robot when the picture was taken, in the driving frame of the leaning body.

    Attributes:
        plants: (M, 4) x, y, 1-sigma in m, and weight: how sure it is, 0 to 1, that it is a trunk or a post.
        paired: (N,) which of them each foot of the picture belongs to, -1 for none.
    """

    plants: Floats
    paired: Ints

    def only(self, feet: Mask) -> ScanEvidence:
        """With those feet of the picture, for which `feet` (N,) is True."""
        return ScanEvidence(plants=self.plants, paired=self.paired[feet])


def nothing_scanned(feet: int) -> ScanEvidence:
    """For a picture with so many feet and no scan."""
    return ScanEvidence(plants=np.empty((0, 4)), paired=np.full(feet, -1, dtype=np.int64))

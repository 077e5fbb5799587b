"""What one moment gave to see, and the row in it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.messages import DetectedObject, RowObservation, RowSource
from navcore.perception.corner_points import CornerPoints
from navcore.perception.plants.scanned_plants import ScannedPlants
from navcore.perception.row_lines import GroundRow, RowLines
from navcore.perception.scan_evidence import ScanEvidence


class Look(NamedTuple):
    """What one moment gave to see.

    Attributes:
        fault: what is wrong with the picture, empty if nothing is.
        objects: of the picture. corners: their corner points, those that count.
        scanned: a LiDAR was heard. plants: what it knows about.
        found: (N,) which of them each object is, -1 for none.
        scan: what they add to the picture, None if there are none.
        level: (M, 4) the same plants as in `ScanEvidence`, but on the level ground.
    """

    fault: str
    objects: tuple[DetectedObject, ...]
    corners: CornerPoints
    scanned: bool
    plants: ScannedPlants
    found: NDArray[np.int64]
    scan: ScanEvidence | None
    level: NDArray[np.float64]

    @property
    def boxed(self) -> NDArray[np.int64]:
        """Which plants are objects of the picture, rising."""
        return np.sort(self.found[self.found >= 0])

    @property
    def source(self) -> RowSource:
        """The sensors that took part."""
        if self.scan is None:
            return RowSource.CAMERA
        return RowSource.LIDAR if self.fault else RowSource.FUSED


class SeenRow(NamedTuple):
    """The row, and all from which its picture is drawn.

    Attributes:
        lines: in the image. ground: on the ground, or why there is none. bisector: of the lines, None without both.
        bearings: (N,) how far to the left of straight ahead the objects are seen from the camera, rad; empty without
            a scan.
    """

    row: RowObservation
    look: Look
    lines: RowLines
    ground: GroundRow | str
    bisector: Line2 | None
    bearings: NDArray[np.float64]

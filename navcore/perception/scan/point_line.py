"""A row's line through trunks seen from above, and what every fitter of one is asked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, NotFiniteError
from navcore.geometry.line2 import Line2

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PointLine:
    """Attributes:
    line: directed ahead, that is with x rising.
    inliers: (N,) which points lie on it, within the fitter's own distance.
    """

    line: Line2
    inliers: Mask


class PointLineFitter(Protocol):
    """From trunks to the line that they stand on."""

    def fit(self, points: Floats, confidences: Floats) -> PointLine | None:
        """The line through points (N, 2), m, each believed as much as `confidences` (N,) say; None if there is none.

        Raises NotFiniteError for points that are no numbers.
        """
        ...


def directed_ahead(line: Line2) -> Line2:
    """The same line with x rising."""
    return line if math.cos(line.heading) >= 0.0 else line.reversed()


def checked_points(points: Floats, confidences: Floats) -> tuple[Floats, Floats]:
    """Both as arrays (N, 2) and (N,), once they are numbers."""
    xy, conf = np.asarray(points, dtype=np.float64).reshape(-1, 2), np.asarray(confidences, dtype=np.float64)
    if conf.shape != (len(xy),):
        raise ContractError(f"{len(xy)} points need as many confidences, not {conf.shape}.")
    if not (np.isfinite(xy).all() and np.isfinite(conf).all()):
        raise NotFiniteError("Trunks on which a line is fitted must be numbers: leave those that are not known out.")
    return np.ascontiguousarray(xy), conf

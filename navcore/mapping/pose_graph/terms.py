"""What was measured: between two poses, of a place on the Earth, and of where up is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RelativeTerm:
    """Pose of node `j` in node `i`.

    Attributes:
        T_i_j: measured.
        information: (6, 6) of translation, m, and rotation vector, rad, along the axes of `i`.
        loop: it may lie, so it is robust; a step of the drive from one node to the next is not doubted.
    """

    i: int
    j: int
    T_i_j: SE3
    information: Floats
    loop: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PositionTerm:
    """Where an antenna was; robust, for a receiver may lie.

    Attributes:
        antenna: (3,) in node `i`, m. place: (3,) measured in `map`, m. information: (3, 3), 1/m^2.
        share: of an independent measurement, above 0, at most 1: the others of its neighbourhood have the same error.
    """

    i: int
    antenna: Floats
    place: Floats
    information: Floats
    share: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LevelTerm:
    """Which way is up.

    Attributes:
        up: (3,) unit vector in node `i`. std: 1-sigma of roll and of pitch, rad.
    """

    i: int
    up: Floats
    std: float


Term = RelativeTerm | PositionTerm | LevelTerm

"""Points of a cloud, found again by the beams that could have measured them."""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.lidar3d.models import LidarModel
from navcore.geometry.point_cloud import PointCloud

Floats = NDArray[np.float64]
# Azimuths of one channel, three turns of them, stay clear of the next one's.
_CHANNEL_DEG = 2000.0


class Echoes(NamedTuple):
    """Attributes:
    distance: (..., 2) m, of the nearer and of the further echo of each ray, 0 for none. intensity: (..., 2).
    """

    distance: Floats
    intensity: NDArray[np.uint8]


class Beams:
    """One turn's points by channel and azimuth."""

    def __init__(self, cloud: PointCloud, model: LidarModel) -> None:
        azimuth, distance = polar(cloud, model)
        channel = np.argsort(model.rings())[cloud.rings]
        places = np.concatenate([channel * _CHANNEL_DEG + azimuth + turn for turn in (-360.0, 0.0, 360.0)])
        order = np.argsort(places, kind="stable")
        self._places = places[order]
        # One more stands for no echo.
        self._distance = np.append(np.tile(distance, 3)[order], 0.0)
        self._intensity = np.append(np.tile(cloud.intensities, 3)[order], np.uint8(0))

    def echoes(self, channel: NDArray[np.intp], azimuth_deg: Floats, half_deg: float) -> Echoes:
        """What rays meet: the first and the last point (they are one or two) within half a step of each."""
        place = channel * _CHANNEL_DEG + azimuth_deg
        begin = np.searchsorted(self._places, place - half_deg)
        end = np.searchsorted(self._places, place + half_deg)
        both = np.stack((begin, end - 1), axis=-1)
        both[begin == end] = -1
        further = self._distance[both[..., 0]] > self._distance[both[..., 1]]
        both[further] = both[further][..., ::-1]
        return Echoes(self._distance[both], self._intensity[both])


def polar(cloud: PointCloud, model: LidarModel) -> tuple[Floats, Floats]:
    """Clockwise azimuth, deg in [0, 360), and distance, m, of points (N, 3): the inverse of `rays.ends`.

    In the plane a ray of length r at azimuth a ends at x - iy = exp(i a) (r + lever exp(-i lever_deg)).
    """
    x, y, _ = cloud.points.T
    vertical = np.radians(np.sort(model.vertical_deg))[cloud.rings]
    lever = model.lever * cmath.exp(-1j * math.radians(model.lever_deg))
    flat = np.sqrt(np.maximum(x**2 + y**2 - lever.imag**2, 0.0)) - lever.real
    azimuth = np.degrees(np.angle(x - 1j * y) - np.angle(flat + lever))
    return np.mod(azimuth, 360.0), flat / np.cos(vertical)

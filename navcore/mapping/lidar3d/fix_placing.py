"""Which GNSS position belongs to a keyframe, and where on the robot's way it was taken."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.se3 import SE3
from navcore.localization.gnss_noise import GnssNoise, GnssNoiseParams
from navcore.localization.motion_track import MotionTrack
from navcore.mapping.lidar3d.keyframe import PlacedFix
from navcore.maps.site_map import Datum
from navcore.messages import FixQuality, GnssFix

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FixPlacerParams:
    """Parameters of `FixPlacer`.

    Attributes:
        noise: of fixes by quality.
        up_factor: heights are this much worse than places, at least 1 (geometry of the satellites).
    """

    noise: GnssNoiseParams = field(default_factory=GnssNoiseParams)
    up_factor: float = 2.0


class FixPlacer:
    """Gathers the fixes between two keyframes and keeps the best."""

    def __init__(
        self, datum: Datum | None, antenna: tuple[float, float, float], params: FixPlacerParams = FixPlacerParams()
    ) -> None:
        self._frame = None if datum is None else EnuFrame(datum)
        self._antenna, self._params, self._noise = np.array(antenna), params, GnssNoise(params.noise)
        self._fixes: list[GnssFix] = []

    def add(self, fixes: Sequence[GnssFix]) -> None:
        """Those without a position, or no numbers, are passed over."""
        self._fixes += [fix for fix in fixes if self._noise.is_usable(fix.quality) and _is_finite(fix)]

    def clear(self) -> None:
        """Forget what was gathered."""
        self._fixes = []

    def best(self, track: MotionTrack | None, T_odom_base: SE3) -> PlacedFix | None:
        """The surest on the track (of `base_link` in `odom`) as seen from a keyframe; the rest is dropped."""
        fixes, self._fixes = self._fixes, []
        if track is None or self._frame is None:
            return None
        on_track = [f for f in fixes if track.stamps_ns[0] <= f.stamp_ns <= track.stamps_ns[-1]]
        if not on_track:
            return None
        best = min(on_track, key=lambda f: (self._std(f)[0], -f.stamp_ns))
        T_base_then = T_odom_base.inverse() @ track.T_still_base(best.stamp_ns)
        return PlacedFix(
            antenna=T_base_then.apply(self._antenna), place=np.array(self._frame.to_enu(*_geodetic(best))),
            std=self._std(best), quality=int(best.quality),
        )  # fmt: skip

    def _std(self, fix: GnssFix) -> Floats:
        p = self._params
        slow = self._noise.slow(fix)
        east, north = (math.hypot(variance**0.5, slow) for variance in self._noise.white_variances(fix))
        told_up = (fix.std_up_m or 0.0) * p.noise.told_factor
        return np.array((east, north, math.hypot(max(told_up, p.up_factor * max(east, north)), slow)))


def _is_finite(fix: GnssFix) -> bool:
    stds = (fix.std_east_m or 0.0, fix.std_north_m or 0.0, fix.std_up_m or 0.0)
    return bool(np.isfinite((*_geodetic(fix), *stds)).all())


def _geodetic(fix: GnssFix) -> tuple[float, float, float]:
    """Latitude, longitude, deg, and height, m; NaN where it tells none."""
    lat, lon, height = (math.nan if a is None else a for a in (fix.lat_deg, fix.lon_deg, fix.height_m))
    return lat, lon, height


def is_rtk(quality: int) -> bool:
    """Whether a fix of this quality is right to centimetres."""
    return quality == FixQuality.RTK_FIXED

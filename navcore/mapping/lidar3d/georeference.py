"""Where a drive's own frame lies on the Earth: from the fixes along it, though some of them lie."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.fix_placing import is_rtk
from navcore.mapping.lidar3d.keyframe import Keyframe

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class GeoreferenceParams:
    """Parameters of `georeference`.

    Attributes:
        least_fixes: RTK fixes that must agree, at least 3. least_span: m, they must lie so far apart.
        agree: a fix agrees within so much of a drive that has drifted, m, above 0; drift: and this share of the way
            from the pair that is tried, 0 to 0.1.
        pairs: of fixes that are tried, at least 1.
    """

    least_fixes: int = 8
    least_span: float = 10.0
    agree: float = 0.3
    drift: float = 0.01
    pairs: int = 400


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Georeference:
    """Attributes:
    T_map_odom: a first guess, None where there is none. reason: then why, a sentence; else empty.
    """

    T_map_odom: SE3 | None
    reason: str = ""


def georeference(keyframes: Sequence[Keyframe], params: GeoreferenceParams = GeoreferenceParams()) -> Georeference:
    """The level motion that lays most RTK fixes on the drive's antennas, then fits those that agree."""
    fixed = [(k, k.fix) for k in keyframes if k.fix is not None and is_rtk(k.fix.quality)]
    if len(fixed) < params.least_fixes:
        return _without(f"{len(fixed)} of {len(keyframes)} keyframes had an RTK fix, {params.least_fixes} are needed")
    own = np.array([k.T_odom_base.apply(f.antenna) for k, f in fixed])
    places = np.array([f.place for _, f in fixed])
    if float(np.ptp(own[:, :2], axis=0).max()) < params.least_span:
        return _without(f"the RTK fixes lie within {params.least_span:.0f} m of each other")
    agreeing = _agreeing(own, places, np.array([k.driven for k, _ in fixed]), params)
    if agreeing.sum() < params.least_fixes:
        return _without("the RTK fixes contradict the way that was driven")
    return Georeference(T_map_odom=_fitted(own[agreeing], places[agreeing]))


def _without(why: str) -> Georeference:
    words = f"The map is not georeferenced: {why}. Drive where the receiver has an RTK fix, for 10 m at least."
    return Georeference(T_map_odom=None, reason=words)


def _agreeing(own: Floats, places: Floats, driven: Floats, p: GeoreferenceParams) -> NDArray[np.bool_]:
    """Those (N,) that agree with the best pair of fixes; the pairs are the same for the same drive."""
    rng = np.random.default_rng(len(own))
    best = np.zeros(len(own), dtype=np.bool_)
    for i, j in rng.integers(0, len(own), (p.pairs, 2)):
        if np.hypot(*(own[i] - own[j])[:2]) < p.least_span / 2.0:
            continue
        T = _fitted(own[[i, j]], places[[i, j]])
        drift = p.drift * np.minimum(abs(driven - driven[i]), abs(driven - driven[j]))
        agrees = np.hypot(*(T.apply(own) - places)[:, :2].T) <= p.agree + drift
        best = agrees if agrees.sum() > best.sum() else best
    return best


def _fitted(own: Floats, places: Floats) -> SE3:
    """Least squares in the plane; the height is the median's."""
    a, b = own - own.mean(axis=0), places - places.mean(axis=0)
    yaw = math.atan2(float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()), float((a[:, :2] * b[:, :2]).sum()))
    turned = SE3.from_rpy((0.0, 0.0, 0.0), yaw=yaw)
    t = places.mean(axis=0) - turned.apply(own.mean(axis=0))
    t[2] = np.median(places[:, 2] - own[:, 2])
    return SE3(turned.R, t)

"""Any morning: do camera and LiDAR still agree about where the trunks stand, or has a mount been moved?

A sequential test by a ratio of mixtures (Robbins, "Statistical methods related to the law of the iterated logarithm",
Ann. Math. Stat. 41 (1970)): the evidence for a moved mount over that for one as calibrated, each averaged over where
it may be. Were the mount as calibrated, the ratio would ever exceed 1/a with a chance of at most a (Ville's
inequality), so the check may look after every pair and need not decide beforehand how many it takes.
The same table of evidence gives the running estimate. Wrong pairs are part of the model.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError

Floats = NDArray[np.float64]

# Keeps the logarithm of nothing finite.
TINY = 1e-300


@dataclass(frozen=True, slots=True, kw_only=True)
class MountCheckParams:
    """How well calibrated mounts agree, and what an alarm takes. Ours; set on simulated pairs.

    Attributes:
        yaw_std_deg, lateral_std: 1-sigma by which a mount that was not moved differs from its calibration, deg and m:
            the calibration's own error and the play of the mount. > 0.
        moved_std_deg: 1-sigma of how far a mount that was moved is turned, deg; > yaw_std_deg. In every other such
            mount the camera's place is as calibrated, else it is anywhere.
        most_yaw_deg, most_lateral: a moved mount is looked for as far as this, deg and m; > 0.
        false_alarm: chance that a check of a mount that was not moved ever ends in an alarm; 0 to 0.1.
        wrong: share of pairs that are not of one trunk; 0 to 0.5. wrong_deg: half width of where those lie, deg.
        least_std_deg: a pair is not trusted beyond this, deg; > 0.
        observable: the lateral difference is told once its sigma is this share of what nothing told would leave.
    """

    yaw_std_deg: float = 0.15
    lateral_std: float = 0.004
    moved_std_deg: float = 2.0
    most_yaw_deg: float = 8.0
    most_lateral: float = 0.10
    false_alarm: float = 0.001
    wrong: float = 0.10
    wrong_deg: float = 12.0
    least_std_deg: float = 0.1
    observable: float = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class TrunkPair:
    """One trunk as both see it, in `base_link`, from the camera's place.

    Attributes:
        camera_bearing: of the trunk, rad, positive left; camera_std its 1-sigma, rad.
        lidar_bearing: of the LiDAR's trunk as seen from where the camera is said to be, rad; lidar_std.
        distance: of that trunk from the camera, m.
    """

    camera_bearing: float
    camera_std: float
    lidar_bearing: float
    lidar_std: float
    distance: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MountState:
    """What the pairs so far tell.

    Attributes:
        pairs: taken. yaw, yaw_std: by how much the camera is turned to the left of its calibration, rad.
        lateral, lateral_std: by how much it stands to the left of it, m; None where the pairs do not tell.
        moved: the alarm; it stays on.
    """

    pairs: int
    yaw: float
    yaw_std: float
    lateral: float | None
    lateral_std: float | None
    moved: bool


class MountCheck:
    """One check, from its first pair on."""

    def __init__(self, params: MountCheckParams) -> None:
        p = self._params = params
        yaws = np.radians(np.linspace(-p.most_yaw_deg, p.most_yaw_deg, 2 * round(10 * p.most_yaw_deg) + 1))
        laterals = np.linspace(-p.most_lateral, p.most_lateral, 2 * round(p.most_lateral / p.lateral_std) + 1)
        self._yaws, self._laterals = yaws[:, None], laterals[None, :]
        in_place = _normal(self._laterals, p.lateral_std)
        turned = _normal(self._yaws, math.radians(p.moved_std_deg))
        self._as_calibrated = np.log(_normal(self._yaws, math.radians(p.yaw_std_deg)) * in_place + TINY)
        self._anywhere = np.log(turned * (0.5 * in_place + 0.5 / len(laterals)) + TINY)
        self._evidence = np.zeros((len(yaws), len(laterals)))
        self._pairs, self._moved = 0, False

    def add(self, pair: TrunkPair) -> MountState:
        """What is known with this pair too. Raises NotFiniteError, InputError for a pair that cannot be."""
        _check(pair)
        p = self._params
        std = max(math.hypot(pair.camera_std, pair.lidar_std), math.radians(p.least_std_deg))
        # A camera turned left sees a trunk further right, and one that stands further left does too.
        expected = -self._yaws - self._laterals * math.cos(pair.lidar_bearing) / pair.distance
        seen = math.remainder(pair.camera_bearing - pair.lidar_bearing, 2.0 * math.pi)
        right = np.exp(-0.5 * ((seen - expected) / std) ** 2) / (std * math.sqrt(2.0 * math.pi))
        self._evidence += np.log((1.0 - p.wrong) * right + p.wrong / math.radians(2.0 * p.wrong_deg))
        self._pairs += 1
        self._moved = self._moved or self._ratio() > -math.log(p.false_alarm)
        return self.state()

    def state(self) -> MountState:
        """What is known now."""
        yaw, yaw_std = _mean_std(self._yaws, _weights(self._evidence + self._anywhere))
        lateral, lateral_std = _mean_std(self._laterals, _weights(self._evidence))
        told = lateral_std < self._params.observable * self._params.most_lateral / math.sqrt(3.0)
        return MountState(
            pairs=self._pairs, yaw=yaw, yaw_std=yaw_std, lateral=lateral if told else None,
            lateral_std=lateral_std if told else None, moved=self._moved,
        )  # fmt: skip

    def _ratio(self) -> float:
        """Log of the evidence for a mount that was moved over that for one as calibrated."""
        return _log_sum(self._evidence + self._anywhere) - _log_sum(self._evidence + self._as_calibrated)


def _check(pair: TrunkPair) -> None:
    numbers = (pair.camera_bearing, pair.camera_std, pair.lidar_bearing, pair.lidar_std, pair.distance)
    if not all(math.isfinite(n) for n in numbers):
        raise NotFiniteError("A pair of trunks is NaN or infinite.")
    if pair.camera_std < 0.0 or pair.lidar_std < 0.0 or pair.distance < 0.05:
        raise InputError("A pair of trunks must have sigmas of 0 or more and a distance of 5 cm or more.")


def _normal(values: Floats, std: float) -> Floats:
    """Normal weights that add up to 1."""
    weights = np.exp(-0.5 * (values / std) ** 2)
    return np.asarray(weights / weights.sum())


def _weights(logs: Floats) -> Floats:
    """Their exponentials, adding up to 1."""
    return np.asarray(np.exp(logs - _log_sum(logs)))


def _log_sum(logs: Floats) -> float:
    """Log of the sum of their exponentials."""
    most = float(logs.max())
    return most + math.log(float(np.exp(logs - most).sum()))


def _mean_std(values: Floats, weights: Floats) -> tuple[float, float]:
    mean = float((weights * values).sum())
    return mean, math.sqrt(max(float((weights * (values - mean) ** 2).sum()), 0.0))

"""Standing still, the gyro shows nothing but its bias."""

from __future__ import annotations

import numpy as np

from navcore.localization.belief import GYRO_BIAS, Belief
from navcore.localization.correction import Innovation
from navcore.localization.motion_model import MotionModel

NS = 1e-9


def learn_bias(b: Belief, rate: float, motion: MotionModel, gyro_noise: float) -> None:
    """Take one turn rate, rad/s, where the wheels stand; `gyro_noise` as in `MotionParams`."""
    if b.gyro_ns is None or not motion.is_still(b, b.stamp_ns):
        return
    dt = max((b.stamp_ns - b.gyro_ns) * NS, 1e-3)
    H = np.zeros((1, len(b.mean)))
    H[0, GYRO_BIAS] = 1.0
    R = np.array(((gyro_noise**2 / dt,),))
    Innovation(b, H, np.array((rate - b.mean[GYRO_BIAS],)), R).apply()

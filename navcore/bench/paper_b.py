"""What paper B published of trees, lines and tracking, and the conditions it was measured in."""

from __future__ import annotations

from typing import NamedTuple

from navcore.sim.camera_light import LightName

# Association of trees, all segments (2.5.2).
ASSOCIATED = 0.926
# Sunny, overcast, dusk, strong direct light, backlit.
LIGHTS = (LightName.NOON, LightName.OVERCAST, LightName.EVENING, LightName.AFTERNOON, LightName.BACKLIT)


class Tracking(NamedTuple):
    """Lateral deviation: mean and RMS, m, and the share of stations within 10 cm (Tables 5 and 6)."""

    mean: float
    rms: float
    success: float


LIDAR_RANSAC = Tracking(0.070, 0.090, 0.759)
VISION_RANSAC = Tracking(0.066, 0.082, 0.898)
SEGMENTATION = Tracking(0.069, 0.086, 0.870)
FUSED = Tracking(0.052, 0.066, 0.954)

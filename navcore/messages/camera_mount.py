"""How a camera is mounted, as what it sees tells."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraMount:
    """How a camera is mounted, as the plants tell that it was driven up to; each with its 1-sigma.

    Attributes:
        pitch: by so much further down than its settings say it looks, the IMU being right, rad.
        height: above the ground, m; told_height: as its settings say.
    """

    pitch: float
    pitch_std: float
    height: float
    height_std: float
    told_height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MountAgreement:
    """Whether a camera looks where the 2D LiDAR says that its trunks stand.

    Attributes:
        trunks: so many were asked.
        yaw: by so much further left than calibrated the camera looks, rad; yaw_std its 1-sigma.
        moved: surely so: an alarm that stays on.
    """

    trunks: int
    yaw: float
    yaw_std: float
    moved: bool

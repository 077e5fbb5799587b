"""How a camera is really mounted, from how plants come nearer over some metres of a row: its pitch and its height.

A camera that looks further down than told sees what is far too near, and one that stands higher sees all of it too
near in the same proportion: the first bends the distances of a plant that the robot drives up to, the second
stretches them. Wheels that slip stretch them too, so a height is no surer than the wheels.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.messages import CameraMount
from navcore.perception.lean_fit import LeanFitParams, equations, passed, solved
from navcore.perception.plant_sightings import Sightings


@dataclass(frozen=True, slots=True, kw_only=True)
class MountFitParams:
    """Parameters of `fit_mount`.

    Attributes:
        pitch_deg, height: 1-sigma of what is not known before, deg and a share of the height.
        wheels: 1-sigma of the share by which wheels are wrong.
        floor_deg: 1-sigma of the pitch that no number of pictures takes away.
    """

    pitch_deg: float = 3.0
    height: float = 0.2
    wheels: float = 0.04
    floor_deg: float = 0.3


def fit_mount(
    seen: Sightings, height: float, focal_px: float, lean: LeanFitParams, params: MountFitParams
) -> CameraMount | None:
    """Its pitch beyond what each picture's fit has allowed for already. None if too few plants were passed.

    `height` as told, m; `focal_px` at 640 px width.
    """
    seen = passed(seen, lean)
    if len(np.unique(seen.plant)) < 2 * lean.plants:
        return None
    A, b = equations(seen, height, focal_px, lean)
    n, plants, (rows, k) = len(seen.x), len(np.unique(seen.plant)), A.shape
    more = np.zeros((rows + 1, k + 1))
    more[:rows, :k] = A
    more[:n, k] = A[:n, plants : k - 2].sum(axis=1)  # what one picture's pitch does, for all pictures alike
    more[rows - 1, k - 1], more[rows, k] = 1.0 / params.height, 1.0 / math.radians(params.pitch_deg)
    z, information = solved(more, np.append(b, 0.0), n, lean)
    stds = np.sqrt(np.diag(np.linalg.inv(information)))
    return CameraMount(
        pitch=float(z[k]), pitch_std=math.hypot(stds[k], math.radians(params.floor_deg)),
        height=height * (1.0 - float(z[k - 1])), height_std=height * math.hypot(stds[k - 1], params.wheels),
        told_height=height,
    )  # fmt: skip

"""The ground's heights under a 3D map, kept beside the picture that was drawn of it."""

from __future__ import annotations

import io
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from navcore.mapping.trellis.ground_model import GroundModel


def ground_bytes(ground: GroundModel) -> bytes:
    """The file of a ground."""
    file = io.BytesIO()
    np.savez_compressed(file, **asdict(ground))
    return file.getvalue()


def read_ground(path: Path) -> GroundModel:
    """The ground of a file that `ground_bytes` made."""
    # Here, because what makes maps loads scipy, and few farms have one: the station is up without it.
    from navcore.mapping.trellis.ground_model import GroundModel

    with np.load(path, allow_pickle=False) as file:
        return GroundModel(
            x=float(file["x"]), y=float(file["y"]), cell=float(file["cell"]), heights=file["heights"],
            seen=file["seen"],
        )  # fmt: skip

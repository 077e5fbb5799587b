"""A scene on uneven land, for a LiDAR that looks up and down: what stands there, and what each thing is."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from navcore.sim.rays.grid import Ints
from navcore.sim.rays.ground import Ground
from navcore.sim.rays.plan_grid import PlanGrid
from navcore.sim.render.buffers import Floats, Floats32


class Part(IntEnum):
    """What a point lies on. A MIXED one lies between two things, or on none."""

    SOIL = 0
    GRASS = 1
    POST = 2
    ARM = 3
    WIRE = 4
    TRUNK = 5
    LIMB = 6
    BRANCH = 7
    SHOOT = 8
    LEAF = 9
    FENCE = 10
    TREE = 11
    CROWN = 12
    WALL = 13
    MIXED = 14


def _albedos() -> tuple[float, ...]:
    """Share of near infrared light (903 nm) that each `Part` throws back, chosen: leaves shine, bark is dark."""
    shine = dict.fromkeys(Part, 0.3)
    shine |= {
        Part.SOIL: 0.25, Part.GRASS: 0.45, Part.POST: 0.35, Part.ARM: 0.35, Part.TRUNK: 0.25, Part.LIMB: 0.25,
        Part.LEAF: 0.5, Part.CROWN: 0.5, Part.WALL: 0.6,
    }  # fmt: skip
    return tuple(shine[p] for p in Part)


ALBEDO = np.array(_albedos())


class LandScene(NamedTuple):
    """Shapes, where they stand, and the ground under them; `map`, m, z up.

    Attributes:
        shapes: (N, 15) as in `shapes`. kinds: (N,) BEAM, CARD, PANEL, or THREAD for what is thinner than a LiDAR's
            spot. parts: (N,) `Part`.
        boxes: (N, 6) middle and half extent of the box about each.
        grid: over all of them.
        ground: what they stand on.
    """

    shapes: Floats
    kinds: Ints
    parts: Ints
    boxes: Floats32
    grid: PlanGrid
    ground: Ground

"""What the season makes of a trellis: leaves, shoots, grass. Posts and wires know no season."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.sim.orchard import Season


@dataclass(frozen=True, slots=True, kw_only=True)
class Growth:
    """State of what grows. Chosen after photographs of Y-trained pear, not measured.

    Attributes:
        leaves: share of a full canopy's cards of leaves, 0 to 1.
        leaf_size: half width of a card, a bunch of leaves, m.
        leafy: share of a card that is leaf, 0 to 1.
        branches: share of the branches that pruning left, 0 to 1; which ones differs from season to season.
        shoots: share of this year's shoots, 0 to 1. shoot_length: m.
        grass: height in the alleys, m. weeds: height in the strip under the trees, m.
    """

    leaves: float
    leaf_size: float
    leafy: float
    branches: float
    shoots: float
    shoot_length: float
    grass: float
    weeds: float


GROWTH: dict[Season, Growth] = {
    Season.DORMANT: Growth(
        leaves=0.0, leaf_size=0.1, leafy=0.3, branches=0.75, shoots=0.15, shoot_length=0.5, grass=0.05, weeds=0.03
    ),
    Season.BUDDING: Growth(
        leaves=0.3, leaf_size=0.11, leafy=0.4, branches=0.65, shoots=0.4, shoot_length=0.2, grass=0.12, weeds=0.08
    ),
    Season.GROWING: Growth(
        leaves=0.75, leaf_size=0.17, leafy=0.65, branches=0.65, shoots=0.8, shoot_length=0.5, grass=0.16, weeds=0.15
    ),
    Season.MATURING: Growth(
        leaves=1.0, leaf_size=0.2, leafy=0.7, branches=0.65, shoots=1.0, shoot_length=0.8, grass=0.2, weeds=0.2
    ),
    Season.AUTUMN: Growth(
        leaves=0.55, leaf_size=0.18, leafy=0.55, branches=0.65, shoots=1.0, shoot_length=0.8, grass=0.1, weeds=0.12
    ),
}

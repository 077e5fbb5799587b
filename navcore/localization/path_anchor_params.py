"""Parameters of the path's tie to odometry."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.localization.path_slide import PathSlideParams
from navcore.localization.row_filter import RowFilterParams
from navcore.localization.wheel_slip import WheelSlipParams


@dataclass(frozen=True, slots=True, kw_only=True)
class PathAnchorParams:
    """Parameters of `PathAnchor`.

    Attributes:
        slide: how fast the followed path may move to the wanted one.
        row: how what is seen of a row corrects it.
        map_lateral: 1-sigma of where a drawn row lies, m (survey by orthophoto: 0.3 to 0.8 m).
        next_lateral: 1-sigma of where the next row lies, seen from the one that was just left, m.
        map_heading: 1-sigma of its direction, rad.
        left_heading: 1-sigma of the direction by a row that has just been left, rad; left_growth: more per metre.
        map_along: 1-sigma of where it begins and ends, m.
        gate: a row end that lies further off than so many 1-sigma is not believed.
        insist: unless it is seen so many times in a row: then an earlier end was a gap in the row, and the place
            along it is as unsure as the map and the wheels leave it.
        slip: of the wheels.
        growth_along: 1-sigma of the drift along the path, m per square root of m driven (wheel slip).
    """

    slide: PathSlideParams = field(default_factory=PathSlideParams)
    row: RowFilterParams = field(default_factory=RowFilterParams)
    map_lateral: float = 0.45
    next_lateral: float = 0.2
    map_heading: float = 0.03
    left_heading: float = 0.015
    left_growth: float = 0.002
    map_along: float = 0.8
    slip: WheelSlipParams = field(default_factory=WheelSlipParams)
    growth_along: float = 0.15
    gate: float = 3.0
    insist: int = 5

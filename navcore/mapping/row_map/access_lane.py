"""The way from the warehouse to the lanes that were found, where nobody has drawn one yet."""

from __future__ import annotations

import math

from navcore.maps.site_map import Lane, SiteMap

# Straight ahead of the parked robot before the lane begins, m; a shorter lane than the other is none, m.
_AHEAD, _SHORTEST = 3.0, 0.5


def access_lane(site: SiteMap, found: tuple[Lane, ...]) -> Lane | None:
    """Straight from before the warehouse to the nearest end of a found lane; None where a site has lanes."""
    house = site.warehouse
    if house is None or site.lanes or not found:
        return None
    begin = (house.x + _AHEAD * math.cos(house.yaw), house.y + _AHEAD * math.sin(house.yaw))
    ends = [end for lane in found for end in (lane.points[0], lane.points[-1])]
    nearest = min(ends, key=lambda end: math.dist(begin, end))
    if math.dist(begin, nearest) < _SHORTEST:
        return None
    return Lane(id="lane-access", points=((round(begin[0], 3), round(begin[1], 3)), nearest), name="To the rows")

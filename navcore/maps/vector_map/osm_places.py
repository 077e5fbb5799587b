"""Where the nodes of an OSM file lie in `map`."""

from __future__ import annotations

import math

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson_features import Problems
from navcore.maps.site_map import Point
from navcore.maps.vector_map.osm_data import OsmData
from navcore.maps.vector_map.osm_tags import finite

# Positions in degrees are rounded to about 1 um; local ones that lie further off were left behind by an editor, m.
_SAME = 1e-4
# Places further than this from the datum cannot be one farm, m.
_LARGEST = 20_000.0


class OsmPlaces:
    """Places of nodes. Degrees count; local coordinates that say the same are the more exact ones."""

    def __init__(self, osm: OsmData, frame: EnuFrame, is_local: bool, problems: Problems) -> None:
        """`is_local`: the nodes' local coordinates are meant in `frame`."""
        self._osm, self._frame, self._is_local, self._problems = osm, frame, is_local, problems
        self._moved: set[str] = set()

    @staticmethod
    def positions(osm: OsmData) -> list[tuple[float, float]]:
        """Latitude and longitude of all nodes that have sound ones, deg."""
        found = ((finite(node.lat_deg), finite(node.lon_deg)) for node in osm.nodes.values())
        return [(lat, lon) for lat, lon in found if lat is not None and lon is not None and _on_earth(lat, lon)]

    def at(self, ref: str, label: str) -> Point | None:
        """Place of a node in `map`, m; None with a problem told where it has none."""
        node = self._osm.nodes.get(ref)
        if node is None:
            self._problems.add(f"Node {ref[:20]} of {label} is not in the file. Export the whole map.")
            return None
        lat, lon = finite(node.lat_deg), finite(node.lon_deg)
        if lat is None or lon is None or not _on_earth(lat, lon):
            self._problems.add(f"Node {ref[:20]} of {label} has no latitude and longitude on the Earth.")
            return None
        e, n, _ = self._frame.to_enu(lat, lon, self._frame.height_m)
        if not math.hypot(e, n) <= _LARGEST:
            self._problems.add(
                f"Node {ref[:20]} of {label} lies {math.hypot(e, n) / 1000:.0f} km from the site's middle."
            )
            return None
        return self._exact(ref, e, n)

    def line(self, refs: tuple[str, ...], label: str) -> tuple[Point, ...]:
        """Places of nodes in order, none if one of them has no place."""
        places = [self.at(ref, label) for ref in refs]
        known = tuple(place for place in places if place is not None)
        return known if len(known) == len(places) else ()

    def note_moved(self) -> None:
        """Say that nodes were moved by an editor which left their local coordinates behind."""
        if self._moved:
            self._problems.notes.append(
                f"{len(self._moved)} nodes were moved since their local coordinates were written: their latitude and "
                "longitude were taken."
            )

    def _exact(self, ref: str, e: float, n: float) -> Point:
        rounded = (round(e, 6), round(n, 6))
        if not self._is_local:
            return rounded
        tags = self._osm.nodes[ref].tags
        x, y = finite(tags.get("local_x")), finite(tags.get("local_y"))
        if x is None or y is None:
            return rounded
        if math.hypot(x - e, y - n) > _SAME:
            self._moved.add(ref)
            return rounded
        return x, y


def _on_earth(lat: float, lon: float) -> bool:
    return abs(lat) <= 90.0 and abs(lon) <= 180.0

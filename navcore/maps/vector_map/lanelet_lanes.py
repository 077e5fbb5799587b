"""Lanelets and areas of an OSM file as lanes, rows, turns and zones."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import shapely

from navcore.geometry.polyline import Polyline
from navcore.maps.geojson_features import Problems
from navcore.maps.site_map import Lane, Point, Row, Zone, ZoneKind
from navcore.maps.vector_map.osm_data import OsmData, OsmRelation
from navcore.maps.vector_map.osm_places import OsmPlaces
from navcore.maps.vector_map.osm_tags import number_of, speed_limit, text_of
from navcore.maps.vector_map.vector_map import LaneKind, UTurn

_AREAS = {"keepout": ZoneKind.KEEP_OUT, "freespace": ZoneKind.HEADLAND}
_SPEEDS, _WIDTHS, _SPACINGS = (0.05, 5.0), (0.5, 50.0), (0.1, 100.0)
_USUAL_SPEED, _USUAL_WIDTH = {LaneKind.ROAD: 0.8, LaneKind.ALLEY: 0.6, LaneKind.U_TURN: 0.5}, 3.0


class LaneReader:
    """Collects what relations say.

    Attributes:
        other_areas: subtypes of areas that mean nothing here, and how many.
    """

    def __init__(self, osm: OsmData, places: OsmPlaces, problems: Problems) -> None:
        self._osm, self._places, self._problems = osm, places, problems
        self.lanes: list[Lane] = []
        self.rows: list[Row] = []
        self.turns: list[UTurn] = []
        self.zones: list[Zone] = []
        self.other_areas: Counter[str] = Counter()
        self._ids: set[tuple[str, str]] = set()

    def add_lanelet(self, identity: str, relation: OsmRelation) -> None:
        """One lanelet: a road, or what our own tags say it is."""
        label = _label("lanelet", identity, relation)
        given = relation.tags.get("rowpilot:kind", LaneKind.ROAD.value)
        if given not in tuple(LaneKind):
            self._problems.add(f'"rowpilot:kind" of {label} must be one of: {", ".join(LaneKind)}.')
            return
        kind = LaneKind(given)
        line, width = self._course(relation, label)
        if len(set(line)) < 2:
            self._problems.add(
                f"{label[:1].upper()}{label[1:]} has no course: give it a left and a right way of two nodes."
            )
            return
        width = number_of(relation.tags, "rowpilot:width", width, _WIDTHS, label, self._problems)
        name = text_of(relation.tags, "name", "", label, self._problems)
        if kind is LaneKind.U_TURN:
            leaves, enters = (
                text_of(relation.tags, f"rowpilot:{k}", "", label, self._problems) for k in ("leaves", "enters")
            )
            self.turns.append(UTurn(leaves=leaves, enters=enters, line=line))
        elif kind is LaneKind.ALLEY:
            self._add_row(relation, identity, label, line, width, name)
        else:
            speed = self._speed(relation, kind, label)
            own = self._own_id("lane", relation, identity, label)
            self.lanes.append(Lane(id=own, points=line, width=width, speed=speed, name=name))

    def add_area(self, identity: str, relation: OsmRelation) -> None:
        """A headland or a zone; other areas are counted."""
        label = _label("area", identity, relation)
        subtype = relation.tags.get("subtype", "")
        kind = relation.tags.get("rowpilot:kind") or _AREAS.get(subtype)
        if kind is None:
            self.other_areas[subtype] += 1
            return
        if kind not in tuple(ZoneKind):
            self._problems.add(f'"rowpilot:kind" of {label} must be one of: {", ".join(ZoneKind)}.')
            return
        ring = self._ring(relation, label)
        if len(ring) >= 3:
            name = text_of(relation.tags, "name", "", label, self._problems)
            own = self._own_id("zone", relation, identity, label)
            self.zones.append(Zone(id=own, kind=ZoneKind(kind), polygon=ring, name=name))

    def _add_row(
        self, relation: OsmRelation, identity: str, label: str, line: tuple[Point, ...], width: float, name: str
    ) -> None:
        if len(line) != 2:
            self._problems.add(f"The row of {label} has {len(line)} places; a row is straight and has two.")
        post, plant = (
            number_of(relation.tags, f"rowpilot:{key}", usual, _SPACINGS, label, self._problems)
            for key, usual in (("post_spacing", 6.0), ("plant_spacing", 1.5))
        )
        self.rows.append(
            Row(
                id=self._own_id("row", relation, identity, label), start=line[0], end=line[-1], width=width,
                speed=self._speed(relation, LaneKind.ALLEY, label), name=name, post_spacing=post, plant_spacing=plant,
            )
        )  # fmt: skip

    def _course(self, relation: OsmRelation, label: str) -> tuple[tuple[Point, ...], float]:
        """Centre line and width: the file's centre line, else the middle of both edges."""
        sides = {role: self._way(relation, role, label) for role in ("left", "right", "centerline")}
        left, right, centre = sides["left"], sides["right"], sides["centerline"]
        if len(left) < 2 or len(right) < 2:
            return centre, _USUAL_WIDTH
        if math.dist(left[0], right[-1]) + math.dist(left[-1], right[0]) < math.dist(left[0], right[0]) + math.dist(
            left[-1], right[-1]
        ):
            right = right[::-1]
        middle, width = _between(left, right)
        return centre or middle, min(max(width, _WIDTHS[0]), _WIDTHS[1])

    def _way(self, relation: OsmRelation, role: str, label: str) -> tuple[Point, ...]:
        """All ways of a role, one after another."""
        points: list[Point] = []
        for ref in (m.ref for m in relation.members if m.kind == "way" and m.role == role):
            way = self._osm.ways.get(ref)
            if way is None:
                self._problems.add(f"Way {ref[:20]}, {role} of {label}, is not in the file. Export the whole map.")
                return ()
            places = self._places.line(way.nodes, label)
            points += places[1:] if points and places and places[0] == points[-1] else places
        return tuple(points)

    def _ring(self, relation: OsmRelation, label: str) -> tuple[Point, ...]:
        """The outline, without its closing place."""
        if any(member.role == "inner" for member in relation.members):
            self._problems.add(
                f"The outline of {label} has holes, which zones cannot have. Make them keep-out areas."
            )
            return ()
        ring = self._way(relation, "outer", label)
        ring = ring[:-1] if len(ring) > 1 and ring[0] == ring[-1] else ring
        if len(ring) < 3 or not shapely.Polygon(ring).is_valid:
            self._problems.add(f"The outline of {label} needs three places or more, and must not cross itself.")
            return ()
        return ring

    def _speed(self, relation: OsmRelation, kind: LaneKind, label: str) -> float:
        usual = _USUAL_SPEED[kind]
        if "rowpilot:speed" in relation.tags:
            return number_of(relation.tags, "rowpilot:speed", usual, _SPEEDS, label, self._problems)
        limit = speed_limit(relation.tags.get("speed_limit", ""))
        return min(limit, usual) if limit is not None and limit >= _SPEEDS[0] else usual

    def _own_id(self, kind: str, relation: OsmRelation, identity: str, label: str) -> str:
        own = text_of(relation.tags, "rowpilot:id", f"{kind}-{identity}"[:200], label, self._problems)
        if (kind, own) in self._ids:
            self._problems.add(f"The id {own[:60]} of {label} is used twice.")
        self._ids.add((kind, own))
        return own


def _label(kind: str, identity: str, relation: OsmRelation) -> str:
    name = relation.tags.get("name")
    return f'{kind} {identity[:20]} ("{name[:60]}")' if name else f"{kind} {identity[:20]}"


def _between(left: tuple[Point, ...], right: tuple[Point, ...]) -> tuple[tuple[Point, ...], float]:
    """The line half way between two edges, and their mean distance, m."""
    a, b = (Polyline(np.asarray(side, dtype=np.float64)) for side in (left, right))
    shares = np.linspace(0.0, 1.0, max(len(left), len(right)))
    p, q = a.at_all(shares * a.length), b.at_all(shares * b.length)
    middle = [(round(x, 6), round(y, 6)) for x, y in ((p + q) / 2).tolist()]
    line = tuple(m for k, m in enumerate(middle) if k == 0 or m != middle[k - 1])
    return line, float(np.linalg.norm(p - q, axis=1).mean())

"""OpenStreetMap XML as data: nodes, ways and relations, read without trusting the file, and written.

A document type declaration is refused, so no entity is ever expanded and nothing outside the file is read.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeVar
from xml.parsers import expat
from xml.sax.saxutils import quoteattr

from navcore.errors import SiteError

Element = TypeVar("Element")

# A farm of 2000 rows with its edges is 20 MB.
MOST_BYTES = 64 * 2**20
_MOST_DEPTH = 8
# What XML 1.0 cannot hold.
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True, slots=True)
class OsmNode:
    """A place; `lat_deg`, `lon_deg` are None where the file leaves them empty."""

    lat_deg: str | None
    lon_deg: str | None
    tags: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class OsmWay:
    """A line through nodes, by their ids."""

    nodes: tuple[str, ...]
    tags: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class OsmMember:
    """Of a relation: kind is "node", "way" or "relation"."""

    kind: str
    ref: str
    role: str


@dataclass(frozen=True, slots=True)
class OsmRelation:
    """Things that belong together."""

    members: tuple[OsmMember, ...]
    tags: Mapping[str, str]


@dataclass(slots=True)
class OsmData:
    """By id, in the order of the file. `twice` are ids that the file gives to two things of a kind."""

    nodes: dict[str, OsmNode] = field(default_factory=dict)
    ways: dict[str, OsmWay] = field(default_factory=dict)
    relations: dict[str, OsmRelation] = field(default_factory=dict)
    twice: list[str] = field(default_factory=list)


def read_osm(data: bytes) -> OsmData:
    """The elements of a file. Raises SiteError for what is no OSM XML, too large, cut off, or has a DOCTYPE."""
    if len(data) > MOST_BYTES:
        raise SiteError(f"The file is larger than {MOST_BYTES // 2**20} MB. Export a smaller area.")
    reader = _Reader()
    parser = expat.ParserCreate()
    parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.StartElementHandler, parser.EndElementHandler = reader.begin, reader.end
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise SiteError(
            f"The file is no sound OSM XML: {expat.ErrorString(error.code)} in line {error.lineno}. Export it again."
        ) from None
    if not reader.is_osm:
        raise SiteError('The file is no OSM XML: it must begin with the element "osm". Export it as Lanelet2 OSM.')
    return reader.data


def _refuse_doctype(*_: object) -> None:
    raise SiteError("The file has a DOCTYPE, which OSM files do not need and which is refused. Export it again.")


class _Reader:
    """Collects elements as they end."""

    def __init__(self) -> None:
        self.data = OsmData()
        self.is_osm = False
        self._depth = 0
        self._attributes: dict[str, str] = {}
        self._tags: dict[str, str] = {}
        self._nodes: list[str] = []
        self._members: list[OsmMember] = []

    def begin(self, name: str, attributes: dict[str, str]) -> None:
        self._depth += 1
        if self._depth > _MOST_DEPTH:
            raise SiteError("The file's elements are nested too deeply for an OSM file. Export it again.")
        if self._depth == 1:
            self.is_osm = name == "osm"
        elif self._depth == 2:
            self._attributes, self._tags, self._nodes, self._members = attributes, {}, [], []
        elif name == "tag":
            self._tags[attributes.get("k", "")] = attributes.get("v", "")
        elif name == "nd":
            self._nodes.append(attributes.get("ref", ""))
        elif name == "member":
            kind, ref, role = (attributes.get(key, "") for key in ("type", "ref", "role"))
            self._members.append(OsmMember(kind, ref, role))

    def end(self, name: str) -> None:
        self._depth -= 1
        if self._depth != 1 or not self.is_osm or self._attributes.get("action") == "delete":
            return
        identity = self._attributes.get("id", "")
        if name == "node":
            lat, lon = self._attributes.get("lat") or None, self._attributes.get("lon") or None
            self._keep(self.data.nodes, name, identity, OsmNode(lat, lon, self._tags))
        elif name == "way":
            self._keep(self.data.ways, name, identity, OsmWay(tuple(self._nodes), self._tags))
        elif name == "relation":
            self._keep(self.data.relations, name, identity, OsmRelation(tuple(self._members), self._tags))

    def _keep(self, known: dict[str, Element], kind: str, identity: str, element: Element) -> None:
        if identity in known or not identity:
            self.data.twice.append(f"{kind} {identity}")
        known[identity] = element


def write_osm(data: OsmData) -> bytes:
    """The file, UTF-8. Characters that XML cannot hold are left out of texts."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<osm version="0.6" generator="Rowpilot" upload="false">']
    for identity, node in data.nodes.items():
        place = f"lat={quoteattr(node.lat_deg or '')} lon={quoteattr(node.lon_deg or '')}"
        lines += _element("node", identity, place, [], node.tags)
    for identity, way in data.ways.items():
        lines += _element("way", identity, "", [f"<nd ref={quoteattr(ref)}/>" for ref in way.nodes], way.tags)
    for identity, relation in data.relations.items():
        members = [
            f"<member type={quoteattr(m.kind)} ref={quoteattr(m.ref)} role={quoteattr(m.role)}/>"
            for m in relation.members
        ]
        lines += _element("relation", identity, "", members, relation.tags)
    return "\n".join([*lines, "</osm>", ""]).encode()


def _element(kind: str, identity: str, more: str, inner: list[str], tags: Mapping[str, str]) -> list[str]:
    head = f'  <{kind} id={quoteattr(identity)} visible="true" version="1"{" " + more if more else ""}'
    inner = [*inner, *(f"<tag k={_text(key)} v={_text(value)}/>" for key, value in tags.items())]
    return [f"{head}>", *(f"    {line}" for line in inner), f"  </{kind}>"] if inner else [f"{head}/>"]


def _text(value: str) -> str:
    return quoteattr(_FORBIDDEN.sub("", value))

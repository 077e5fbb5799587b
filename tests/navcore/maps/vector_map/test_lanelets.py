"""Lanelet2 OSM: our maps come back to the last digit, other programs' come in, broken ones become sentences."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.errors import SiteError
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, Row, SiteMap, Warehouse, Zone, ZoneKind
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.lanelet_export import vector_map_to_osm
from navcore.maps.vector_map.lanelet_import import import_lanelets
from navcore.maps.vector_map.osm_data import read_osm
from navcore.maps.vector_map.to_site import site_of, turns_of
from navcore.maps.vector_map.vector_map import LaneKind, UTurn, VectorMap
from tests.navcore.maps.test_lossless import sites

# What XML cannot hold is left out on the way out.
_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
DATUM = Datum(lat_deg=41.5, lon_deg=-5.4, height_m=700.0)
FARM = SiteMap(
    name="Pear & <block>", datum=DATUM, warehouse=Warehouse(x=-20.0, y=0.25, yaw=0.1),
    lanes=(Lane(id="road", points=((-20.0, 0.0), (0.0, 0.0), (20.0, 3.0)), width=2.5, speed=0.7, name="Road"),),
    rows=(
        Row(id="r1", start=(4.0, 8.0), end=(4.0, 68.0), width=6.0, name="Row 1"),
        Row(id="r2", start=(10.0, 8.0), end=(10.0, 68.0), width=6.0, name="Row 2"),
    ),
    zones=(
        Zone(id="h", kind=ZoneKind.HEADLAND, polygon=((0.0, 0.0), (14.0, 0.0), (14.0, 8.0), (0.0, 8.0)), name="S"),
        Zone(id="k", kind=ZoneKind.KEEP_OUT, polygon=((30.0, 0.0), (34.0, 0.0), (34.0, 8.0))),
    ),
    plants=(Plant(x=1.0, y=8.0, kind=PlantKind.POST), Plant(x=1.0, y=9.5, kind=PlantKind.TRUNK)),
)  # fmt: skip
TURN = UTurn(leaves="r1", enters="r2", line=((4.0, 8.0), (4.5, 5.0), (7.0, 3.8), (9.5, 5.0), (10.0, 8.0)))
MAP = vector_map_of(FARM, [TURN])
FOREIGN = b"""<?xml version="1.0"?>
<osm version="0.6" generator="another program">
  <node id="-1" lat="41.50000" lon="-5.40000"/><node id="-2" lat="41.50000" lon="-5.39900"/>
  <node id="-3" lat="41.50003" lon="-5.40000"/><node id="-4" lat="41.50003" lon="-5.39900"/>
  <way id="-10"><nd ref="-3"/><nd ref="-4"/><tag k="type" v="line_thin"/></way>
  <way id="-11"><nd ref="-2"/><nd ref="-1"/><tag k="type" v="line_thin"/></way>
  <relation id="-20"><member type="way" ref="-10" role="left"/><member type="way" ref="-11" role="right"/>
    <member type="relation" ref="-22" role="regulatory_element"/>
    <tag k="type" v="lanelet"/><tag k="subtype" v="road"/><tag k="one_way" v="yes"/>
    <tag k="speed_limit" v="2 km/h"/></relation>
  <relation id="-21"><member type="way" ref="-10" role="left"/><member type="way" ref="-11" role="right"/>
    <tag k="type" v="lanelet"/><tag k="subtype" v="crosswalk"/></relation>
  <relation id="-22"><tag k="type" v="regulatory_element"/><tag k="subtype" v="speed_limit"/></relation>
</osm>"""


def refused(data: bytes) -> SiteError:
    with pytest.raises(SiteError) as caught:
        import_lanelets(data)
    return caught.value


def test_a_map_comes_back_to_the_last_digit() -> None:
    data = vector_map_to_osm(MAP)
    imported = import_lanelets(data)
    assert imported.vector_map == MAP
    assert imported.notes == ()
    assert vector_map_to_osm(imported.vector_map) == data


def test_nodes_get_their_height_where_the_ground_is_known() -> None:
    data = vector_map_to_osm(MAP, lambda place: 2.0 if place[0] > 0.0 else None)
    nodes = [node for node in read_osm(data).nodes.values() if "local_x" in node.tags]
    for node in nodes:
        known = float(node.tags["local_x"]) > 0.0
        assert ("ele" in node.tags) is known
        assert not known or abs(float(node.tags["ele"]) - 702.0) < 0.01  # m; the Earth is round
    assert {"ele" in node.tags for node in nodes} == {True, False}
    assert import_lanelets(data).vector_map == import_lanelets(vector_map_to_osm(MAP)).vector_map


def _without_what_xml_lacks(vector_map: VectorMap) -> bool:
    texts = [vector_map.name, vector_map.datum.corrections]
    texts += [text for lane in vector_map.lanes for text in (lane.id, lane.name)]
    texts += [text for zone in vector_map.zones for text in (zone.id, zone.name)]
    texts += [vector_map.warehouse.name] if vector_map.warehouse else []
    return not any(_NO_XML.search(text) for text in texts)


@settings(max_examples=20, deadline=None)
@given(sites)
def test_whatever_is_drawn_comes_back_the_same(site: SiteMap) -> None:
    vector_map = vector_map_of(site)
    if not (site.lanes or site.rows or site.zones) or not _without_what_xml_lacks(vector_map):
        return
    back = import_lanelets(vector_map_to_osm(vector_map)).vector_map
    assert site_of(back) == site
    assert back == vector_map


def test_the_turns_come_back_too() -> None:
    back = import_lanelets(vector_map_to_osm(MAP)).vector_map
    assert turns_of(back) == (TURN,)
    assert [lane.leaves for lane in back.of_kind(LaneKind.U_TURN)] == ["r1"]


def test_a_lanelet_of_another_program_becomes_a_lane_between_its_edges() -> None:
    imported = import_lanelets(FOREIGN)
    (lane,) = site_of(imported.vector_map).lanes
    assert lane.width == pytest.approx(3.33, abs=0.02)  # m: 0.00003 deg of latitude
    assert math.dist(lane.points[0], lane.points[-1]) == pytest.approx(83.5, abs=0.3)  # m: 0.001 deg of longitude
    assert lane.speed == pytest.approx(2.0 / 3.6)  # m/s
    y0, y1 = lane.points[0][1], lane.points[-1][1]
    assert y0 == pytest.approx(y1, abs=0.01)  # m: half way, though one edge is written backwards


def test_what_is_not_used_is_said() -> None:
    notes = " ".join(import_lanelets(FOREIGN).notes)
    assert "1 regulatory elements" in notes
    assert "1 crosswalk" in notes
    assert "one-way" in notes


def test_a_node_that_an_editor_moved_lies_where_it_was_moved_to() -> None:
    data = vector_map_to_osm(MAP).decode()
    moved = re.sub(r'lat="(41\.50007\d+)"', lambda m: f'lat="{float(m[1]) + 1e-5:.11f}"', data)
    assert moved != data
    imported = import_lanelets(moved.encode())
    assert any("were moved" in note for note in imported.notes)
    assert imported.vector_map != MAP


def test_every_problem_is_named_at_once() -> None:
    data = vector_map_to_osm(MAP).decode()
    broken = data.replace('k="rowpilot:width" v="2.5"', 'k="rowpilot:width" v="wide"')
    broken = broken.replace('k="rowpilot:post_spacing" v="6.0"', 'k="rowpilot:post_spacing" v="nan"')
    broken = broken.replace('v="headland"', 'v="heathland"')
    error = refused(broken.encode())
    assert len(error.reasons) == 4
    assert all(reason.endswith(".") for reason in error.reasons)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x00\xff",
        b"<osm>",
        b"{}",
        b"<html></html>",
        b'<osm version="0.6"></osm>',
        b'<!DOCTYPE osm [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><osm><node id="1" lat="&b;" lon="0"/></osm>',
        b'<!DOCTYPE osm SYSTEM "file:///etc/passwd"><osm/>',
        b"<osm>" + b"<a>" * 50 + b"</a>" * 50 + b"</osm>",
        FOREIGN.replace(b'lat="41.50003"', b'lat="NaN"'),
        FOREIGN.replace(b'lat="41.50003"', b'lat="99"'),
        FOREIGN.replace(b'<nd ref="-3"/>', b'<nd ref="-99"/>'),
        FOREIGN.replace(b'ref="-10" role="left"', b'ref="-98" role="left"'),
        FOREIGN.replace(b'lat="41.50000" lon="-5.40000"', b'lat="-41.5" lon="5.4"'),
        FOREIGN.replace(b'id="-2"', b'id="-1"'),
    ],
)
def test_a_bad_file_makes_no_map_and_says_why(data: bytes) -> None:
    error = refused(data)
    assert str(error).endswith(".")
    assert len(str(error)) > 20


def test_no_entity_is_ever_expanded() -> None:
    bomb = b'<!DOCTYPE osm [<!ENTITY a "41.5">]>' + FOREIGN.partition(b"?>")[2].replace(b'"41.50000"', b'"&a;"')
    assert "DOCTYPE" in str(refused(bomb))
    assert "DOCTYPE" in str(refused(b'<!DOCTYPE osm SYSTEM "file:///etc/passwd"><osm/>'))


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_a_mangled_file_is_read_or_refused_in_words(data: st.DataObject) -> None:
    whole = vector_map_to_osm(MAP) if data.draw(st.booleans()) else FOREIGN
    start = data.draw(st.integers(0, len(whole)))
    length = data.draw(st.integers(0, 40))
    mangled = whole[:start] + data.draw(st.binary(max_size=8)) + whole[start + length :]
    try:
        site = site_of(import_lanelets(mangled).vector_map)
    except SiteError as error:
        said = str(error)
    else:
        said = "."
        assert all(math.isfinite(value) for lane in site.lanes for point in lane.points for value in point)
    assert said.endswith(".")

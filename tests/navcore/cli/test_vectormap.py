"""`rowpilot vectormap`: a 3D map in, rows and lanes out, and a sentence where that cannot be."""

from __future__ import annotations

import json
import math
from pathlib import Path
from xml.etree import ElementTree

import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.cloud_file import write_cloud
from navcore.maps.geojson import import_site, site_to_geojson
from navcore.maps.site_map import Datum, SiteMap, Warehouse
from tests.navcore.mapping.standing_block import StandingBlock

RUN = CliRunner()
BLOCK = StandingBlock(lines=3, posts=4)
DATUM = Datum(lat_deg=41.5, lon_deg=-5.4, height_m=700.0)
FARM = SiteMap(name="Farm", datum=DATUM, warehouse=Warehouse(x=-6.0, y=-9.0, yaw=math.pi / 2))


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, str]:
    """The block's map and its farm."""
    folder = tmp_path_factory.mktemp("block")
    write_cloud(folder / "block.pcd", PointCloud.of(BLOCK.seen().points))
    (folder / "farm.geojson").write_text(json.dumps(site_to_geojson(FARM)))
    return str(folder / "block.pcd"), str(folder / "farm.geojson")


def test_rows_are_told_and_written_as_a_site(files: tuple[str, str], tmp_path: Path) -> None:
    cloud, farm = files
    done = RUN.invoke(app, ["vectormap", cloud, "--site", farm, "--out", str(tmp_path / "map.geojson"), "--json"])
    assert done.exit_code == 0, done.stderr
    assert len(json.loads(done.stdout)["rows"]) == 2
    assert len(import_site(json.loads((tmp_path / "map.geojson").read_bytes())).site.rows) == 2


def test_lanelets_know_how_high_the_ground_lies(files: tuple[str, str], tmp_path: Path) -> None:
    cloud, farm = files
    done = RUN.invoke(app, ["vectormap", cloud, "--site", farm, "--out", str(tmp_path / "map.osm")])
    assert done.exit_code == 0, done.stderr
    nodes = ElementTree.parse(tmp_path / "map.osm").getroot().findall("node")
    heights = [float(tag.get("v", "nan")) for node in nodes for tag in node.findall("tag[@k='ele']")]
    assert len(heights) > 0.5 * len(nodes)
    assert min(heights) > 700.0 - 1.0  # m: the ground falls and rises by 2 % from the datum
    assert max(heights) < 700.0 + 1.0  # m


def test_what_cannot_be_done_is_a_sentence(files: tuple[str, str], tmp_path: Path) -> None:
    cloud, farm = files
    for arguments, words in (
        ([cloud, "--out", str(tmp_path / "map.osm")], "give the farm with --site"),
        ([cloud, "--site", farm, "--out", str(tmp_path / "map.pdf")], "must end in .geojson or in .osm"),
        ([cloud, "--vehicle", "tractor"], "There is no vehicle tractor"),
        ([str(tmp_path / "none.pcd")], "none.pcd"),
    ):
        done = RUN.invoke(app, ["vectormap", *arguments])
        assert done.exit_code == 2
        assert words in done.stderr

"""Which farm the robot begins on."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from backend.database import Database
from backend.missions import MissionStore
from backend.settings import Settings
from backend.sites import SiteStore
from navcore.cli.first_farm import BeginningFarm, beginning_farm
from navcore.maps.site_map import SiteMap
from navcore.planning.validation import find_problems
from navcore.sim.demo_farm import demo_farm
from navcore.sim.orthophoto import painter
from navcore.transport.codec import decode
from navcore.vehicle import PROFILES


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    """Of a station that was never started."""
    return Settings(data_dir=tmp_path, keep_free_bytes=0)


@pytest.fixture
def database(settings: Settings) -> Iterator[Database]:
    opened = Database(settings.database_path)
    yield opened
    opened.close()


@pytest.fixture
def no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """The demo farm's picture comes out as something that is none."""
    monkeypatch.setattr(painter, "write_orthophoto", lambda site, path: path.write_bytes(b"no picture"))


def map_of(farm: BeginningFarm) -> SiteMap:
    return decode(SiteMap, farm.path.read_bytes())


def visited(settings: Settings, database: Database, name: str, at_s: int, *, with_warehouse: bool = True) -> str:
    """A farm of the station that the robot was on at that time."""
    site = replace(demo_farm(), name=name)
    site_id = SiteStore(database).create(site if with_warehouse else replace(site, warehouse=None)).id
    note_visit(settings, site_id, at_s)
    return site_id


def note_visit(settings: Settings, site_id: str, at_s: int) -> None:
    file = settings.data_dir / "robot" / f"{site_id}.json"
    file.parent.mkdir(exist_ok=True)
    file.write_text("an older map")
    os.utime(file, (at_s, at_s))


def test_a_newcomer_begins_on_the_demo_farm_with_its_picture(settings: Settings, database: Database) -> None:
    farm = beginning_farm(settings)
    (site,) = SiteStore(database).all()
    assert (site.id, site.name) == (farm.site_id, demo_farm().name)
    assert site.orthophoto is not None
    assert (settings.orthophoto_dir / f"{site.orthophoto.id}.tif").is_file()
    assert map_of(farm) == demo_farm()
    assert list(settings.upload_dir.iterdir()) == []


def test_a_full_disk_keeps_nobody_from_driving(
    settings: Settings, database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(site: SiteMap, path: Path) -> None:
        path.write_bytes(b"half a picture")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(painter, "write_orthophoto", full)
    farm = beginning_farm(settings)
    (site,) = SiteStore(database).all()
    assert (site.id, site.orthophoto) == (farm.site_id, None)
    assert list(settings.upload_dir.iterdir()) == []


@pytest.mark.usefixtures("no_picture")
def test_a_picture_that_fails_keeps_nobody_from_driving(settings: Settings, database: Database) -> None:
    farm = beginning_farm(settings)
    (site,) = SiteStore(database).all()
    assert (site.id, site.orthophoto) == (farm.site_id, None)
    assert map_of(farm) == demo_farm()


@pytest.mark.usefixtures("no_picture")
def test_the_demo_farms_missions_may_be_started_as_they_are(settings: Settings, database: Database) -> None:
    farm = beginning_farm(settings)
    assert farm.site_id is not None
    missions = MissionStore(database).of_site(farm.site_id)
    assert len(missions) == 2
    for stored in missions:
        assert find_problems(demo_farm(), stored.mission, PROFILES[settings.vehicle]) == ()


@pytest.mark.usefixtures("no_picture")
def test_a_second_start_begins_where_the_first_did_and_adds_nothing(settings: Settings, database: Database) -> None:
    assert beginning_farm(settings) == beginning_farm(settings)
    assert len(SiteStore(database).all()) == 1


def test_the_robot_begins_on_the_farm_it_was_on_last(settings: Settings, database: Database) -> None:
    last = visited(settings, database, "last", at_s=2000)
    visited(settings, database, "before", at_s=1000)
    farm = beginning_farm(settings)
    assert farm.site_id == last
    assert map_of(farm).name == "last"


def test_a_farm_that_is_gone_or_has_no_warehouse_is_not_begun_on(settings: Settings, database: Database) -> None:
    good = visited(settings, database, "good", at_s=1000)
    visited(settings, database, "no warehouse", at_s=2000, with_warehouse=False)
    note_visit(settings, "deleted", at_s=3000)
    assert beginning_farm(settings).site_id == good


def test_a_robot_that_was_nowhere_begins_on_a_farm_the_station_does_not_list(
    settings: Settings, database: Database
) -> None:
    SiteStore(database).create(replace(demo_farm(), name="never driven"))
    farm = beginning_farm(settings)
    assert farm.site_id is None
    assert map_of(farm) == demo_farm()


def test_a_real_robots_station_is_given_no_demo_farm(settings: Settings, database: Database) -> None:
    farm = beginning_farm(settings.model_copy(update={"simulated": False}))
    assert farm.site_id is None
    assert SiteStore(database).all() == []

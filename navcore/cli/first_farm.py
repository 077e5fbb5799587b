"""Which farm the robot begins on: where it was last, and at the very first start a demo farm with two missions."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from backend.database import Database
    from backend.models import Orthophoto
    from backend.settings import Settings
    from navcore.maps.mission import Mission
    from navcore.maps.site_map import SiteMap

READY_ROW = "A3"


class BeginningFarm(NamedTuple):
    """The station's id of the farm, None where the station knows none, and its map as a file."""

    site_id: str | None
    path: Path


def beginning_farm(settings: Settings) -> BeginningFarm:
    """The farm to begin on. An empty station of a simulated robot is given the demo farm first."""
    from backend.database import Database
    from backend.sites import SiteStore

    database = Database(settings.database_path)
    try:
        sites = SiteStore(database)
        if settings.simulated and not sites.all():
            _make_demo(settings, database)
        for site_id in _known_to_robot(settings):
            found = next((s for s in sites.all() if s.id == site_id), None)
            if found is not None and (site := sites.get(site_id).site).warehouse is not None:
                return BeginningFarm(site_id, _write(settings.data_dir / "robot" / f"{site_id}.json", site))
    finally:
        database.close()
    return BeginningFarm(None, _write(settings.data_dir / "first_site.json", _demo_site()))


def _known_to_robot(settings: Settings) -> list[str]:
    """Ids of the farms that the robot has been on, the last one first."""
    files = sorted((settings.data_dir / "robot").glob("*.json"), key=lambda f: f.stat().st_mtime_ns, reverse=True)
    return [file.stem for file in files]


def _make_demo(settings: Settings, database: Database) -> None:
    """Demo farm, its picture, and missions that are ready to start."""
    from backend import uploads
    from backend.missions import MissionStore

    uploads.clear(settings)
    site = _demo_site()
    site_id = _store(settings, database, site)
    missions = MissionStore(database)
    for mission in _ready_missions(site):
        missions.create(site_id, mission)
    _write(settings.data_dir / "robot" / f"{site_id}.json", site)


def _store(settings: Settings, database: Database, site: SiteMap) -> str:
    """Id of the farm, stored with its picture; without one where that fails: a newcomer can drive all the same.

    The picture is imported as others are, but here: it is our own, and a process that gives way to all others would
    keep the first start waiting on a busy machine.
    """
    from backend.ids import new_id
    from backend.orthophoto_import import DAMAGED
    from backend.sites import SiteStore
    from navcore.errors import OrthophotoError

    painted = settings.upload_dir / f"{new_id()}.upload"
    try:
        return SiteStore(database).create(site, _picture(settings, site, painted)).id
    except (OrthophotoError, OSError, *DAMAGED):
        return SiteStore(database).create(site).id
    finally:
        painted.unlink(missing_ok=True)
        painted.with_suffix(".tif").unlink(missing_ok=True)


def _picture(settings: Settings, site: SiteMap, painted: Path) -> Orthophoto:
    """The farm from above, painted and imported. Raises OrthophotoError, and OSError on a full disk."""
    from backend.orthophoto_check import CheckParams
    from backend.orthophoto_import import import_picture
    from backend.picture_sites import orthophoto_row
    from backend.picture_store import PictureStore
    from navcore.sim.orthophoto.painter import write_orthophoto

    write_orthophoto(site, painted)
    finished = painted.with_suffix(".tif")
    facts = import_picture(
        painted, finished, CheckParams(decoded_bytes=settings.decoded_limit_bytes), lambda share, words: None
    )
    row = orthophoto_row("Demo farm.tif", asdict(facts))
    PictureStore(settings.orthophoto_dir, settings.tile_dir).take_over(row.id, finished)
    return row


def _ready_missions(site: SiteMap) -> list[Mission]:
    """One that comes back in reverse, and one that changes the row on the headland."""
    from navcore.maps.mission import RowExit
    from navcore.planning.row_mission import mission_for_row

    row = next(row for row in site.rows if row.name == READY_ROW)
    names = {
        RowExit.REVERSE: f"1. Row {READY_ROW}, back out in reverse",
        RowExit.NEXT_ROW: f"2. Row {READY_ROW} and its neighbour, turning on the headland",
    }
    return [replace(mission_for_row(site, row.id, row_exit), name=name) for row_exit, name in names.items()]


def _demo_site() -> SiteMap:
    from navcore.sim.demo_farm import demo_farm

    return demo_farm()


def _write(path: Path, site: SiteMap) -> Path:
    from navcore.disk import write_durably
    from navcore.transport.codec import encode

    write_durably(path, encode(site))
    return path.absolute()

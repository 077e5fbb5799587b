"""A station on real parts: SQLite, Alembic, sockets, the recorder; only the robot is played."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.main import create_app
from backend.settings import Settings
from backend.station import Station
from navcore.maps.mission import Mission, RowVisit, Waypoint
from navcore.maps.site_map import Datum, Lane, Row, SiteMap, Warehouse
from tests.backend.played_robot import PlayedRobot, until
from tests.backend.starting import as_json

ORIGIN = "http://127.0.0.1:8000"


@pytest.fixture
def bus_dir() -> Iterator[Path]:
    """A short path, because socket names must be short."""
    path = Path(tempfile.mkdtemp(prefix="rp-"))
    yield path
    shutil.rmtree(path, ignore_errors=True)


@pytest.fixture
def settings(tmp_path: Path, bus_dir: Path) -> Settings:
    """Of a station with an empty data folder."""
    return Settings(data_dir=tmp_path / "data", bus_dir=bus_dir, keep_free_bytes=0)


@pytest.fixture
def visitor(settings: Settings) -> Iterator[TestClient]:
    """A browser that is not logged in."""
    with TestClient(create_app(settings), base_url=ORIGIN, raise_server_exceptions=False) as client:
        yield client


@pytest.fixture
def station(visitor: TestClient) -> Station:
    """The parts behind the browser."""
    app = visitor.app
    result: Station = app.state.station  # type: ignore[attr-defined]
    return result


@pytest.fixture
def client(visitor: TestClient, station: Station) -> TestClient:
    """A logged-in browser on the station's own page."""
    visitor.get("/enter", params={"token": station.logins.invite()}, follow_redirects=False)
    visitor.headers.update({"Origin": ORIGIN, "X-Rowpilot": "1"})
    return visitor


@pytest.fixture
def site() -> SiteMap:
    """A small farm: a warehouse, a road past two rows."""
    return SiteMap(
        name="Small farm",
        datum=Datum(lat_deg=41.5, lon_deg=-5.4, height_m=700.0),
        warehouse=Warehouse(x=-20.0, y=0.0, yaw=0.0),
        lanes=(Lane(id="road", points=((-20.0, 0.0), (0.0, 0.0), (20.0, 0.0))),),
        rows=(
            Row(id="r1", start=(4.0, 8.0), end=(4.0, 68.0)),
            Row(id="r2", start=(7.0, 8.0), end=(7.0, 68.0)),
        ),
    )


@pytest.fixture
def mission() -> Mission:
    """Along the road and into the first row."""
    return Mission(
        id="",
        name="First row",
        outbound=(Waypoint(x=0.0, y=0.0),),
        visits=(RowVisit(row_id="r1"),),
        inbound=(Waypoint(x=0.0, y=0.0),),
    )


@pytest.fixture
def robot(bus_dir: Path) -> Iterator[PlayedRobot]:
    """A robot at the other end of the bus; to be asked for before the station."""
    played = PlayedRobot(bus_dir)
    yield played
    played.close()


@pytest.fixture
def ready(robot: PlayedRobot, client: TestClient, site: SiteMap) -> dict[str, Any]:
    """A stored mission, the robot on its farm and connected."""
    farm = client.post("/api/sites", json={"site": as_json(site)}).json()
    made = client.post(f"/api/sites/{farm['id']}/missions/for-row", json={"row_id": "r1", "exit": "reverse"}).json()
    mission: dict[str, Any] = client.post(f"/api/sites/{farm['id']}/missions", json={"mission": made}).json()
    assert client.post("/api/robot/site", json={"site_id": farm["id"]}).status_code == 200
    assert until(lambda: client.get("/api/robot").json()["connected"])
    return mission

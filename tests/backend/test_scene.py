"""The 3D view behind the station's login: viser itself, on loopback."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import viser
from fastapi.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from backend.scene_cells import read_cells
from backend.scene_site import posts, show_site, sides, trunks
from backend.scene_trunks import cylinder, sizes, unmapped
from backend.scene_view import SceneView
from backend.settings import Settings
from navcore.maps.ndt.ndt_file import write_ndt_map
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Row, SiteMap
from navcore.maps.trunk_map import MappedTrunk, TrunkMap
from navcore.vehicle import PROFILES
from tests.backend.conftest import ORIGIN

PROTOCOL = f"viser-v{viser.__version__}"
SOCKET = f"{ORIGIN.replace('http', 'ws')}/scene"


@pytest.fixture
def viewer() -> Iterator[viser.ViserServer]:
    """A 3D view on a free port."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    server = viser.ViserServer(host="127.0.0.1", port=port, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def settings(settings: Settings, viewer: viser.ViserServer) -> Settings:
    """Of a station that shows that view; it must not start one of its own."""
    return settings.model_copy(update={"scene_port": viewer.get_port()})


@pytest.fixture(autouse=True)
def no_second_viewer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("backend.scene_process.SceneProcess.start", lambda _: None)


def read_on(browser: Any) -> None:
    """Until the socket ends."""
    for _ in range(10_000):
        browser.receive_bytes()


def test_the_viewer_s_page_comes_through_with_its_own_policy(client: TestClient) -> None:
    answer = client.get("/scene/")
    assert answer.status_code == 200, answer.text[:300]
    assert answer.headers["content-type"].startswith("text/html")
    assert "<title>Viser</title>" in answer.text
    assert answer.text.index("scene-manners.js") < answer.text.index("<script data-p")
    assert "'wasm-unsafe-eval'" in answer.headers["content-security-policy"]
    assert "'unsafe-eval'" not in answer.headers["content-security-policy"]
    assert "frame-ancestors 'self'" in answer.headers["content-security-policy"]
    assert "wasm-unsafe-eval" not in client.get("/drive").headers["content-security-policy"]
    assert client.get("/scene/no-such-file.js").status_code == 404


def test_the_viewer_s_socket_speaks_its_own_protocol_both_ways(client: TestClient, viewer: viser.ViserServer) -> None:
    with client.websocket_connect(SOCKET, subprotocols=[PROTOCOL], headers={"Origin": ORIGIN}) as browser:
        assert str(browser.accepted_subprotocol) == PROTOCOL
        assert len(browser.receive_bytes()) > 0
        browser.send_bytes(b"no message of viser")  # reaches it, so it ends the connection
        with pytest.raises(WebSocketDisconnect):
            read_on(browser)


def test_nobody_sees_the_view_without_a_login(visitor: TestClient) -> None:
    assert visitor.get("/scene/").status_code == 401
    with (
        pytest.raises(WebSocketDisconnect),
        visitor.websocket_connect(SOCKET, subprotocols=[PROTOCOL], headers={"Origin": ORIGIN}),
    ):
        pass


def test_the_view_ends_with_the_login(client: TestClient) -> None:
    with client.websocket_connect(SOCKET, subprotocols=[PROTOCOL], headers={"Origin": ORIGIN}) as browser:
        client.post("/api/session/logout")
        with pytest.raises(WebSocketDisconnect) as ended:
            read_on(browser)
    assert ended.value.code == 4401


def test_without_a_viewer_the_page_says_so(client: TestClient, viewer: viser.ViserServer) -> None:
    assert client.get("/api/robot").json()["scene"] is True
    viewer.stop()
    assert client.get("/api/robot").json()["scene"] is False
    answer = client.get("/scene/")
    assert answer.status_code == 503
    assert "3D view is not running" in answer.json()["message"]


def test_every_row_of_the_farm_stands_in_the_view(site: SiteMap, viewer: viser.ViserServer) -> None:
    view = SceneView(viewer, PROFILES["paper_a"])
    view.show_farm(site, TrunkMap())
    row = site.rows[0]
    along = np.arange(0.0, 60.0 + 1e-6, row.post_spacing)
    found = posts((row,))
    assert found.shape == (2 * len(along), 2, 3)
    assert sorted(set(found[:, 0, 0].tolist())) == [row.start[0] - row.width / 2, row.start[0] + row.width / 2]  # m
    assert np.allclose(np.unique(found[:, 0, 1]), row.start[1] + along, atol=1e-3)  # m
    show_site(viewer.scene, SiteMap(name="Empty", datum=site.datum), planted=())


def test_a_row_without_length_and_a_huge_farm_are_shown_too() -> None:
    assert np.isfinite(posts((Row(id="dot", start=(1.0, 1.0), end=(1.0, 1.0)),))).all()
    many = tuple(Row(id=f"r{i}", start=(3.0 * i, 0.0), end=(3.0 * i, 500.0)) for i in range(200))
    assert len(trunks(many)) <= 20_000


def test_mapped_trunks_stand_in_the_place_of_those_that_the_spacing_promised(
    site: SiteMap, viewer: viser.ViserServer
) -> None:
    row = site.rows[0]
    (x, y), _ = sides(row)[0]
    seen = TrunkMap(trunks=(MappedTrunk(id="a-1", x=x, y=y, std=0.03, diameter=0.12),))
    assert row.id not in {r.id for r in unmapped(site.rows, seen)}
    assert unmapped(site.rows, TrunkMap()) == site.rows
    np.testing.assert_allclose(sizes(seen)[0, :2], 0.06, atol=1e-6)  # m, radius
    view = SceneView(viewer, PROFILES["paper_a"])
    view.show_farm(site, seen)
    view.show_farm(site, TrunkMap())


def test_a_trunk_is_closed_and_looks_outwards() -> None:
    vertices, faces = cylinder()
    a, b, c = (vertices[faces[:, k]].astype(float) for k in range(3))
    normals, centres = np.cross(b - a, c - a), (a + b + c) / 3.0
    outwards = np.einsum("ij,ij->i", normals, centres - (0.0, 0.0, 0.5))
    assert (outwards > 0.0).all()


def test_the_3d_map_is_shown_by_height_and_a_broken_one_is_not(tmp_path: Path) -> None:
    ndt_map = NdtMap()
    points = np.random.default_rng(1).uniform((0.0, 0.0, 0.0), (20.0, 20.0, 3.0), (20_000, 3))
    ndt_map.add(points)
    write_ndt_map(tmp_path / "map.ndt", ndt_map)
    cells = read_cells(tmp_path / "map.ndt")
    assert cells is not None
    assert len(cells.points) == len(cells.colours) == len(ndt_map)
    assert (cells.points >= -0.01).all()
    assert (cells.points <= (20.01, 20.01, 3.01)).all()
    (tmp_path / "map.ndt").write_bytes(b"Rowpilot NDT map, cut off")
    assert read_cells(tmp_path / "map.ndt") is None

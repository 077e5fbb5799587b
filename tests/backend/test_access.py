"""Who gets in, and what a foreign page can do: nothing."""

from __future__ import annotations

import logging
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from fastapi import APIRouter
from fastapi.testclient import TestClient
from starlette.routing import BaseRoute, Mount

from backend import main, permissions
from backend.database import Database
from backend.gate import host_allowed
from backend.headers import page_policy
from backend.logins import LoginBook
from backend.nonces import NonceBook
from backend.permissions import PERMISSIONS, Permission
from backend.server import WithoutQuery
from backend.settings import Settings
from backend.station import Station
from navcore.errors import ContractError
from tests.backend.conftest import ORIGIN

SOME = {"site_id": "0" * 16, "mission_id": "0" * 16, "run_id": "0" * 16, "job_id": "0" * 16, "action": "pause"}
HTTP = [tuple(key.split(" ")) for key in PERMISSIONS if not key.startswith("WEBSOCKET")]


def filled(path: str) -> str:
    numbers = {"{z}": "1", "{x}": "1", "{y}": "1", "{path:path}": "anything"}
    for name, value in {**{f"{{{k}}}": v for k, v in SOME.items()}, **numbers}.items():
        path = path.replace(name, value)
    return path


def test_no_route_answers_without_a_login(visitor: TestClient) -> None:
    closed = [key for key in HTTP if PERMISSIONS[" ".join(key)] is Permission.LOGIN]
    assert len(closed) > 30
    for method, path in closed:
        answer = visitor.request(method, filled(path), headers={"Origin": ORIGIN, "X-Rowpilot": "1"})
        assert answer.status_code == 401, (method, path)


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example", "X-Rowpilot": "1"},
        {"Origin": "null", "X-Rowpilot": "1"},
        {"Origin": "", "X-Rowpilot": "1"},
        {"Origin": ORIGIN, "X-Rowpilot": ""},
        {"Origin": "http://127.0.0.1:8000.evil.example", "X-Rowpilot": "1"},
    ],
)
def test_a_foreign_page_changes_nothing(client: TestClient, headers: dict[str, str]) -> None:
    for method, path in HTTP:
        if method != "GET":
            answer = client.request(method, filled(path), headers=headers, json={})
            assert answer.status_code == 403, (method, path)


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""])
def test_only_json_changes_anything(client: TestClient, kind: str) -> None:
    answer = client.post("/api/sites", content=b'{"site": {}}', headers={"Content-Type": kind})
    assert answer.status_code == 415


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example", "", "[::1", "10.0.0.1"])
def test_a_foreign_name_is_not_answered(client: TestClient, host: str) -> None:
    assert client.get("/api/session", headers={"Host": host}).status_code == 421


def test_an_open_network_is_reached_by_address_and_by_named_hosts_only() -> None:
    opened = Settings(host="0.0.0.0", open_to_network=True, allowed_hosts=("robot.local",))
    assert all(host_allowed(host, opened) for host in ("10.0.0.1:8000", "[fe80::1]:8000", "robot.local"))
    assert not host_allowed("evil.example", opened)


def test_the_network_is_opened_on_purpose_only() -> None:
    with pytest.raises(ValueError, match="OPEN_TO_NETWORK"):
        Settings(host="0.0.0.0")
    assert Settings().host == "127.0.0.1"


def test_the_one_time_address_works_once(visitor: TestClient, station: Station) -> None:
    token = station.logins.invite()
    first = visitor.get("/enter", params={"token": token}, follow_redirects=False)
    assert (first.status_code, first.headers["location"]) == (303, "/")
    cookie = first.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert len(first.cookies[station.settings.cookie_name]) * 6 >= 128  # bits of url-safe base 64
    assert visitor.get("/enter", params={"token": token}, follow_redirects=False).status_code == 403


def test_an_operator_invites_another_browser(client: TestClient) -> None:
    path = client.post("/api/session/invitations").json()["path"]
    client.cookies.clear()
    assert client.get("/api/session").json()["authenticated"] is False
    client.get(path, follow_redirects=False)
    assert client.get("/api/session").json()["authenticated"] is True


def test_a_cookie_is_worth_nothing_after_logout(client: TestClient, station: Station) -> None:
    cookie = client.cookies[station.settings.cookie_name]
    assert client.post("/api/session/logout").status_code == 204
    client.cookies.set(station.settings.cookie_name, cookie)
    assert client.get("/api/sites").status_code == 401


def test_a_login_survives_a_restart_but_not_its_time(tmp_path: Path) -> None:
    clock = [datetime(2026, 5, 1, tzinfo=UTC)]
    database = Database(tmp_path / "logins.sqlite3")

    def book() -> LoginBook:
        return LoginBook(database, timedelta(hours=1), timedelta(hours=3), lambda: clock[0])

    opened = book()
    cookie = opened.enter(opened.invite())
    assert book().find(cookie) is not None
    for _ in range(5):
        clock[0] += timedelta(minutes=40)
        login = opened.find(cookie)
        if login is None:
            break
        opened.seen(login)
    assert clock[0] - datetime(2026, 5, 1, tzinfo=UTC) == timedelta(minutes=200)
    assert book().find(cookie) is None
    database.close()


def test_secrets_are_kept_as_digests_only(client: TestClient, station: Station) -> None:
    cookie = client.cookies[station.settings.cookie_name]
    files = [path for path in station.settings.data_dir.rglob("*") if path.is_file()]
    assert files
    assert not any(cookie.encode() in path.read_bytes() for path in files)


def test_the_access_log_keeps_no_query() -> None:
    record = logging.LogRecord(
        "uvicorn.access",
        logging.INFO,
        "",
        0,
        '%s - "%s %s HTTP/%s" %d',
        ("1", "GET", "/enter?token=x", "1.1", 303),
        None,
    )
    assert WithoutQuery().filter(record)
    assert record.getMessage() == '1 - "GET /enter HTTP/1.1" 303'


@pytest.mark.parametrize("path", ["/api/sites", "/", "/api/nowhere", "/enter?token=x", "/scene/index.html"])
def test_every_answer_carries_the_headers(client: TestClient, path: str) -> None:
    headers = client.get(path, follow_redirects=False).headers
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    policy = headers["content-security-policy"]
    assert "object-src 'none'" in policy
    ours = not path.startswith("/scene/")
    assert ("frame-ancestors 'none'" in policy) is ours
    assert ("unsafe" in policy) is not ours


def test_our_pages_allow_no_inline_and_no_eval() -> None:
    assert "unsafe" not in page_policy("abc")
    assert "http:" not in page_policy()


def test_a_route_without_a_permission_keeps_the_station_from_starting(monkeypatch: pytest.MonkeyPatch) -> None:
    class Careless:
        router = APIRouter()

    @Careless.router.get("/api/careless")
    def careless() -> None:
        """Nobody said who may call this."""

    monkeypatch.setattr(main, "ROOMS", (*main.ROOMS, Careless))
    with pytest.raises(ContractError, match="GET /api/careless"):
        main.bare_app()


@pytest.mark.parametrize("route", [Mount("/files", routes=[]), BaseRoute()])
def test_a_mounted_app_needs_a_permission_too(route: BaseRoute) -> None:
    with pytest.raises(ContractError):
        permissions.check([route])


def test_the_table_has_no_route_that_is_gone() -> None:
    routes = [key for route in main.bare_app().router.routes for key in permissions.keys(route)]
    assert sorted(routes) == sorted(PERMISSIONS)


def test_errors_of_our_own_show_no_trace(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    def stumble(*_: Any) -> None:
        raise ZeroDivisionError("secret path /home/x")

    monkeypatch.setattr("backend.sites.SiteStore.all", stumble)
    answer = client.get("/api/sites")
    assert answer.status_code == 500
    assert "secret" not in answer.text
    assert answer.json()["message"]
    assert answer.headers["connection"] == "close"  # else the browser's next question meets a closed socket


@pytest.mark.parametrize("path", ["/docs", "/redoc", "/openapi.json"])
def test_no_documentation_is_served(client: TestClient, path: str) -> None:
    assert "swagger" not in client.get(path).text.lower()
    assert "paths" not in client.get(path).text


@pytest.mark.parametrize(
    "path",
    [
        *("/../settings.py", "/%2e%2e/settings.py", "/..%2fsettings.py", "/assets/../../settings.py", "/....//x"),
        *("/%00", "/index.html%00", "/%ff", "/" + "a" * 300, "/a" * 3000, "//etc/passwd", "/%5c..%5csettings.py"),
    ],
)
def test_no_path_leaves_the_front_end_and_none_makes_it_stumble(client: TestClient, path: str) -> None:
    answer = client.get(path)
    assert answer.status_code in (200, 404, 503)
    assert "ROWPILOT_" not in answer.text
    assert "root:" not in answer.text


@pytest.mark.parametrize("run_id", ["..", "%2e%2e", "0" * 15, "0" * 15 + "G", "a" * 300])
def test_no_name_from_a_browser_is_a_path(client: TestClient, run_id: str) -> None:
    answer = client.get(f"/api/runs/{run_id}/download")
    assert answer.status_code in (404, 422)


def test_a_nonce_is_good_once_for_its_own_login_and_for_a_while() -> None:
    clock = [0.0]
    book = NonceBook(lambda: clock[0])
    nonce = book.issue("a").nonce
    book.use(nonce, "a")
    for wrong, login, later in (
        (nonce, "a", 0.0),
        (book.issue("a").nonce, "b", 0.0),
        (book.issue("a").nonce, "a", 999.0),
    ):
        clock[0] += later
        with pytest.raises(Exception, match="used already or is too old"):
            book.use(wrong, login)

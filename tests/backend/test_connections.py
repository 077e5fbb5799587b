"""Strangers who only hold connections open take nobody's place."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import suppress
from http.client import HTTPConnection
from threading import Thread

import pytest
import uvicorn
from starlette.responses import PlainTextResponse

from backend import connections, server
from backend.settings import Settings
from tests.backend.played_robot import until

MOST = 4
PATIENCE_S = 20.0  # of the test


@pytest.fixture
def port(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """Of a server that has the station's own settings, but less room and less patience."""
    monkeypatch.setattr(connections, "MOST", MOST)
    monkeypatch.setattr(connections, "HEAD_S", 0.3)
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        serving = uvicorn.Server(server.config(PlainTextResponse("here")))
        thread = Thread(target=serving.run, args=([listener],))
        thread.start()
        assert until(lambda: serving.started)
        yield int(listener.getsockname()[1])
        serving.should_exit = True
        thread.join()


def stranger(port: int, words: bytes) -> socket.socket:
    """Someone who begins and does not go on."""
    held = socket.create_connection(("127.0.0.1", port), PATIENCE_S)
    with suppress(ConnectionError):  # sent away before a word
        held.sendall(words)
    return held


def is_closed(held: socket.socket) -> bool:
    with suppress(ConnectionError):
        while held.recv(4096):
            pass
    held.close()
    return True


def ask(browser: HTTPConnection) -> str:
    """Over the connection that is there."""
    before = browser.sock
    browser.request("GET", "/")
    text = browser.getresponse().read().decode()
    assert before is None or browser.sock is before
    return text


@pytest.mark.parametrize("words", [b"", b"GET / HTT", b"GET / HTTP/1.1\r\nHost: here\r\n"])
def test_a_request_that_does_not_come_to_its_end_is_not_waited_for(port: int, words: bytes) -> None:
    assert is_closed(stranger(port, words))


def test_the_next_request_of_a_connection_is_not_waited_for_either(port: int) -> None:
    answered = stranger(port, b"GET / HTTP/1.1\r\nHost: here\r\n\r\n")
    assert answered.recv(4096).startswith(b"HTTP/1.1 200")
    answered.sendall(b"GET / HTTP/1.1\r\n")
    assert is_closed(answered)


def test_a_browser_keeps_its_connection_while_strangers_come_and_go(port: int) -> None:
    browser = HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    assert ask(browser) == "here"
    for _ in range(3):
        strangers = [stranger(port, b"GET") for _ in range(3 * MOST)]
        assert ask(browser) == "here"
        assert all(is_closed(held) for held in strangers)
    assert ask(browser) == "here"
    browser.close()


def test_whoever_asks_takes_the_place_of_who_has_waited_longest(port: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "HEAD_S", 10 * PATIENCE_S)
    strangers = [stranger(port, b"GET") for _ in range(5 * MOST)]
    browsers = [HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S) for _ in range(MOST)]
    assert [ask(browser) for browser in browsers] == ["here"] * MOST
    assert all(is_closed(held) for held in strangers)
    assert is_closed(stranger(port, b""))  # nobody waits any more: no room
    assert [ask(browser) for browser in browsers] == ["here"] * MOST
    for browser in browsers:
        browser.close()


def test_there_is_room_again_after_strangers_have_gone(port: int) -> None:
    for held in [stranger(port, b"") for _ in range(2 * MOST)]:
        assert is_closed(held)
    newcomer = HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    assert ask(newcomer) == "here"
    newcomer.close()


def test_a_connection_outlasts_the_pauses_between_a_page_s_questions() -> None:
    assert server.config(None).timeout_keep_alive > 2 * 30  # s, the longest pause of the pages


def test_a_port_that_is_taken_is_told_in_a_sentence(settings: Settings) -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        taken = settings.model_copy(update={"port": other.getsockname()[1]})
        with pytest.raises(SystemExit, match="choose another port with --port"):
            server.listen(taken)

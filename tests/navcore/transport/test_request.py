"""Questions and answers between processes."""

from __future__ import annotations

import stat
import threading

import pytest

from navcore.errors import InputError, TransportError
from navcore.messages import Reply, Request, RequestKind
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Replier, Requester


def ask(requester: Requester, request_id: str, timeout_ms: int) -> Reply:
    return requester.ask(Request(kind=RequestKind.HEARTBEAT, request_id=request_id), Reply, timeout_ms)


def answer(endpoints: Endpoints, count: int) -> None:
    with Replier(endpoints.navigator_requests) as replier:
        for _ in range(count):
            data = replier.receive(5000)
            assert data is not None
            replier.reply(Reply(request_id=decode(Request, data).request_id, accepted=True))


def test_after_a_timeout_the_next_question_is_answered_and_not_by_the_old_answer(endpoints: Endpoints) -> None:
    with Requester(endpoints.navigator_requests, "navigator") as requester:
        with pytest.raises(TransportError, match="navigator did not answer"):
            ask(requester, "lost", 50)
        answering = threading.Thread(target=answer, args=(endpoints, 2))
        answering.start()
        replies = [ask(requester, name, 5000).request_id for name in ("first", "second")]
        answering.join()
    assert replies == ["first", "second"]


def test_a_restarted_process_answers_again(endpoints: Endpoints) -> None:
    with Requester(endpoints.navigator_requests, "navigator") as requester:
        for name in ("one", "two"):
            answering = threading.Thread(target=answer, args=(endpoints, 1))
            answering.start()
            assert ask(requester, name, 5000).accepted
            answering.join()


def test_an_answer_of_another_kind_is_refused(endpoints: Endpoints) -> None:
    def answer_nonsense() -> None:
        with Replier(endpoints.navigator_requests) as replier:
            replier.receive(5000)
            replier.reply({"accepted": "perhaps"})

    answering = threading.Thread(target=answer_nonsense)
    answering.start()
    with (
        Requester(endpoints.navigator_requests, "navigator") as requester,
        pytest.raises(InputError, match="no Reply"),
    ):
        ask(requester, "x", 5000)
    answering.join()


def test_request_sockets_are_private(endpoints: Endpoints) -> None:
    with Replier(endpoints.navigator_requests):
        assert stat.S_IMODE(endpoints.navigator_requests.stat().st_mode) == 0o600

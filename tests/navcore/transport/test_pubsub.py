"""Messages between processes."""

from __future__ import annotations

import stat
import time
from pathlib import Path

import pytest

from navcore.errors import TransportError
from navcore.messages import SimTruth
from navcore.topics import CAMERA_VIEW, NAV_PLAN, SIM_TRUTH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import QUEUE_LENGTH, Publisher, Received, Subscriber

DEADLINE_S = 5.0


def truth(stamp_ns: int) -> SimTruth:
    return SimTruth(stamp_ns=stamp_ns, x=1.0, y=2.0, yaw=0.1, roll=0.0, pitch=0.0, v=0.5, omega=0.0)


def publish_until_heard(publisher: Publisher, subscriber: Subscriber, attachment: bytes = b"") -> Received:
    deadline = time.monotonic() + DEADLINE_S
    while time.monotonic() < deadline:
        publisher.publish(SIM_TRUTH.name, truth(7), attachment)
        if received := subscriber.receive(20):
            return received
    raise AssertionError("nothing was heard")


def test_a_subscriber_may_start_before_its_publisher(endpoints: Endpoints) -> None:
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber, Publisher(endpoints, "world") as publisher:
        received = publish_until_heard(publisher, subscriber, b"\x00jpeg")
    assert received.name == SIM_TRUTH.name
    assert decode(SimTruth, received.payload) == truth(7)
    assert received.attachment == b"\x00jpeg"


def test_a_subscriber_finds_a_publisher_that_restarted(endpoints: Endpoints) -> None:
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber:
        for _ in range(2):
            with Publisher(endpoints, "world") as publisher:
                publish_until_heard(publisher, subscriber)


def test_the_same_bytes_are_sent_that_were_encoded_once(endpoints: Endpoints) -> None:
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber, Publisher(endpoints, "world") as publisher:
        publish_until_heard(publisher, subscriber)
        payload = publisher.publish(SIM_TRUTH.name, b'{"already": "encoded"}')
        deadline = time.monotonic() + DEADLINE_S
        while (received := subscriber.receive(100)) is not None and time.monotonic() < deadline:
            if received.payload == payload:
                return
    raise AssertionError("the encoded bytes were not passed on")


def test_a_reader_that_sleeps_never_holds_up_the_publisher(endpoints: Endpoints) -> None:
    """A hundred times more than the queues hold: nothing blocks, and the surplus is lost."""
    big = bytes(4096)
    sent = QUEUE_LENGTH * 100
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber, Publisher(endpoints, "world") as publisher:
        publish_until_heard(publisher, subscriber)
        for stamp in range(sent):
            publisher.publish(SIM_TRUTH.name, truth(stamp), big)
        heard = 0
        while subscriber.receive(100):
            heard += 1
    assert 0 < heard < sent


def test_newest_keeps_one_message_of_each_topic(endpoints: Endpoints) -> None:
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber, Publisher(endpoints, "world") as publisher:
        publish_until_heard(publisher, subscriber)
        for stamp in range(100, 111):
            publisher.publish(SIM_TRUTH.name, truth(stamp))
        deadline = time.monotonic() + DEADLINE_S
        stamps = []
        while time.monotonic() < deadline and 110 not in stamps:
            newest = subscriber.newest(100)
            assert set(newest) <= {SIM_TRUTH.name}
            stamps += [decode(SimTruth, received.payload).stamp_ns for received in newest.values()]
    assert stamps[-1] == 110


def test_topics_of_others_are_not_delivered(endpoints: Endpoints) -> None:
    with Subscriber(endpoints, [SIM_TRUTH.name]) as subscriber, Publisher(endpoints, "row_worker") as other:
        other.publish(CAMERA_VIEW.name, b"{}")
        assert subscriber.receive(50) is None


def test_a_process_publishes_only_its_own_topics(endpoints: Endpoints) -> None:
    with Publisher(endpoints, "world") as publisher, pytest.raises(TransportError, match="navigator"):
        publisher.publish(NAV_PLAN.name, b"{}")


def test_sockets_are_private(endpoints: Endpoints) -> None:
    with Publisher(endpoints, "world"):
        assert stat.S_IMODE(endpoints.directory.stat().st_mode) == 0o700
        assert stat.S_IMODE(endpoints.publisher("world").stat().st_mode) == 0o600


def test_a_directory_too_deep_for_sockets_is_refused_with_advice(tmp_path: Path) -> None:
    with pytest.raises(TransportError, match="shorter"):
        Endpoints(tmp_path / ("deep" * 30)).prepare()

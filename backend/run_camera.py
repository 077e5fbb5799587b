"""The picture that was on the screen at some moment of a run."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path

from mcap.exceptions import McapError
from mcap.reader import make_reader

from backend.errors import NotFoundError
from navcore.recording.foxglove import IMAGE_TOPIC, image_of
from navcore.recording.reader import LogMessage, read_log, wall_offset_ns
from navcore.topics import CAMERA_VIEW, NAV_STATUS

NS = 1_000_000_000
BEFORE_NS = 2 * NS  # an older picture is no longer what was on the screen


def picture_at(path: Path, t_s: float) -> tuple[str, bytes]:
    """Description (ASCII JSON, fit for a header) and JPEG of the newest picture at `t_s` after the first status.

    Raises NotFoundError where no picture was taken in the two seconds before, and LogError.
    """
    at_ns = _first_status_ns(path) + round(t_s * NS)
    newest: LogMessage | None = None
    for message in _pictures(path, at_ns - BEFORE_NS, at_ns):
        if message.attachment and at_ns - BEFORE_NS <= message.stamp_ns <= at_ns:
            newest = message
    if newest is None:
        raise NotFoundError("The camera was not looking at that moment.")
    return json.dumps(json.loads(newest.payload)), newest.attachment


def _first_status_ns(path: Path) -> int:
    for message in read_log(path, (NAV_STATUS.name,)):
        return message.stamp_ns
    raise NotFoundError("This run's log holds no driven track.")


def _pictures(path: Path, from_ns: int, to_ns: int) -> Iterator[LogMessage]:
    """By the file's own index; a log without one, of a run under way or cut off, is read from its beginning."""
    try:
        found = list(_indexed(path, from_ns, to_ns))
    except (McapError, struct.error, EOFError):
        found = []
    return iter(found) if found else _until(read_log(path, (CAMERA_VIEW.name,)), to_ns)


def _indexed(path: Path, from_ns: int, to_ns: int) -> Iterator[LogMessage]:
    offset_ns = wall_offset_ns(path)
    jpeg = b""
    with path.open("rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        if summary is None or not summary.chunk_indexes:
            return
        first_ns, last_ns = max(0, from_ns + offset_ns), max(0, to_ns + offset_ns)
        topics = (IMAGE_TOPIC, CAMERA_VIEW.name)
        for _, channel, message in reader.iter_messages(topics, starting_at=first_ns, ending_at=last_ns):
            if channel.topic == IMAGE_TOPIC:
                jpeg = image_of(message.data)
            else:
                stamp_ns = message.log_time - offset_ns
                yield LogMessage(name=channel.topic, stamp_ns=stamp_ns, payload=message.data, attachment=jpeg)
                jpeg = b""


def _until(messages: Iterator[LogMessage], to_ns: int) -> Iterator[LogMessage]:
    for message in messages:
        if message.stamp_ns > to_ns:
            return
        yield message

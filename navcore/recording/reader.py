"""Reads run logs, also those whose recorder was killed."""

from __future__ import annotations

import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from mcap.exceptions import McapError
from mcap.records import Channel, McapRecord, Message, Metadata
from mcap.stream_reader import CRCValidationError, StreamReader

from navcore.errors import LogError
from navcore.maps.site_map import SiteMap
from navcore.messages import Decision, NavInputs, NavPrelude
from navcore.recording import foxglove
from navcore.recording.run_log import METADATA, WALL_OFFSET
from navcore.topics import CAMERA_VIEW, NAV_DECISION, NAV_INPUTS, NAV_PRELUDE
from navcore.transport.codec import decode

T = TypeVar("T")
TORN = (McapError, CRCValidationError, struct.error, EOFError, UnicodeDecodeError)
LARGEST_RECORD = 1 << 28


@dataclass(frozen=True, slots=True, kw_only=True)
class LogMessage:
    """One message of a log.

    Attributes:
        stamp_ns: monotonic time at which the recorder had it, on the clock of the messages' own stamps.
        payload: JSON as it was published.
        attachment: the JPEG of a `camera/view`, else empty.
    """

    name: str
    stamp_ns: int
    payload: bytes
    attachment: bytes = b""


def read_log(path: Path, topics: Collection[str] | None = None) -> Iterator[LogMessage]:
    """Messages of the given topics (all if None) in the order they were recorded, up to where the file is torn.

    Raises LogError if it is no log of ours.
    """
    names: dict[int, str] = {}
    offset_ns = 0
    jpeg = b""
    for record in _records(path):
        if isinstance(record, Metadata) and record.name == METADATA:
            offset_ns = _wall_offset(path, record.metadata)
        elif isinstance(record, Channel):
            names[record.id] = record.topic
        elif isinstance(record, Message) and (name := names.get(record.channel_id)) is not None:
            if name == foxglove.IMAGE_TOPIC and (topics is None or CAMERA_VIEW.name in topics):
                jpeg = foxglove.image_of(record.data)
            if topics is None or name in topics:
                attachment, jpeg = (jpeg, b"") if name == CAMERA_VIEW.name else (b"", jpeg)
                stamp_ns = record.log_time - offset_ns
                yield LogMessage(name=name, stamp_ns=stamp_ns, payload=record.data, attachment=attachment)


def read_metadata(path: Path) -> dict[str, str]:
    """What the log was started with, and `wall_minus_monotonic_ns`. Raises LogError."""
    for record in _records(path):
        if isinstance(record, Metadata) and record.name == METADATA:
            return dict(record.metadata)
    raise LogError(f"{path.name} is no run log: it does not say which run it holds.")


def read_farm(path: Path) -> SiteMap:
    """The site that the run was started with. Raises LogError, also for a log that does not say."""
    told = read_metadata(path).get("site")
    if not told:
        raise LogError(f"{path.name} does not say on which site it was driven.")
    return decode(SiteMap, told.encode())


def wall_offset_ns(path: Path) -> int:
    """Add it to a monotonic stamp of this log to get ns since 1970. Raises LogError."""
    return _wall_offset(path, read_metadata(path))


def read_typed(path: Path, topic: str, type_: type[T]) -> Iterator[T]:
    """The messages of one topic. Raises LogError, and InputError for a message of another version."""
    return (decode(type_, message.payload) for message in read_log(path, (topic,)))


def read_inputs(path: Path) -> Iterator[NavInputs]:
    """What the navigator consumed since the run's prelude, tick by tick. Raises LogError."""
    start_ns = _start_ns(path)
    return (inputs for inputs in read_typed(path, NAV_INPUTS.name, NavInputs) if inputs.now_ns >= start_ns)


def read_decisions(path: Path) -> Iterator[Decision]:
    """What the navigator decided since the run's prelude, tick by tick. Raises LogError."""
    start_ns = _start_ns(path)
    return (decision for decision in read_typed(path, NAV_DECISION.name, Decision) if decision.stamp_ns >= start_ns)


def read_prelude(path: Path) -> NavPrelude | None:
    """What the navigator had consumed before the run, with its settings; None in a log without."""
    return next(read_typed(path, NAV_PRELUDE.name, NavPrelude), None)


def _start_ns(path: Path) -> int:
    """Monotonic time of the tick that began the run; the recorder listens from a little earlier."""
    prelude = read_prelude(path)
    return 0 if prelude is None else prelude.stamp_ns


def _records(path: Path) -> Iterator[McapRecord]:
    """All records up to the end, or to where a killed recorder left off."""
    try:
        file = path.open("rb")
    except OSError as error:
        raise LogError(f"The log {path.name} cannot be opened: {error.strerror}.") from error
    with file:
        if file.read(8) != b"\x89MCAP0\r\n":
            raise LogError(f"{path.name} is no MCAP file. Choose a log downloaded from a run.")
        file.seek(0)
        records = StreamReader(file, validate_crcs=True, record_size_limit=LARGEST_RECORD).records
        while True:
            try:
                record = next(records, None)
            except TORN:
                return
            if record is None:
                return
            yield record


def _wall_offset(path: Path, metadata: dict[str, str]) -> int:
    try:
        return int(metadata[WALL_OFFSET])
    except (KeyError, ValueError):
        raise LogError(f"{path.name} is no run log: it does not tell its clock.") from None

"""One run as an MCAP file that survives a kill or a power cut: whatever is older than a second is on the disk."""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
from mcap.writer import CompressionType, Writer

from navcore.disk import sync_folder
from navcore.errors import InputError
from navcore.messages import CameraView, GnssFix
from navcore.recording import foxglove
from navcore.recording.requests import RecordingSummary
from navcore.topics import CAMERA_VIEW, GNSS_FIX, TOPICS
from navcore.transport.codec import decode
from navcore.transport.pubsub import Received

METADATA = "run"
WALL_OFFSET = "wall_minus_monotonic_ns"


@dataclass(frozen=True, slots=True, kw_only=True)
class RunLogParams:
    """How much a power cut may cost.

    Attributes:
        chunk_s: a chunk is closed and fsynced after so long, 0 < chunk_s <= 1.
        chunk_bytes: or when it is so large.
    """

    chunk_s: float = 0.8
    chunk_bytes: int = 1 << 20


class RunLog:
    """An open log. Every method may raise OSError: a full disk, a broken one."""

    def __init__(
        self, path: Path, run_id: str, metadata: dict[str, str], now_ns: int, wall_ns: int, params: RunLogParams
    ) -> None:
        """Make the file, which must not exist. `now_ns` is monotonic, `wall_ns` the same instant since 1970."""
        self.path, self.run_id = path, run_id
        self._params = params
        self._file = path.open("xb")
        # uncompressed: readers in the browser bring no decompressor
        self._writer = Writer(self._file, chunk_size=params.chunk_bytes, compression=CompressionType.NONE)
        self._wall_offset_ns = wall_ns - now_ns
        self._started_ns = self._synced_ns = now_ns
        self._channels: dict[str, int] = {}
        self._counts: Counter[str] = Counter()
        self._writer.start(profile="", library="rowpilot")
        own = {"run_id": run_id, WALL_OFFSET: str(self._wall_offset_ns)}
        self._writer.add_metadata(METADATA, metadata | own)
        self._register_topics()
        self._sync(now_ns)
        sync_folder(path.parent)

    def write(self, received: Received, now_ns: int) -> None:
        """Append a message as it came, and what follows from it for other programs."""
        if received.name == CAMERA_VIEW.name and received.attachment:
            self._write_image(received, now_ns)
        self._add(received.name, received.payload, now_ns)
        if received.name == GNSS_FIX.name:
            self._write_location(received, now_ns)
        self.sync_if_due(now_ns)

    def sync_if_due(self, now_ns: int) -> None:
        """Bring to the disk what has waited for `chunk_s`."""
        if now_ns - self._synced_ns >= self._params.chunk_s * 1e9:
            self._sync(now_ns)

    def finish(self) -> None:
        """Write index and summary, and close."""
        self._writer.finish()
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()

    def abandon(self) -> None:
        """Close without another word, after an error; what was synced stays readable."""
        try:
            self._file.close()
        except OSError:  # its last buffer does not fit any more
            return

    def summary(self, now_ns: int, problem: str = "") -> RecordingSummary:
        """How it stands."""
        size = self.path.stat().st_size if self.path.exists() else 0
        return RecordingSummary(
            run_id=self.run_id, path=str(self.path), messages=dict(self._counts), size_bytes=size,
            duration_s=(now_ns - self._started_ns) * 1e-9, problem=problem,
        )  # fmt: skip

    def _register_topics(self) -> None:
        for topic in TOPICS.values():
            if topic.logged:
                self._register(topic.name, topic.type.__name__, schema_of(topic.type))
        self._register(foxglove.IMAGE_TOPIC, foxglove.IMAGE_SCHEMA, foxglove.SCHEMAS[foxglove.IMAGE_SCHEMA])
        self._register(foxglove.LOCATION_TOPIC, foxglove.LOCATION_SCHEMA, foxglove.SCHEMAS[foxglove.LOCATION_SCHEMA])

    def _register(self, topic: str, name: str, schema: dict[str, Any]) -> None:
        schema_id = self._writer.register_schema(name, "jsonschema", msgspec.json.encode(schema))
        self._channels[topic] = self._writer.register_channel(topic, "json", schema_id)

    def _add(self, topic: str, payload: bytes, now_ns: int) -> None:
        log_ns = now_ns + self._wall_offset_ns
        sequence = self._counts[topic]
        self._writer.add_message(self._channels[topic], log_ns, payload, log_ns, sequence)
        self._counts[topic] += 1

    def _write_image(self, received: Received, now_ns: int) -> None:
        try:
            view = decode(CameraView, received.payload)
        except InputError:  # the view is still written as it came
            return
        wall_ns = view.stamp_ns + self._wall_offset_ns
        self._add(foxglove.IMAGE_TOPIC, foxglove.compressed_image(received.attachment, view.camera, wall_ns), now_ns)

    def _write_location(self, received: Received, now_ns: int) -> None:
        try:
            fix = decode(GnssFix, received.payload)
        except InputError:
            return
        location = foxglove.location_fix(fix, fix.stamp_ns + self._wall_offset_ns)
        if location is not None:
            self._add(foxglove.LOCATION_TOPIC, location, now_ns)

    def _sync(self, now_ns: int) -> None:
        self._writer.flush()
        self._file.flush()
        os.fsync(self._file.fileno())
        self._synced_ns = now_ns


def schema_of(type_: type) -> dict[str, Any]:
    """JSON schema of a message with its object on top, as readers of logs expect it."""
    schema = msgspec.json.schema(type_)
    definitions = schema["$defs"]
    return {**definitions[type_.__name__], "$defs": definitions}

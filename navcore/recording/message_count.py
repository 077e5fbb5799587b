"""How many messages of a topic a log holds, without reading them."""

from __future__ import annotations

from pathlib import Path

from mcap.exceptions import McapError
from mcap.reader import make_reader

from navcore.recording.reader import TORN


def message_count(log: Path, topic: str) -> int | None:
    """By the index at the end of the file; None where its recorder was killed before it wrote one."""
    try:
        with log.open("rb") as file:
            summary = make_reader(file).get_summary()
    except (OSError, McapError, *TORN):
        return None
    if summary is None or summary.statistics is None:
        return None
    counts = summary.statistics.channel_message_counts
    return sum(counts.get(channel.id, 0) for channel in summary.channels.values() if channel.topic == topic)

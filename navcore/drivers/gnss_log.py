"""A recorded receiver log -> its epochs one after the other, and what was refused."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from navcore.drivers.log_kinds import kind_of
from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams, Refusal
from navcore.drivers.sentence import Refused
from navcore.errors import LogError
from navcore.messages import GnssFix

PORTION_BYTES = 65_536
SNIFFED_BYTES = 1_048_576
GPS_FIRST_YEAR = 1980
KEPT_REFUSALS = 10_000
FILE = NmeaStreamParams(live=False, close_early=False, earliest_year=GPS_FIRST_YEAR, remembered=PORTION_BYTES)


@dataclass(frozen=True, slots=True)
class LoggedEpoch:
    """One epoch of a log.

    Attributes:
        fix: its stamp means nothing, as arrival times are not recorded.
        clock_ns: UTC time of day, also where no sentence told the date yet.
    """

    fix: GnssFix
    clock_ns: int | None


class GnssLog:
    """Reads a log of NMEA or Unicore text portion by portion, so that memory does not grow with it.

    Binary between the sentences is passed over and counted.

    Attributes:
        refused: what was no evidence, in order; the first KEPT_REFUSALS of them.
        refused_counts: how often each reason occurred, in all.
        unused: valid sentences that carry nothing we need, by kind.
    """

    def __init__(self, path: Path, params: NmeaStreamParams = FILE) -> None:
        self._path = path
        self._stream = NmeaStream(params)
        self.refused: list[Refusal] = []

    @property
    def refused_counts(self) -> Counter[Refused]:
        return self._stream.refused_counts

    @property
    def unused(self) -> dict[str, int]:
        return dict(sorted(self._stream.unused.items()))

    def epochs(self) -> Iterator[LoggedEpoch]:
        """All of them, once.

        Raises:
            LogError: if the file cannot be read, or, at its end, if it held no such text.
        """
        start = b""
        try:
            with self._path.open("rb") as file:
                while portion := file.read(PORTION_BYTES):
                    start += portion[: SNIFFED_BYTES - len(start)]
                    yield from self._taken(self._stream.feed(portion, 0))
        except OSError as error:
            raise LogError(f"Cannot read {self._path}: {error.strerror}. Check path and permissions.") from error
        yield from self._taken(self._stream.flush(0))
        if not self._holds_text():
            raise LogError(self._why_not(start))

    def _taken(self, fixes: list[GnssFix]) -> Iterator[LoggedEpoch]:
        clocks, refusals = list(self._stream.clocks_ns), list(self._stream.refusals)
        self._stream.clocks_ns.clear()
        self._stream.refusals.clear()
        self.refused += refusals[: KEPT_REFUSALS - len(self.refused)]
        yield from map(LoggedEpoch, fixes, clocks)

    def _holds_text(self) -> bool:
        """Sentences, or at least lines that wanted to be some, between which nothing else stood."""
        counts = self._stream.refused_counts
        broken = counts[Refused.TRUNCATED] + counts[Refused.MALFORMED]
        return bool(self._stream.sentences or counts[Refused.CHECKSUM] or (broken and not counts[Refused.NOT_TEXT]))

    def _why_not(self, start: bytes) -> str:
        if not start:
            return f"{self._path} is empty; record the receiver's NMEA output and try again."
        kind, advice = kind_of(start)
        seems = f"it looks like {kind}" if kind else "it is of no kind known here"
        return f"{self._path} holds no NMEA or Unicore text ({seems}); {advice}."

"""A recorded receiver log -> all of its epochs, and all that was refused."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from navcore.drivers.nmea_stream import NmeaStream, NmeaStreamParams, Refusal
from navcore.drivers.sentence import Refused
from navcore.errors import LogError
from navcore.messages import GnssFix

PORTION_BYTES = 65_536
SNIFFED_BYTES = 1_048_576
GPS_FIRST_YEAR = 1980
SIGNATURES = (
    (b"SOURCETABLE 200", "an NTRIP caster's answer"),
    (b"ICY 200 OK", "an NTRIP caster's answer"),
    (b"HTTP/1.", "an NTRIP caster's answer"),
    (b"\nSTR;", "an NTRIP caster's list of streams"),
    (b"\nCAS;", "an NTRIP caster's list of streams"),
    (b"\xb5\x62", "u-blox UBX"),
    (b"\xa0\xa2", "SiRF binary"),
    (b"\x02\x99\x66", "NavCom binary"),
    (b"\x10\x03\x10", "Trimble TSIP"),
    (b"\xd3\x00", "RTCM 3 corrections"),
    (b"\xaa\x44", "NovAtel or Unicore binary"),
)


@dataclass(frozen=True, slots=True)
class GnssLog:
    """What the parser made of a log.

    Attributes:
        epochs: one fix for each epoch; their stamps mean nothing, as arrival times are not recorded.
        refused: everything that was no evidence, in order.
        unused: valid sentences that carry nothing we need, by kind.
    """

    epochs: tuple[GnssFix, ...]
    refused: tuple[Refusal, ...]
    unused: dict[str, int]


def read_gnss_log(path: Path, params: NmeaStreamParams | None = None) -> GnssLog:
    """Read a log of NMEA or Unicore text; binary between the sentences is passed over and counted.

    Raises:
        LogError: if the file cannot be read or holds no such text.
    """
    stream = NmeaStream(params or NmeaStreamParams(live=False, close_early=False, earliest_year=GPS_FIRST_YEAR))
    epochs: list[GnssFix] = []
    refused: list[Refusal] = []
    try:
        with path.open("rb") as file:
            start = file.read(SNIFFED_BYTES)
            file.seek(0)
            while portion := file.read(PORTION_BYTES):
                epochs += stream.feed(portion, 0)
                refused += _drain(stream)
    except OSError as error:
        raise LogError(f"Cannot read {path}: {error.strerror}. Check the path and its permissions.") from error
    epochs += stream.flush(0)
    refused += _drain(stream)
    if not _holds_text(stream):
        raise LogError(_why_not(path, start))
    return GnssLog(tuple(epochs), tuple(refused), dict(sorted(stream.unused.items())))


def _drain(stream: NmeaStream) -> list[Refusal]:
    refused = list(stream.refusals)
    stream.refusals.clear()
    return refused


def _holds_text(stream: NmeaStream) -> bool:
    return stream.sentences > 0 or stream.refused_counts[Refused.CHECKSUM] > 0


def _why_not(path: Path, start: bytes) -> str:
    if not start:
        return f"{path} is empty; record the receiver's NMEA output and try again."
    kind = next((name for mark, name in SIGNATURES if mark in start), None)
    seems = f"it looks like {kind}" if kind else "it is of no kind known here"
    return f"{path} holds no NMEA or Unicore text ({seems}); switch the receiver to NMEA output and record again."

"""One checked sentence of NMEA 0183 or of Unicore / NovAtel text.

Sources: NMEA 0183 v4.11 (XOR checksum); NovAtel OEM7 manual, "32-Bit CRC" (polynomial EDB88320, start 0, no final
XOR); Unicore reference manual R1.4, chapter 2 (the same CRC, also behind `$KSXT`).
"""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass
from enum import StrEnum

from pynmeagps.nmeahelpers import calc_checksum, get_parts

from navcore.errors import SentenceError

SHAPE = re.compile(rb"([$#])([\x20-\x29\x2b-\x7e]+)\*([0-9A-Fa-f]{2}|[0-9A-Fa-f]{8})\s*")
GNSS_TALKERS = frozenset({"GP", "GN", "GL", "GA", "GB", "BD", "GQ", "QZ", "GI"})
VENDORS = ("PASHR", "PTNL", "PUBX", "PSTI")


class Refused(StrEnum):
    """Why something the receiver sent is no evidence."""

    CHECKSUM = "bad checksum"
    TRUNCATED = "truncated: no checksum at its end"
    TOO_LONG = "longer than any sentence"
    NOT_TEXT = "not text"
    NOT_MEASURED = "position typed in or simulated, not measured"
    MALFORMED = "a field is not what the sentence demands"
    TALKER = "talker is no satellite receiver"
    ZERO_POSITION = "position 0, 0"
    TIME = "implausible time"
    DUPLICATE = "epoch was seen before"
    DISAGREES = "position disagrees with the same epoch's other sentences"
    CLOCK_JUMP = "receiver's time jumped"


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence whose checksum is right.

    Attributes:
        kind: "GGA" for `$GNGGA`, "PSTI,030" for proprietary ones, "BESTPOSA" for `#BESTPOSA`.
        talker: "GN"; "P" for proprietary sentences and "#" for Unicore / NovAtel text.
        fields: what stands between the commas after the name; of `#` sentences what stands behind the ";".
        header: the fields before the ";", else empty.
    """

    kind: str
    talker: str
    fields: tuple[str, ...]
    header: tuple[str, ...] = ()


def crc32_novatel(data: bytes) -> int:
    """CRC-32 as Unicore and NovAtel compute it; zlib's own start value and final XOR are undone."""
    return zlib.crc32(data, 0xFFFFFFFF) ^ 0xFFFFFFFF


def read_sentence(line: bytes) -> Sentence:
    """Check and split one line that starts with `$` or `#`.

    Raises:
        SentenceError: with the reason as its text.
    """
    shape = SHAPE.fullmatch(line)
    if shape is None:
        raise SentenceError(_why_no_sentence(line))
    start, content, told = shape.group(1), shape.group(2), shape.group(3)
    if not _checksum_holds(content, told):
        raise SentenceError(Refused.CHECKSUM)
    return _novatel(content) if start == b"#" else _nmea(line)


def _why_no_sentence(line: bytes) -> Refused:
    return Refused.TRUNCATED if b"*" not in line[-10:] else Refused.MALFORMED


def _checksum_holds(content: bytes, told: bytes) -> bool:
    if len(told) == 8:
        return crc32_novatel(content) == int(told, 16)
    return bool(calc_checksum(content.decode("ascii")) == told.decode("ascii").upper())


def _nmea(line: bytes) -> Sentence:
    _, talker, name, fields, _ = get_parts(line.strip())
    if talker == "P" and f"P{name}" in VENDORS and fields:
        return _proprietary(f"P{name}", fields)
    if f"{talker}{name}" == "KSXT":
        return Sentence("KSXT", "P", tuple(fields))
    if talker == "P":
        return Sentence(f"P{name}", "P", tuple(fields))
    return Sentence(name, talker, tuple(fields))


def _proprietary(name: str, fields: list[str]) -> Sentence:
    if name == "PASHR" and fields[0][:1].isdigit():
        return Sentence("PASHR", "P", tuple(fields))
    return Sentence(f"{name},{fields[0]}", "P", tuple(fields[1:]))


def _novatel(content: bytes) -> Sentence:
    head, mark, body = content.decode("ascii").partition(";")
    name, *header = head.split(",")
    if not mark:
        raise SentenceError(Refused.MALFORMED)
    return Sentence(name, "#", tuple(body.split(",")), tuple(header))

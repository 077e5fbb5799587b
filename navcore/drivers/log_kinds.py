"""What a file is that holds no sentences, told from its bytes, so that the refusal can say what to do."""

from __future__ import annotations

RECORD_TEXT = "switch the receiver to NMEA output and record again"
STARTS = (
    (b"\x1f\x8b", "a gzip archive", "unpack it first"),
    (b"PK\x03\x04", "a zip archive", "unpack it first"),
    (b"\xff\xfe", "text in UTF-16", "save it as plain text (ASCII or UTF-8)"),
    (b"\xfe\xff", "text in UTF-16", "save it as plain text (ASCII or UTF-8)"),
    (b'{"class"', "JSON of gpsd", "record the receiver itself, for example by gpspipe -r"),
)
"""What only the first bytes tell."""
MARKS = (
    (b"SOURCETABLE 200", "an NTRIP caster's answer", RECORD_TEXT),
    (b"ICY 200 OK", "an NTRIP caster's answer", RECORD_TEXT),
    (b"HTTP/1.", "an NTRIP caster's answer", RECORD_TEXT),
    (b"\nSTR;", "an NTRIP caster's list of streams", RECORD_TEXT),
    (b"\nCAS;", "an NTRIP caster's list of streams", RECORD_TEXT),
    (b"RINEX VERSION", "RINEX", RECORD_TEXT),
    (b"<gpx", "a GPX track", RECORD_TEXT),
    (b"\xb5\x62", "u-blox UBX", RECORD_TEXT),
    (b"\xa0\xa2", "SiRF binary", RECORD_TEXT),
    (b"\x02\x99\x66", "NavCom binary", RECORD_TEXT),
    (b"\x10\x03\x10", "Trimble TSIP", RECORD_TEXT),
    (b"\xd3\x00", "RTCM 3 corrections", RECORD_TEXT),
    (b"\xaa\x44", "NovAtel or Unicore binary", RECORD_TEXT),
    (b"$@", "Septentrio SBF", RECORD_TEXT),
)
"""Of those that a file holds, the one that comes first tells its kind: two bytes occur by chance further on."""


def kind_of(start: bytes) -> tuple[str, str]:
    """From the beginning of a file: what it seems to be, and what to do."""
    for mark, name, advice in STARTS:
        if start.startswith(mark):
            return name, advice
    places = [(start.find(mark), name, advice) for mark, name, advice in MARKS if mark in start]
    if not places:
        return "", RECORD_TEXT
    return min(places)[1:]

"""Sentences for tests, written by the rule of NMEA 0183 and not by the code under test."""

from __future__ import annotations

from functools import reduce


def sentence(content: str) -> bytes:
    """`$content*HH` with its XOR checksum and line end."""
    checksum = reduce(lambda a, b: a ^ b, content.encode("ascii"), 0)
    return f"${content}*{checksum:02X}\r\n".encode("ascii")


def gga(clock: str, lat: str = "5327.03942", lon: str = "00214.42462", quality: int = 4) -> bytes:
    """Fix data at a place of Manchester."""
    return sentence(f"GNGGA,{clock},{lat},N,{lon},W,{quality},12,0.6,56.0,M,48.5,M,1.0,0000")


def rmc(clock: str, day: str = "060321", status: str = "A") -> bytes:
    """Recommended minimum at the same place."""
    return sentence(f"GNRMC,{clock},{status},5327.03942,N,00214.42462,W,1.000,90.0,{day},,,R,V")


def hdt(heading_deg: float) -> bytes:
    """True heading."""
    return sentence(f"GNHDT,{heading_deg:.2f},T")


def hash_log(content: str) -> bytes:
    """`#content*hhhhhhhh` with its CRC-32, bit by bit as in NovAtel's manual."""
    crc = 0
    for byte in content.encode("ascii"):
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0xEDB88320 if crc & 1 else 0)
    return f"#{content}*{crc:08x}\r\n".encode("ascii")

"""Datagrams of a recorded capture: pcap or pcapng, as tcpdump and Wireshark write them."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import dpkt

from navcore.errors import LogError

MOST_BYTES = 262_144
_ETHERNET = 1
# How packets of each kind of link begin: as Ethernet frames, as Linux tells "any" card, or with their IP header.
_LINKS = {
    _ETHERNET: dpkt.ethernet.Ethernet, 113: dpkt.sll.SLL, 276: dpkt.sll2.SLL2, 0: dpkt.loopback.Loopback,
    12: dpkt.ip.IP, 101: dpkt.ip.IP, 228: dpkt.ip.IP,
}  # fmt: skip


class Datagram(NamedTuple):
    """Attributes:
    arrived_ns: wall clock of the computer that captured it. sender: address. port: that it was sent to.
    """

    arrived_ns: int
    sender: str
    port: int
    data: bytes


class CaptureFile:
    """A capture, read packet by packet.

    Attributes:
        others: packets that hold no UDP datagram. broken: the file is damaged, or breaks off, behind what was read.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.others = 0
        self.broken = False

    def datagrams(self) -> Iterator[Datagram]:
        """All of them, in the order in which they were captured.

        Raises:
            LogError: if the file cannot be read or is no capture.
        """
        self.others, self.broken = 0, False
        try:
            with self._path.open("rb") as file:
                yield from self._read(file)
        except OSError as error:
            raise LogError(f"Cannot read {self._path}: {error.strerror}. Check path and permissions.") from error

    def _read(self, file: BinaryIO) -> Iterator[Datagram]:
        reader = self._reader(file)
        link = _LINKS.get(reader.datalink())
        if link is None:
            raise LogError(
                f"{self._path} was captured on a link of kind {reader.datalink()}, which is not known here; capture "
                "the network card that the LiDAR is plugged into."
            )
        for seconds, frame in self._frames(reader):
            datagram = _datagram(link, frame, round(seconds * 1_000_000_000))
            if datagram is not None:
                yield datagram
            else:
                self.others += 1

    def _reader(self, file: BinaryIO) -> Any:
        try:
            return dpkt.pcap.UniversalReader(_Bounded(file))
        except (ValueError, dpkt.UnpackError) as error:
            raise LogError(
                f"{self._path} is no capture of network packets (pcap, pcapng); record one with tcpdump or Wireshark."
            ) from error

    def _frames(self, reader: Any) -> Iterator[tuple[Any, bytes]]:
        """Up to where the file breaks off."""
        frames = iter(reader)
        while True:
            try:
                yield next(frames)
            except StopIteration:
                return
            except (ValueError, dpkt.UnpackError):
                self.broken = True
                return


class _Bounded:
    """A file of which nobody reads more at once than a packet can hold, whatever a damaged length says."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self.seek = file.seek

    def read(self, size: int) -> bytes:
        """All of it. Raises ValueError for more or less than can be."""
        if not 0 <= size <= MOST_BYTES:
            raise ValueError(f"{size} bytes of one packet")
        data = self._file.read(size)
        if 0 < len(data) < size:
            raise ValueError("the file breaks off")
        return data


def _datagram(link: Any, frame: bytes, arrived_ns: int) -> Datagram | None:
    """None for what holds no UDP datagram over IPv4."""
    try:
        packet = link(frame)
    except (ValueError, IndexError, dpkt.UnpackError):
        return None
    while not isinstance(packet, dpkt.ip.IP):
        packet = getattr(packet, "data", None)
        if packet is None or isinstance(packet, bytes):
            return None
    udp = packet.data
    if not isinstance(udp, dpkt.udp.UDP):
        return None
    return Datagram(arrived_ns, socket.inet_ntoa(packet.src), udp.dport, bytes(udp.data))

"""Captures of datagrams, as tcpdump writes them."""

from __future__ import annotations

import socket
from collections.abc import Iterable
from pathlib import Path

import dpkt

LIDAR, COMPUTER = "192.168.1.200", "192.168.1.102"


def frame(data: bytes, *, sender: str = LIDAR, port: int = 2368) -> bytes:
    """An Ethernet frame with that datagram in it."""
    udp = dpkt.udp.UDP(sport=port, dport=port, ulen=8 + len(data), data=data)
    ip = dpkt.ip.IP(src=socket.inet_aton(sender), dst=socket.inet_aton(COMPUTER), p=dpkt.ip.IP_PROTO_UDP, data=udp)
    ip.len = 28 + len(data)
    return bytes(dpkt.ethernet.Ethernet(data=ip))


def write_capture(path: Path, coming: Iterable[tuple[bytes, int]], sender: str = LIDAR, *, ng: bool = False) -> Path:
    """Datagrams with the time, ns, at which each came."""
    return write_frames(path, ((frame(data, sender=sender), at) for data, at in coming), ng=ng)


def write_frames(path: Path, frames: Iterable[tuple[bytes, int]], *, ng: bool = False, link: int = 1) -> Path:
    with path.open("wb") as file:
        writer = dpkt.pcapng.Writer(file) if ng else dpkt.pcap.Writer(file, linktype=link)
        for data, at in frames:
            writer.writepkt(data, at * 1e-9)
    return path

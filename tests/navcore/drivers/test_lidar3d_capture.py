"""Captures of a LiDAR's datagrams, whole, cut off, damaged, of several LiDARs, and files that are none."""

from __future__ import annotations

from pathlib import Path

import dpkt
import numpy as np
import pytest

from navcore.drivers.lidar3d.capture_file import CaptureFile
from navcore.drivers.lidar3d.capture_turns import CaptureTurns
from navcore.drivers.lidar3d.models import C16, MODELS, ModelName
from navcore.drivers.lidar3d.refusals import Refused
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.errors import LogError
from tests.navcore.drivers.lidar3d_captures import LIDAR, frame, write_capture, write_frames
from tests.navcore.drivers.lidar3d_scenes import arrivals, datagrams, fed

COMING = arrivals(C16, datagrams(ModelName.C16))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return write_capture(tmp_path / "c16.pcap", COMING)


@pytest.mark.parametrize("ng", [False, True])
def test_a_capture_holds_the_datagrams_as_they_came(tmp_path: Path, ng: bool) -> None:
    file = CaptureFile(write_capture(tmp_path / "capture", COMING, ng=ng))
    found = list(file.datagrams())
    assert [d.data for d in found] == [data for data, _ in COMING]
    assert [d.arrived_ns for d in found] == pytest.approx([at for _, at in COMING], abs=1500)  # ns: whole us
    assert {(d.sender, d.port) for d in found} == {(LIDAR, 2368)}
    assert (file.others, file.broken) == (0, False)


def test_its_turns_are_those_of_the_live_lidar(path: Path) -> None:
    live, captured = fed(LidarStream(C16), COMING), list(CaptureTurns(path, C16).turns())
    assert len(live) == len(captured) == 2
    for one, other in zip(live, captured, strict=True):
        assert np.array_equal(one.cloud.points, other.cloud.points)
        assert one.stamp_ns == pytest.approx(other.stamp_ns, abs=2000)  # ns


def test_incomplete_turns_at_both_ends_are_told_on_request(path: Path) -> None:
    turns = list(CaptureTurns(path, incomplete=True).turns())
    assert [turn.whole for turn in turns] == [False, True, True, False]
    data = sum(1 for packet, _ in COMING if packet.startswith(b"\xff\xee"))
    assert sum(len(turn.cloud) for turn in turns) == pytest.approx(data * 384, abs=20)


def test_the_model_is_found_in_device_packets_or_asked_for(tmp_path: Path, path: Path) -> None:
    assert CaptureTurns(path).stream.model == C16
    silent = write_capture(tmp_path / "silent.pcap", [each for each in COMING if each[0].startswith(b"\xff\xee")])
    with pytest.raises(LogError, match=r"do not say which LiDAR sent them. Name its model. Known are vlp16, c16"):
        CaptureTurns(silent)
    assert len(list(CaptureTurns(silent, C16).turns())) == 2


def test_a_capture_of_another_model_is_refused(path: Path) -> None:
    with pytest.raises(LogError, match=r"angles are those of a Leishen C16 \(2 deg\), but it is set to be"):
        list(CaptureTurns(path, MODELS[ModelName.C16_FINE]).turns())


def test_of_several_lidars_one_must_be_named(tmp_path: Path) -> None:
    both = [(frame(data, sender=sender), at) for data, at in COMING for sender in (LIDAR, "192.168.1.201")]
    path = write_frames(tmp_path / "both.pcap", both)
    with pytest.raises(LogError, match=r"holds LiDARs at 192.168.1.200, 192.168.1.201; name the one that is meant"):
        CaptureTurns(path)
    with pytest.raises(LogError, match=r"holds no LiDAR at 10.0.0.1; those in it are at"):
        CaptureTurns(path, sender="10.0.0.1")
    capture = CaptureTurns(path, sender="192.168.1.201")
    assert len(list(capture.turns())) == 2
    assert not capture.stream.refused


def test_a_capture_that_breaks_off_is_read_so_far(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-500])
    file = CaptureFile(path)
    assert len(list(file.datagrams())) == len(COMING) - 1
    assert file.broken


def test_packets_that_were_captured_in_part_are_called_short(tmp_path: Path) -> None:
    """As tcpdump -s 600 does it."""
    frames = [(frame(data)[: 600 if n == 150 else None], at) for n, (data, at) in enumerate(COMING)]
    capture = CaptureTurns(write_frames(tmp_path / "short.pcap", frames))
    assert [turn.lost for turn in capture.turns()] == [1, 0]
    assert capture.stream.refused == {Refused.SHORT: 1}


def test_other_packets_in_between_are_counted_and_passed_over(tmp_path: Path) -> None:
    arp, nothing = bytes(dpkt.ethernet.Ethernet(type=0x0806, data=bytes(28))), b""
    frames = [(frame(data), at) for data, at in COMING]
    frames[100:100] = [(arp, COMING[100][1]), (nothing, COMING[100][1]), (b"\x01" * 9, COMING[100][1])]
    capture = CaptureTurns(write_frames(tmp_path / "others.pcap", frames))
    assert len(list(capture.turns())) == 2
    assert capture.file.others == 3


def test_links_other_than_ethernet_are_known_or_named(tmp_path: Path) -> None:
    raw = [(frame(data)[14:], at) for data, at in COMING]
    assert len(list(CaptureFile(write_frames(tmp_path / "raw.pcap", raw, link=101)).datagrams())) == len(COMING)
    with pytest.raises(LogError, match=r"a link of kind 105, which is not known here; capture the network card"):
        list(CaptureFile(write_frames(tmp_path / "wlan.pcap", raw, link=105)).datagrams())


@pytest.mark.parametrize("content", [b"", b"hello" * 100, b"\xd4\xc3\xb2\xa1" + b"\x00" * 5, bytes(3000)])
def test_what_is_no_capture_is_refused_with_a_sentence(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "other.pcap"
    path.write_bytes(content)
    with pytest.raises(LogError, match=r"is no capture of network packets \(pcap, pcapng\)"):
        CaptureTurns(path)


def test_a_capture_without_a_lidar_is_refused_with_a_sentence(tmp_path: Path) -> None:
    path = write_capture(tmp_path / "dns.pcap", [(b"\x12\x34\x01\x00", 0)] * 5)
    with pytest.raises(LogError, match="holds no packets of a LiDAR that is known here"):
        CaptureTurns(path)


def count_or_words(path: Path) -> int | str:
    """Datagrams, or why there are none."""
    try:
        return sum(1 for _ in CaptureFile(path).datagrams())
    except LogError as error:
        return str(error)


@pytest.mark.parametrize("ng", [False, True])
def test_no_damage_makes_the_reader_fail(tmp_path: Path, ng: bool) -> None:
    sound = write_capture(tmp_path / "sound", COMING[:40], ng=ng).read_bytes()
    rng, path = np.random.default_rng(7), tmp_path / "damaged"
    for _ in range(60):
        damaged = bytearray(sound)
        for at in rng.integers(0, len(sound), 30):
            damaged[at] = int(rng.integers(256))
        path.write_bytes(bytes(damaged))
        found = count_or_words(path)
        assert found in range(41) or str(found).startswith(str(path))

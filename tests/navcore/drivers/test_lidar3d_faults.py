"""What is made of packets that are lost, come twice, come late, are cut short, or are no packets of this LiDAR."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.drivers.lidar3d.models import C16, C16_FINE, VLP16, LidarModel, ModelName
from navcore.drivers.lidar3d.refusals import Refused
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from tests.navcore.drivers.lidar3d_scenes import BEGAN_NS, arrivals, datagrams, fed, off_walls

PACKET_NS = 1_200_000
DATA = tuple(d for d in datagrams(ModelName.C16, seconds=0.53) if d.startswith(b"\xff\xee"))
COMING = arrivals(C16, DATA)


def shown(turns: list[Turn]) -> bool:
    """Nothing but the room."""
    return all(len(turn.cloud) and off_walls(turn.cloud).max() < 0.002 for turn in turns)  # m


def with_clock(data: bytes, counter_us: int) -> bytes:
    return data[:1200] + struct.pack("<I", counter_us) + data[1204:]


def test_undisturbed_there_are_four_turns() -> None:
    stream = LidarStream(C16)
    turns = fed(stream, COMING)
    assert [turn.lost for turn in turns] == [0, 0, 0, 0]
    assert (stream.lost, stream.refused.total()) == (0, 0)
    assert shown(turns)


def test_lost_packets_are_counted_and_their_turn_goes_without_them() -> None:
    stream = LidarStream(C16)
    turns = fed(stream, [packet for n, packet in enumerate(COMING) if n not in (120, 121, 140, 300)])
    assert [turn.lost for turn in turns] == [3, 0, 1, 0]
    assert len(turns[0].cloud) == len(turns[1].cloud) - 3 * 384
    assert stream.lost == 4
    assert shown(turns)


def test_a_turn_of_which_much_was_lost_is_refused_and_the_next_is_whole() -> None:
    stream = LidarStream(C16)
    turns = fed(stream, COMING[:110] + COMING[140:])
    assert [turn.lost for turn in turns] == [0, 0, 0]
    assert stream.refused == {Refused.TORN_TURN: 1}
    assert stream.lost == 30


def test_packets_that_come_twice_or_late_are_passed_over() -> None:
    coming = list(COMING)
    coming.insert(150, coming[149])
    coming[250], coming[251] = (coming[251][0], coming[250][1]), (coming[250][0], coming[251][1])
    stream = LidarStream(C16)
    turns = fed(stream, coming)
    assert stream.refused == {Refused.REPEATED: 1, Refused.LATE: 1}
    assert [len(turn.cloud) for turn in turns] == pytest.approx([32_000, 32_000, 32_000, 32_000], abs=400)
    assert shown(turns)


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (DATA[0][:700], Refused.SHORT),
        (b"", Refused.FOREIGN),
        (b"\x00" * 1206, Refused.FOREIGN),
        (b"$GPRMC,081802.00,A*2E\r\n", Refused.FOREIGN),
        (DATA[0][:1204] + b"\x12\x10", Refused.FOREIGN),
        (DATA[0][:500] + b"\x00" + DATA[0][501:], Refused.FOREIGN),
        (DATA[0][:2] + b"\xff\xff" + DATA[0][4:], Refused.AZIMUTH),
        (DATA[0][:100] * 12 + DATA[0][1200:], Refused.AZIMUTH),
        (DATA[0][:1205] + b"\x22", Refused.OTHER_MODEL),
        (datagrams(ModelName.C16, dual=True)[1][:2] + b"\x01\x00" + datagrams(ModelName.C16, dual=True)[1][4:],
         Refused.AZIMUTH),
    ],
)  # fmt: skip
def test_what_is_no_sound_packet_is_named_and_disturbs_nothing(data: bytes, reason: Refused) -> None:
    stream = LidarStream(C16)
    turns = fed(stream, [*COMING[:200], (data, COMING[199][1]), *COMING[200:]])
    assert stream.refused == {reason: 1}
    assert len(turns) == 4
    assert shown(turns)
    assert stream.contradiction == ""


def test_a_head_that_jumps_back_drops_the_turn() -> None:
    """Its packets go on in time, but show once more what was shown."""
    jumped = [
        (with_clock(data, 100_000 + 1200 * n), BEGAN_NS + n * PACKET_NS)
        for n, data in enumerate((*DATA[:130], *DATA[100:]))
    ]
    stream = LidarStream(C16)
    turns = fed(stream, jumped)
    assert stream.refused == {Refused.AZIMUTH_BACK: 1}
    assert len(turns) == 3
    assert shown(turns)


@pytest.mark.parametrize("jump_us", [-300_000, -50_000, 450_000])
def test_a_clock_that_jumps_drops_the_turn_and_times_go_on(jump_us: int) -> None:
    jumped = [
        (with_clock(data, (500_000 + 1200 * n + (jump_us if n >= 230 else 0)) % 1_000_000), at)
        for n, (data, at) in enumerate(COMING)
    ]
    stream = LidarStream(C16)
    turns = fed(stream, jumped)
    assert stream.refused == {Refused.CLOCK_JUMP: 1}
    assert len(turns) == 3
    assert shown(turns)
    undisturbed = [turn.stamp_ns for turn in fed(LidarStream(C16), COMING)]
    assert [min(abs(turn.stamp_ns - stamp) for stamp in undisturbed) for turn in turns] == pytest.approx(
        [0, 0, 0], abs=10_000
    )  # ns


def test_a_lidar_that_is_switched_off_and_on_goes_on_with_a_new_turn() -> None:
    later = [(data, at + 7_000_000_000) for data, at in COMING]
    stream = LidarStream(C16)
    turns = fed(stream, COMING[:250] + later)
    assert stream.refused == {Refused.SILENCE: 1}
    assert len(turns) == 2 + 4
    assert turns[-1].stamp_ns == pytest.approx(fed(LidarStream(C16), later)[-1].stamp_ns, abs=1000)  # ns
    assert shown(turns)


def test_a_change_of_return_mode_begins_a_new_turn() -> None:
    dual = tuple(d for d in datagrams(ModelName.C16, dual=True) if d.startswith(b"\xff\xee"))
    changed = [
        (with_clock(data, 300_000 + 600 * n), COMING[-1][1] + (n + 1) * PACKET_NS // 2) for n, data in enumerate(dual)
    ]
    stream = LidarStream(C16)
    turns = fed(stream, [(with_clock(d, 1200 * n % 1_000_000), at) for n, (d, at) in enumerate(COMING[:240])])
    turns += fed(stream, [(d, at - COMING[-1][1] + COMING[239][1]) for d, at in changed])
    assert shown(turns)
    assert len(turns) >= 3


@pytest.mark.parametrize(
    ("model", "factory", "says"),
    [
        (VLP16, 0x21, "The packets come from a Velodyne HDL-32E, but the LiDAR is set to be a Velodyne VLP-16"),
        (VLP16, 0x10, "The packets come from a LiDAR of another maker, but the LiDAR is set to be a Velodyne VLP-16"),
        (C16_FINE, 0x22, "The packets come from a Velodyne VLP-16, but the LiDAR is set to be a Leishen C16"),
        (None, 0x28, "The packets come from a Velodyne VLP-32C, which is not known here"),
        (None, 0x10, "The packets do not say which LiDAR sent them. Name its model"),
    ],
)  # fmt: skip
def test_packets_of_another_model_are_refused_in_words(model: LidarModel | None, factory: int, says: str) -> None:
    stream = LidarStream(model)
    assert not fed(stream, [(data[:1205] + bytes((factory,)), at) for data, at in COMING])
    assert stream.contradiction.startswith(says)
    assert stream.packets == 0


def test_long_packets_are_no_vlp16s() -> None:
    stream = LidarStream(VLP16)
    assert not fed(stream, arrivals(VLP16, datagrams(ModelName.C16, long=True)))
    assert "a Leishen C16, by their length" in stream.contradiction


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), most_ms=st.floats(0.0, 30.0))
def test_packets_that_are_held_up_do_not_change_when_a_turn_was_taken(seed: int, most_ms: float) -> None:
    """As long as one comes in time now and then; a held up one holds up those behind it."""
    rng = np.random.default_rng(seed)
    held = np.where(rng.random(len(COMING)) < 0.5, rng.random(len(COMING)) * most_ms * 1e6, 0.0)
    came = np.maximum.accumulate([at + late for (_, at), late in zip(COMING, held, strict=True)]).astype(int).tolist()
    late = fed(LidarStream(C16), [(data, at) for (data, _), at in zip(COMING, came, strict=True)])
    in_time = fed(LidarStream(C16), COMING)
    before = [min(at - on for at, (_, on) in zip(came[: 84 * (n + 2)], COMING, strict=False)) for n in range(4)]
    errors = [a.stamp_ns - b.stamp_ns for a, b in zip(late, in_time, strict=True)]
    assert all(0 <= error <= least + 1000 for error, least in zip(errors, before, strict=True))  # ns


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_no_bytes_at_all_make_the_stream_fail_or_tell_a_point_that_is_not_finite(data: st.DataObject) -> None:
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32 - 1)))
    model = data.draw(st.sampled_from((None, C16, C16_FINE, VLP16)))
    stream = LidarStream(model)
    for packet, at in COMING[: data.draw(st.integers(1, 180))]:
        broken = bytearray(packet)
        for place in rng.integers(0, 1206, int(rng.integers(0, 3))):
            broken[place] = int(rng.integers(256))
        turn = stream.feed(bytes(broken[: 1206 if rng.random() < 0.9 else int(rng.integers(1206))]), at)
        assert turn is None or (np.all(np.isfinite(turn.cloud.points)) and turn.cloud.times.max() <= 0.0)

"""What the bytes on bus and log hold."""

from __future__ import annotations

import math

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.chassis.protocol import MotionCommand
from navcore.errors import InputError, NotFiniteError
from navcore.messages import FixQuality, GnssFix, ImuSample, MissionPlan, NavInputs, PathSegment, SegmentKind
from navcore.topics import TOPICS
from navcore.transport.codec import decode, encode

finite = st.floats(allow_nan=False, allow_infinity=False)
BROKEN = (math.nan, math.inf, -math.inf)


def imu(wz: float) -> ImuSample:
    return ImuSample(stamp_ns=1, wx=0.0, wy=0.0, wz=wz, ax=0.0, ay=0.0, az=9.81)


@given(finite, st.none() | finite, st.integers(0, 2**53))
def test_what_was_encoded_is_decoded_bit_for_bit(wz: float, height: float | None, now_ns: int) -> None:
    fix = GnssFix(stamp_ns=now_ns, utc_s=None, quality=FixQuality.RTK_FIXED, lat_deg=wz, lon_deg=wz, height_m=height)
    inputs = NavInputs(now_ns=now_ns, imu=(imu(wz),), gnss=(fix,))
    assert decode(NavInputs, encode(inputs)) == inputs


@pytest.mark.parametrize("number", BROKEN)
def test_numbers_that_are_none_are_refused_wherever_they_hide(number: float) -> None:
    with pytest.raises(NotFiniteError, match=r"NavInputs\.imu\.wz"):
        encode(NavInputs(now_ns=1, imu=(imu(number),)))


@pytest.mark.parametrize("number", BROKEN)
def test_numbers_that_are_none_are_refused_in_a_path(number: float) -> None:
    segment = PathSegment(kind=SegmentKind.ROAD, points=((0.0, 0.0), (number, 1.0)), speeds=(0.5, 0.5))
    with pytest.raises(NotFiniteError, match="segments"):
        encode(MissionPlan(mission_id="m", name="m", datum=(0.0, 0.0, 0.0), segments=(segment,)))


def test_numbers_that_are_none_are_refused_in_a_plain_dictionary() -> None:
    with pytest.raises(NotFiniteError, match=r"dict\.speed"):
        encode({"speed": math.nan})


@pytest.mark.parametrize(
    "data",
    [b"", b"{}", b"nonsense", b"[1]", b"\xff\xfe",
     b'{"v": null, "omega": 0, "seq": 1, "stamp_ns": 1, "deadline_ns": 1}',
     b'{"v": NaN, "omega": 0, "seq": 1, "stamp_ns": 1, "deadline_ns": 1}',
     b'{"v": 1e999, "omega": 0, "seq": 1, "stamp_ns": 1, "deadline_ns": 1}',
     b'{"v": "1", "omega": 0, "seq": 1, "stamp_ns": 1, "deadline_ns": 1}'],
)  # fmt: skip
def test_bytes_that_are_no_message_are_refused_with_a_sentence(data: bytes) -> None:
    with pytest.raises(InputError, match=r"This is no MotionCommand: .*\. Check"):
        decode(MotionCommand, data)


def test_every_topic_has_a_schema_for_the_log() -> None:
    for topic in TOPICS.values():
        assert msgspec.json.schema(topic.type)["$ref"].endswith(topic.type.__name__)

"""The log of a run, however it ends."""

from __future__ import annotations

import errno
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from mcap.reader import make_reader

from navcore.errors import LogError
from navcore.messages import NavStatus
from navcore.recording.reader import read_log, read_metadata, read_typed, wall_offset_ns
from navcore.recording.recorder import Recorder
from navcore.recording.requests import RecorderRequest, RecorderRequestKind
from navcore.topics import CAMERA_VIEW, NAV_STATUS, TOPICS

if TYPE_CHECKING:
    from tests.navcore.recording.conftest import Drive

WALL_NS = 1_790_000_000_000_000_000


def start(path: Path, run_id: str = "run1") -> RecorderRequest:
    return RecorderRequest(
        kind=RecorderRequestKind.START, run_id=run_id, path=str(path), metadata={"mission": "first row"}
    )


FINISH = RecorderRequest(kind=RecorderRequestKind.FINISH)
STATUS = RecorderRequest(kind=RecorderRequestKind.STATUS)


def record(drive: Drive, path: Path) -> Recorder:
    recorder = Recorder()
    assert recorder.answer(start(path), drive.start_ns, WALL_NS).accepted
    for now_ns, received in drive.received():
        recorder.take(received, now_ns)
    return recorder


def test_a_finished_log_holds_every_message_bit_for_bit(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    reply = record(drive, path).answer(FINISH, drive.start_ns, WALL_NS)
    assert reply.accepted
    assert reply.summary is not None
    assert reply.summary.size_bytes == path.stat().st_size
    own = [message for message in read_log(path) if message.name in TOPICS]
    assert [(m.stamp_ns, m.name, m.payload, m.attachment) for m in own] == [
        (now_ns, r.name, r.payload, r.attachment) for now_ns, r in drive.received()
    ]


def test_a_log_says_which_run_it_holds_and_what_time_it_was(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    record(drive, path).answer(FINISH, drive.start_ns, WALL_NS)
    metadata = read_metadata(path)
    assert (metadata["run_id"], metadata["mission"]) == ("run1", "first row")
    assert drive.start_ns + wall_offset_ns(path) == WALL_NS


def test_other_programs_find_schemas_pictures_and_positions(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    record(drive, path).answer(FINISH, drive.start_ns, WALL_NS)
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        assert summary is not None
        assert {channel.message_encoding for channel in summary.channels.values()} == {"json"}
        assert {schema.encoding for schema in summary.schemas.values()} == {"jsonschema"}
        assert {json.loads(schema.data)["type"] for schema in summary.schemas.values()} == {"object"}
        names = {schema.name for schema in summary.schemas.values()}
        assert {"foxglove.CompressedImage", "foxglove.LocationFix", "NavStatus"} <= names
        locations = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["gnss/location"])]
    assert locations[0]["latitude"] == 42.1
    assert locations[0]["position_covariance"][4] == pytest.approx(0.0004)
    assert locations[0]["timestamp"]["sec"] == WALL_NS // 10**9


def test_a_log_without_an_end_is_readable_to_within_a_second(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    recorder = record(drive, path)
    stamps = [status.stamp_ns for status in read_typed(path, NAV_STATUS.name, NavStatus)]
    recorder.close(drive.start_ns)
    assert stamps[-1] >= drive.received()[-1][0] - 1_000_000_000


def test_a_log_cut_at_any_byte_is_read_up_to_there(drive: Drive, tmp_path: Path) -> None:
    whole = tmp_path / "run.mcap"
    record(drive, whole).answer(FINISH, drive.start_ns, WALL_NS)
    data = whole.read_bytes()
    everything = list(read_log(whole))
    cut = tmp_path / "cut.mcap"
    counts = []
    for size in range(len(data), 40_000, -7919):
        cut.write_bytes(data[:size])
        read = list(read_log(cut))
        assert read == everything[: len(read)]
        counts.append(len(read))
    assert counts[0] == len(everything)
    assert counts == sorted(counts, reverse=True)


def test_a_damaged_log_is_read_up_to_the_damage(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    record(drive, path).answer(FINISH, drive.start_ns, WALL_NS)
    everything = list(read_log(path))
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 0xFF
    path.write_bytes(data)
    read = list(read_log(path))
    assert 0 < len(read) < len(everything)
    assert read == everything[: len(read)]


@pytest.mark.parametrize("content", [b"", b"nonsense", b"\x89MCAP0\r\n", b"\x89PNG\r\n\x1a\n"])
def test_a_file_that_is_no_run_log_is_refused_with_a_sentence(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "other.mcap"
    path.write_bytes(content)
    with pytest.raises(LogError, match=r"other\.mcap is no"):
        read_metadata(path)


def test_a_missing_log_is_told(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="cannot be opened"):
        list(read_log(tmp_path / "none.mcap"))


def test_an_old_log_is_never_overwritten(drive: Drive, tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    record(drive, path).answer(FINISH, drive.start_ns, WALL_NS)
    before = path.read_bytes()
    reply = Recorder().answer(start(path), 0, WALL_NS)
    assert not reply.accepted
    assert "not overwritten" in reply.reason
    assert path.read_bytes() == before


def test_a_new_run_ends_the_log_of_the_last(drive: Drive, tmp_path: Path) -> None:
    recorder = record(drive, tmp_path / "first.mcap")
    assert recorder.answer(start(tmp_path / "second.mcap", "run2"), drive.start_ns, WALL_NS).accepted
    assert (tmp_path / "first.mcap").read_bytes().endswith(b"\x89MCAP0\r\n")
    recorder.close(drive.start_ns)


def test_another_runs_log_is_not_finished(drive: Drive, tmp_path: Path) -> None:
    recorder = record(drive, tmp_path / "run.mcap")
    other = RecorderRequest(kind=RecorderRequestKind.FINISH, run_id="run2")
    reply = recorder.answer(other, 0, WALL_NS)
    recorder.close(drive.start_ns)
    assert not reply.accepted
    assert reply.recording


def test_finishing_twice_is_as_good_as_once(drive: Drive, tmp_path: Path) -> None:
    recorder = record(drive, tmp_path / "run.mcap")
    assert recorder.answer(FINISH, drive.start_ns, WALL_NS).accepted
    assert recorder.answer(FINISH, drive.start_ns, WALL_NS).accepted
    assert not Recorder().answer(FINISH, 0, WALL_NS).accepted


def test_a_folder_that_is_missing_is_told(tmp_path: Path) -> None:
    reply = Recorder().answer(start(tmp_path / "missing" / "run.mcap"), 0, WALL_NS)
    assert not reply.accepted
    assert "not recorded" in reply.reason


def test_a_full_disk_is_told_and_what_was_written_stays_readable(
    drive: Drive, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.mcap"
    recorder = record(drive, path)

    def no_space(handle: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", no_space)
    later_ns = drive.start_ns + 60_000_000_000
    recorder.take(drive.received()[1][1], later_ns)
    status = recorder.status(later_ns)
    assert not status.recording
    assert "No space left" in status.problem
    recorder.take(drive.received()[1][1], later_ns)
    assert recorder.answer(STATUS, later_ns, WALL_NS).summary is not None
    assert len(list(read_log(path, (NAV_STATUS.name,)))) >= 80


def test_a_view_of_another_version_is_written_as_it_came(tmp_path: Path, drive: Drive) -> None:
    path = tmp_path / "run.mcap"
    recorder = record(drive, path)
    strange = drive.received()[2][1]._replace(name=CAMERA_VIEW.name, payload=b'{"version": 9}')
    recorder.take(strange, drive.start_ns)
    recorder.answer(FINISH, drive.start_ns, WALL_NS)
    assert next(m for m in read_log(path) if m.payload == b'{"version": 9}').name == CAMERA_VIEW.name


def test_messages_without_a_log_are_nobodys(drive: Drive) -> None:
    recorder = Recorder()
    recorder.take(drive.received()[0][1], 0)
    recorder.idle(0)
    recorder.close(0)
    assert not recorder.status(0).recording

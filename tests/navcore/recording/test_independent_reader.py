"""A program that is not ours reads a run's log: all topics, no error."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from navcore.recording.recorder import Recorder
from navcore.recording.requests import RecorderRequest, RecorderRequestKind
from navcore.topics import TOPICS

if TYPE_CHECKING:
    from tests.navcore.recording.conftest import Drive

MODULES = Path(__file__).resolve().parents[3] / "frontend" / "node_modules"
SCRIPT = Path(__file__).with_name("read_with_mcap_core.mjs")


@pytest.fixture
def node() -> str:
    program = shutil.which("node")
    if program is None or not (MODULES / "@mcap" / "core").is_dir():
        pytest.skip("needs Node and the front end's packages: run `make setup frontend`")
    return program


def test_the_makers_own_reader_finds_every_topic_and_every_message(drive: Drive, tmp_path: Path, node: str) -> None:
    path = tmp_path / "run.mcap"
    recorder = Recorder()
    recorder.answer(RecorderRequest(kind=RecorderRequestKind.START, run_id="run1", path=str(path)), drive.start_ns, 0)
    for now_ns, received in drive.received():
        recorder.take(received, now_ns)
    reply = recorder.answer(RecorderRequest(kind=RecorderRequestKind.FINISH), drive.start_ns, 0)
    assert reply.summary is not None
    read = subprocess.run(
        [node, str(SCRIPT), str(MODULES), str(path)], capture_output=True, text=True, check=False, timeout=60
    )
    assert read.returncode == 0, read.stderr
    told = json.loads(read.stdout)
    assert told["counts"] == reply.summary.messages
    assert {topic.name for topic in TOPICS.values() if topic.logged} <= set(told["topics"])

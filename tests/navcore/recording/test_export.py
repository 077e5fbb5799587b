"""A run for other programs."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

from navcore.errors import LogError
from navcore.recording.export import COLUMNS, RunExport
from navcore.recording.recorder import Recorder
from navcore.recording.requests import RecorderRequest, RecorderRequestKind
from tests.navcore.recording.conftest import Drive

WALL_NS = 1_790_000_000_000_000_000
METRES_PER_DEGREE_EAST = 82_850.0  # at 42 degrees north, to 0.1 %
GPX = {"g": "http://www.topografix.com/GPX/1/1"}


def log_of(drive: Drive, path: Path, messages: int | None = None) -> Path:
    recorder = Recorder()
    request = RecorderRequest(kind=RecorderRequestKind.START, run_id="run1", path=str(path))
    recorder.answer(request, drive.start_ns, WALL_NS)
    for now_ns, received in drive.received()[:messages]:
        recorder.take(received, now_ns)
    recorder.close(drive.start_ns)
    return path


@pytest.fixture
def export(drive: Drive, tmp_path: Path) -> RunExport:
    return RunExport(log_of(drive, tmp_path / "run.mcap"))


def test_the_table_has_a_line_for_each_status(export: RunExport, drive: Drive) -> None:
    rows = list(csv.DictReader(io.StringIO(export.csv())))
    assert len(rows) == drive.statuses
    assert tuple(rows[0]) == COLUMNS
    assert (rows[20]["t_s"], rows[20]["x"], rows[20]["mode"], rows[20]["row_age_s"]) == (
        "1.000",
        "2.0000",
        "gnss_path",
        "",
    )
    assert rows[0]["time_utc"] == "2026-09-21T14:13:20.000Z"


def test_the_map_shows_driven_and_planned_lines_and_switches(export: RunExport) -> None:
    features = json.loads(export.geojson())["features"]
    assert [feature["properties"]["kind"] for feature in features] == ["driven", "planned", "switch"]
    driven = features[0]["geometry"]["coordinates"]
    assert (driven[-1][0] - driven[0][0]) * METRES_PER_DEGREE_EAST == pytest.approx(9.9, abs=0.02)  # m
    assert driven[0] == pytest.approx([-8.0, 42.0], abs=1e-9)
    assert features[1]["geometry"]["coordinates"][0] == pytest.approx([-8.0, 42.0], abs=1e-9)


def test_the_track_is_gpx_and_its_name_is_safe(export: RunExport, drive: Drive) -> None:
    root = ElementTree.fromstring(export.gpx())
    points = root.findall(".//g:trkpt", GPX)
    assert len(points) == drive.statuses
    assert root.findtext(".//g:name", namespaces=GPX) == "North & <south>"
    assert points[0].findtext("g:time", namespaces=GPX) == "2026-09-21T14:13:20.000Z"


def test_a_name_with_characters_that_xml_does_not_know_is_still_gpx(tmp_path: Path) -> None:
    drive = Drive(name="row \x07 7 \U0001f347")
    root = ElementTree.fromstring(RunExport(log_of(drive, tmp_path / "run.mcap")).gpx())
    assert root.findtext(".//g:name", namespaces=GPX) == "row   7 \U0001f347"
    assert root.find(".//g:ele", GPX) is None


def test_a_run_that_ended_at_once_has_no_driven_line(tmp_path: Path) -> None:
    features = json.loads(RunExport(log_of(Drive(statuses=1), tmp_path / "run.mcap")).geojson())["features"]
    assert "driven" not in [feature["properties"]["kind"] for feature in features]


def test_a_log_without_a_drive_is_refused_with_a_sentence(drive: Drive, tmp_path: Path) -> None:
    with pytest.raises(LogError, match="no driven run"):
        RunExport(log_of(drive, tmp_path / "empty.mcap", messages=1))

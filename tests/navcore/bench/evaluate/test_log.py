"""Logs and surveyed tracks become records, or are refused with a sentence."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.bench.evaluate.evaluate import evaluate
from navcore.bench.evaluate.log import read_record, read_truth
from navcore.chassis.protocol import MotionCommand
from navcore.cli import app
from navcore.errors import LogError
from navcore.messages import (
    Decision,
    FixQuality,
    MissionPlan,
    NavMode,
    NavStatus,
    PathSegment,
    RunState,
    SegmentKind,
    SimContact,
    SimFarm,
    SimTruth,
)
from navcore.recording.run_log import RunLog, RunLogParams
from navcore.topics import NAV_DECISION, NAV_PLAN, SIM_CONTACT, SIM_FARM, SIM_TRUTH
from navcore.transport.codec import encode
from navcore.transport.pubsub import Received

NS = 1_000_000_000
START_NS = 50 * NS
WALL_NS = 1_781_514_000 * NS


def plan() -> MissionPlan:
    road = PathSegment(kind=SegmentKind.ROAD, points=((0.0, 0.0), (10.0, 0.0), (20.0, 0.0)), speeds=(1.0, 1.0, 1.0))
    return MissionPlan(mission_id="m", name="m", datum=(42.0, -2.0, 0.0), segments=(road,))


def decision(stamp_ns: int, state: RunState) -> Decision:
    status = NavStatus(
        stamp_ns=stamp_ns, state=state, mode=NavMode.GNSS_PATH, mode_reason="", run_id="r", segment=0, segments=1,
        row_id=None, progress=0.0, remaining=0.0, lateral_error=None, heading_error=None, v=1.0, omega=0.0,
        speed_limit=1.0, speed_reason="", pose=None, gnss_quality=FixQuality.RTK_FIXED, gnss_age_s=0.1,
        row_age_s=None, battery_v=26.0, guard="armed", guard_reason="", events=(),
    )  # fmt: skip
    command = MotionCommand(v=1.0, omega=0.0, seq=1, stamp_ns=stamp_ns, deadline_ns=stamp_ns + NS)
    return Decision(stamp_ns=stamp_ns, command=command, status=status, switch=None, camera=None)


def write_log(path: Path, *, truth: bool = True) -> Path:
    """Twenty metres east at 1 m/s, 0.05 m left of the path."""
    log = RunLog(path, "r", {}, START_NS, WALL_NS, RunLogParams())
    log.write(Received(NAV_PLAN.name, encode(plan()), b""), START_NS)
    if truth:
        log.write(Received(SIM_FARM.name, encode(SimFarm(stamp_ns=START_NS, rows=())), b""), START_NS)
        contact = SimContact(stamp_ns=START_NS, kind="post", x=3.0, y=1.0)
        log.write(Received(SIM_CONTACT.name, encode(contact), b""), START_NS)
    for k in range(201):
        now_ns = START_NS + k * NS // 10
        if truth:
            pose = SimTruth(stamp_ns=now_ns, x=k * 0.1, y=0.05, yaw=0.0, roll=0.0, pitch=0.0, v=1.0, omega=0.0)
            log.write(Received(SIM_TRUTH.name, encode(pose), b""), now_ns)
        state = RunState.DRIVING if k < 200 else RunState.FINISHED
        log.write(Received(NAV_DECISION.name, encode(decision(now_ns, state)), b""), now_ns)
    log.finish()
    return path


def write_csv(path: Path, head: str, lines: list[str]) -> Path:
    path.write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")
    return path


def test_a_simulated_log_is_scored_by_its_own_truth(tmp_path: Path) -> None:
    result = evaluate(read_record(write_log(tmp_path / "run.mcap")))
    assert result.finished
    assert result.contacts == ("post",)
    assert result.gnss_whole is not None
    assert result.gnss_whole.mean == pytest.approx(0.05, abs=1e-6)


def test_a_real_log_is_scored_by_a_surveyed_track(tmp_path: Path) -> None:
    log = write_log(tmp_path / "run.mcap", truth=False)
    offset_s = (WALL_NS - START_NS) * 1e-9
    lines = [f"{offset_s + 50.0 + k * 0.1:.3f},{k * 0.1:.3f},-0.08" for k in range(201)]
    track = write_csv(tmp_path / "track.csv", "utc_s,x,y", lines)
    result = evaluate(read_record(log, track))
    assert result.gnss_whole is not None
    assert result.gnss_whole.mean == pytest.approx(0.08, abs=1e-3)
    assert not result.rows_are_true


def test_a_real_log_without_a_track_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="--truth FILE"):
        read_record(write_log(tmp_path / "run.mcap", truth=False))


def test_a_track_in_degrees_is_carried_into_the_map(tmp_path: Path) -> None:
    track = write_csv(tmp_path / "t.csv", "stamp_ns,lat_deg,lon_deg", ["0,42.0,-2.0", "1000000000,42.0,-1.99998"])
    truth = read_truth(track, (42.0, -2.0, 0.0), 0)
    assert truth[1, 1] == pytest.approx(1.656, abs=0.01)
    assert truth[0, 3] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(
    ("head", "lines", "sentence"),
    [
        ("stamp_ns,x,y", ["0,1,2", "1,nan,2"], "line 3: NaN"),
        ("stamp_ns,x,y", ["0,1,2", "1,east,2"], "line 3"),
        ("stamp_ns,x,y", ["0,1,2"], "fewer than two"),
        ("x,y", ["1,2", "2,2"], "stamp_ns or utc_s"),
        ("stamp_ns,x", ["0,1", "1,2"], "columns x and y"),
        ("stamp_ns,x,y", ["1,1,2", "0,1,2"], "do not increase"),
    ],
)
def test_a_bad_track_is_refused_with_a_sentence(tmp_path: Path, head: str, lines: list[str], sentence: str) -> None:
    with pytest.raises(LogError, match=sentence):
        read_truth(write_csv(tmp_path / "t.csv", head, lines), (42.0, -2.0, 0.0), 0)


def test_the_verb_prints_a_table_and_json(tmp_path: Path) -> None:
    log = write_log(tmp_path / "run.mcap")
    shown = CliRunner().invoke(app, ["evaluate", str(log)])
    assert shown.exit_code == 0
    assert "on GNSS, from the path" in shown.output
    told = json.loads(CliRunner().invoke(app, ["evaluate", str(log), "--json"]).output)
    assert math.isclose(told["gnss_whole"]["mean"], 0.05, abs_tol=1e-6)


def test_the_verb_refuses_what_is_no_log(tmp_path: Path) -> None:
    wrong = tmp_path / "x.mcap"
    wrong.write_bytes(b"no log")
    result = CliRunner().invoke(app, ["evaluate", str(wrong)])
    assert result.exit_code == 2
    assert "no MCAP file" in result.output

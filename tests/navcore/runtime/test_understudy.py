"""A run begins with a young navigator, so that its log can be replayed from the beginning."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from navcore.config import RobotConfig, config_to_tree
from navcore.errors import LogError
from navcore.maps.mission import RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import Decision, NavInputs, NavPrelude, Reply, Request, RequestKind, RunState
from navcore.navigator import Navigator
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.recording.recorder import Recorder
from navcore.recording.requests import RecorderRequest, RecorderRequestKind
from navcore.runtime.lockstep import Lockstep
from navcore.runtime.replay_log import replay_log
from navcore.runtime.understudy import Taken, Understudy, UnderstudyParams
from navcore.sim.demo_farm import demo_farm
from navcore.sim.world import World, WorldParams
from navcore.topics import NAV_DECISION, NAV_INPUTS, NAV_PRELUDE
from navcore.transport.codec import encode
from navcore.transport.pubsub import Received
from navcore.vehicle import PAPER_A

START_NS = 1_000_000_000


class ActingNavigator:
    """Stands where the lockstep expects a navigator, and writes down what the process would publish."""

    def __init__(self, site: SiteMap, params: UnderstudyParams, path: Path) -> None:
        self.config = RobotConfig()
        self.vehicle = self.config.vehicle_params()
        self.understudy = Understudy(lambda: self.config.new_navigator(site.datum), START_NS, params)
        self.datum = (site.datum.lat_deg, site.datum.lon_deg, site.datum.height_m)
        self.recorder = Recorder()
        self.recorder.answer(
            RecorderRequest(kind=RecorderRequestKind.START, run_id="run1", path=str(path)), START_NS, START_NS
        )
        self.starts: list[Taken] = []

    def step(self, now_ns: int, inputs: NavInputs) -> Decision:
        encoded = encode(inputs)
        taken = self.understudy.step(now_ns, inputs, encoded)
        if taken.prelude is not None:
            self.starts.append(taken)
            self._write(NAV_PRELUDE.name, self._prelude(now_ns, taken), now_ns)
        self._write(NAV_INPUTS.name, encoded, now_ns)
        self._write(NAV_DECISION.name, encode(taken.decision), now_ns)
        return taken.decision

    def _prelude(self, now_ns: int, taken: Taken) -> bytes:
        told = NavPrelude(
            stamp_ns=now_ns, run_id="run1", config=encode(config_to_tree(self.config)).decode(), datum=self.datum,
            complete=taken.prelude_complete, inputs=(),
        )  # fmt: skip
        return encode(told).removesuffix(b"[]}") + b"[" + b",".join(taken.prelude or ()) + b"]}"

    def _write(self, topic: str, payload: bytes, now_ns: int) -> None:
        self.recorder.take(Received(topic, payload, b""), now_ns)


class Stage:
    """A simulated robot that rests, is started, and drives a little, with its log."""

    def __init__(self, path: Path, params: UnderstudyParams) -> None:
        self.path = path
        self.site = demo_farm()
        self.acting = ActingNavigator(self.site, params, path)
        world = World(self.site, PAPER_A, WorldParams(seed=3), START_NS)
        self.lockstep = Lockstep(world, cast(Navigator, self.acting), None)

    def start(self) -> None:
        mission = mission_for_row(self.site, self.site.rows[0].id, RowExit.REVERSE)
        plan = plan_mission(self.site, mission, PAPER_A)
        self.lockstep.ask(Request(kind=RequestKind.START, request_id="s", run_id="run1", plan=plan))

    def finish(self) -> Path:
        self.acting.recorder.close(self.lockstep.now_ns)
        return self.path


@pytest.fixture
def stage(tmp_path: Path) -> Callable[[UnderstudyParams], Stage]:
    return lambda params: Stage(tmp_path / "run.mcap", params)


def test_a_run_after_a_long_rest_has_a_short_prelude_and_replays_bit_for_bit(
    stage: Callable[[UnderstudyParams], Stage],
) -> None:
    play = stage(UnderstudyParams(generation_s=1.0))
    play.lockstep.run(8.0)
    play.start()
    last = play.lockstep.run(6.0)
    assert last.decision.status.state is RunState.DRIVING
    (start,) = play.acting.starts
    assert start.prelude_complete
    assert 50 <= len(start.prelude or ()) <= 150  # ticks of 20 ms: between one and three generations
    result = replay_log(play.finish())
    assert result.difference is None
    assert result.ticks == 300


def test_a_replay_with_other_settings_tells_where_it_differs(stage: Callable[[UnderstudyParams], Stage]) -> None:
    play = stage(UnderstudyParams(generation_s=1.0))
    play.lockstep.run(4.0)
    play.start()
    play.lockstep.run(4.0)
    other = replace(RobotConfig().navigator, command_ms=150)
    result = replay_log(play.finish(), RobotConfig(navigator=other))
    assert result.difference is not None
    assert result.difference.recorded != result.difference.replayed


def test_a_refused_start_changes_nobodys_place(stage: Callable[[UnderstudyParams], Stage]) -> None:
    play = stage(UnderstudyParams(generation_s=1.0))
    play.lockstep.run(3.0)
    play.lockstep.ask(Request(kind=RequestKind.START, request_id="s", run_id="run1"))
    tick = play.lockstep.run(0.02)
    assert not tick.decision.replies[0].accepted
    assert play.acting.starts == []
    play.finish()


def test_a_start_right_after_power_on_replays_from_the_first_tick(stage: Callable[[UnderstudyParams], Stage]) -> None:
    play = stage(UnderstudyParams(generation_s=60.0))
    play.lockstep.run(3.0)
    play.start()
    play.lockstep.run(3.0)
    assert play.acting.starts[0].prelude_complete
    assert replay_log(play.finish()).difference is None


class Scripted:
    """A navigator that takes every start, and knows its pose or does not."""

    def __init__(self, decision: Decision, *, has_pose: bool) -> None:
        pose = decision.status.pose if has_pose else None
        self._decision = replace(decision, status=replace(decision.status, pose=pose))

    def step(self, now_ns: int, inputs: NavInputs) -> Decision:
        replies = tuple(Reply(request_id=r.request_id, accepted=True) for r in inputs.requests)
        return replace(self._decision, stamp_ns=now_ns, replies=replies)


def test_a_history_that_grew_too_long_is_told(stage: Callable[[UnderstudyParams], Stage]) -> None:
    play = stage(UnderstudyParams())
    resting = play.lockstep.run(2.0).decision
    play.finish()
    script = iter([True] + [False] * 10)  # only the first one ever learns where it is
    params = UnderstudyParams(generation_s=1.0, longest_history_s=3.0)
    understudy = Understudy(lambda: cast(Navigator, Scripted(resting, has_pose=next(script))), 0, params)
    start = Request(kind=RequestKind.START, request_id="s", run_id="run1")
    for tick in range(200):
        understudy.step(tick * 20_000_000, NavInputs(now_ns=tick * 20_000_000), b"{}")
    taken = understudy.step(4_000_000_000, NavInputs(now_ns=4_000_000_000, requests=(start,)), b"{}")
    assert taken.prelude == ()
    assert not taken.prelude_complete


def test_a_log_without_a_prelude_is_refused(tmp_path: Path) -> None:
    recorder = Recorder()
    path = tmp_path / "run.mcap"
    recorder.answer(RecorderRequest(kind=RecorderRequestKind.START, run_id="r", path=str(path)), 0, 0)
    recorder.close(0)
    with pytest.raises(LogError, match="cannot be replayed"):
        replay_log(path)

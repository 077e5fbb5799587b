"""The navigator as a process: `python -m navcore.runtime.navigator_process --help`.

Every 20 ms: all that has arrived goes into one `step()`, its decision goes to the guard, and then everybody else
hears of it. Nothing in the tick waits; only the GNSS receiver has a thread.
"""

from __future__ import annotations

import argparse
import gc
import signal
import time
from pathlib import Path

from navcore.config import RobotConfig, config_to_tree, load_config
from navcore.drivers.gnss_reader import GnssReader
from navcore.drivers.nmea_stream import NmeaStream
from navcore.errors import InputError
from navcore.maps.site_map import SiteMap
from navcore.messages import (
    Decision,
    GnssFix,
    ImuSample,
    MapMatch,
    NavInputs,
    NavPrelude,
    Odometry,
    Reply,
    Request,
    RequestKind,
    RowObservation,
    RunState,
)
from navcore.promptness import be_prompt, no_pauses
from navcore.runtime.clock import Every, Ticker
from navcore.runtime.device_address import DeviceAddress
from navcore.runtime.guard_link import GuardLink
from navcore.runtime.latest import Inbox
from navcore.runtime.site_file import read_site
from navcore.runtime.understudy import Taken, Understudy
from navcore.topics import (
    CAMERA_REQUEST,
    CHASSIS_STATE,
    GNSS_FIX,
    IMU_SAMPLE,
    MAP_MATCH,
    NAV_DECISION,
    NAV_INPUTS,
    NAV_ODOMETRY,
    NAV_PLAN,
    NAV_PRELUDE,
    NAV_STATUS,
    NAV_SWITCH,
    ROW_OBSERVATION,
)
from navcore.transport.codec import decode, encode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber
from navcore.transport.request import Replier

TICK_NS = 20_000_000
STATUS_NS = 50_000_000
COLLECT_NS = 60_000_000_000
MOST_MESSAGES = 64  # per tick: a tick's worth is 3
FIXES = 50
PRIORITY = 20


class Senses:
    """All that reaches the navigator, gathered without waiting."""

    def __init__(self, endpoints: Endpoints, gnss_address: str) -> None:
        self.guard = GuardLink(endpoints)
        self._bus = Subscriber(endpoints, (IMU_SAMPLE.name, ROW_OBSERVATION.name, MAP_MATCH.name))
        self._requests = Replier(endpoints.navigator_requests)
        self._fixes: Inbox[GnssFix] = Inbox(FIXES)
        self._gnss = GnssReader(DeviceAddress(gnss_address).open, NmeaStream(), self._fixes.put, time.monotonic_ns)
        self._gnss.start()
        self._asked: Request | None = None

    def gather(self) -> NavInputs:
        """Inputs of one tick, oldest first.

        Its time is read last, so that nothing of it is newer: what has a negative age counts as old.
        """
        imu: list[ImuSample] = []
        rows: list[RowObservation] = []
        matches: list[MapMatch] = []
        for _ in range(MOST_MESSAGES):
            received = self._bus.receive(0)
            if received is None:
                break
            if received.name == IMU_SAMPLE.name:
                imu.append(decode(ImuSample, received.payload))
            elif received.name == MAP_MATCH.name:
                matches.append(decode(MapMatch, received.payload))
            else:
                rows.append(decode(RowObservation, received.payload))
        chassis, gnss, requests = self.guard.receive(), self._fixes.take(), self._ask()
        return NavInputs(
            now_ns=time.monotonic_ns(), chassis=chassis, imu=tuple(imu), gnss=gnss, rows=tuple(rows),
            requests=requests, matches=tuple(matches),
        )  # fmt: skip

    def answer(self, replies: tuple[Reply, ...]) -> None:
        """Pass the decision's answer on to whoever asked."""
        if self._asked is not None:
            silent = Reply(
                request_id=self._asked.request_id, accepted=False, reasons=("The navigator gave no answer.",)
            )
            self._requests.reply(next((r for r in replies if r.request_id == self._asked.request_id), silent))
            self._asked = None

    def close(self) -> None:
        """Hang up everywhere."""
        self._gnss.stop()
        self.guard.close()
        self._bus.close()
        self._requests.close()

    def _ask(self) -> tuple[Request, ...]:
        """At most one request per tick: the next one waits for this one's answer."""
        question = self._requests.receive(0)
        if question is None:
            return ()
        try:
            self._asked = decode(Request, question)
        except InputError as error:
            self._requests.reply(Reply(request_id="", accepted=False, reasons=(str(error),)))
            return ()
        return (self._asked,)


class Voice:
    """All that the navigator tells, each message encoded once."""

    def __init__(self, endpoints: Endpoints, config: RobotConfig, datum: tuple[float, float, float]) -> None:
        self._publisher = Publisher(endpoints, "navigator")
        self._config = encode(config_to_tree(config)).decode()
        self._datum = datum
        self._status = Every(STATUS_NS)

    def tell(self, inputs: NavInputs, encoded: bytes, taken: Taken) -> None:
        """Publish one tick."""
        decision, publish = taken.decision, self._publisher.publish
        if taken.prelude is not None:
            self._tell_start(decision, inputs, taken)
        publish(NAV_INPUTS.name, encoded)
        publish(NAV_DECISION.name, decision)
        for fix in inputs.gnss:
            publish(GNSS_FIX.name, fix)
        if inputs.chassis:
            publish(CHASSIS_STATE.name, inputs.chassis[-1])
        if decision.camera is not None:
            publish(CAMERA_REQUEST.name, decision.camera)
        if decision.switch is not None:
            publish(NAV_SWITCH.name, decision.switch)
        if self._status.due(decision.stamp_ns):
            publish(NAV_STATUS.name, decision.status)

    def tell_motion(self, odometry: Odometry) -> None:
        """For whoever matches clouds."""
        self._publisher.publish(NAV_ODOMETRY.name, odometry)

    def close(self) -> None:
        """Fall silent."""
        self._publisher.close()

    def _tell_start(self, decision: Decision, inputs: NavInputs, taken: Taken) -> None:
        prelude = NavPrelude(
            stamp_ns=decision.stamp_ns, run_id=decision.status.run_id or "", config=self._config, datum=self._datum,
            complete=taken.prelude_complete, inputs=(),
        )  # fmt: skip
        # the inputs are encoded already: thousands of them must not be encoded again within a tick
        told = b",".join(taken.prelude or ())
        self._publisher.publish(NAV_PRELUDE.name, encode(prelude).removesuffix(b"[]}") + b"[" + told + b"]}")
        plans = [r.plan for r in inputs.requests if r.kind is RequestKind.START and r.plan is not None]
        for plan in plans:
            self._publisher.publish(NAV_PLAN.name, plan)


class NavigatorProcess:
    """Senses, navigator, voice, and the clock that drives them."""

    def __init__(
        self, endpoints: Endpoints, site: SiteMap, gnss_address: str, config: RobotConfig, *, tells_motion: bool
    ) -> None:
        self._tells_motion = tells_motion
        self._senses = Senses(endpoints, gnss_address)
        datum = (site.datum.lat_deg, site.datum.lon_deg, site.datum.height_m)
        self._voice = Voice(endpoints, config, datum)
        self._understudy = Understudy(lambda: config.new_navigator(site.datum), time.monotonic_ns())
        self._collect = Every(COLLECT_NS)

    def tick(self) -> None:
        """One tick. The guard hears first."""
        inputs = self._senses.gather()
        now_ns, encoded = inputs.now_ns, encode(inputs)
        taken = self._understudy.step(now_ns, inputs, encoded)
        decision = taken.decision
        self._senses.guard.send(decision.guard_request, decision.command, now_ns)
        self._senses.answer(decision.replies)
        self._voice.tell(inputs, encoded, taken)
        if self._tells_motion:
            self._voice.tell_motion(self._understudy.leading.odometry(now_ns))
        if decision.status.state is RunState.IDLE and self._collect.due(now_ns):
            gc.collect()  # only here, where a pause moves nothing

    def close(self) -> None:
        """Let go of every socket."""
        self._senses.close()
        self._voice.close()


def main() -> None:
    """Tick until SIGTERM."""
    parser = argparse.ArgumentParser(prog="navigator", description="Thinks for the robot, 50 times in a second.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--site", type=Path, required=True, help="site map as JSON")
    parser.add_argument("--gnss", required=True, help="tcp://host:port or serial:///dev/ttyUSB0?115200")
    parser.add_argument("--config", type=Path, help="settings of the robot, TOML")
    parser.add_argument("--tell-motion", action="store_true", help="at every tick, to the scan worker")
    given = parser.parse_args()
    config = load_config(given.config) if given.config else RobotConfig()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    process = NavigatorProcess(
        Endpoints(given.bus), read_site(given.site), given.gnss, config, tells_motion=given.tell_motion
    )
    no_pauses()
    be_prompt(PRIORITY)
    ticker = Ticker(TICK_NS)
    while not ended:
        ticker.wait()
        process.tick()
    process.close()


if __name__ == "__main__":
    main()

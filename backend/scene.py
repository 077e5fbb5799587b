"""The 3D view, a process of its own: `python -m backend.scene --bus DIR --port PORT --data DIR`.

A subscriber of the bus like any other. viser listens on loopback and has no login: the station shows it under its own
address, behind the station's login (`backend.scene_proxy`).
"""

from __future__ import annotations

import argparse
import logging
import signal
import time
from pathlib import Path
from typing import Any

import viser

from backend.scene_farm import FarmWatch
from backend.scene_view import SceneView
from backend.supervisor import SupervisorClient
from navcore.errors import InputError
from navcore.messages import CameraView, GnssFix, MissionPlan, NavStatus, RowObservation, SimTruth
from navcore.promptness import give_way
from navcore.topics import CAMERA_VIEW, GNSS_FIX, NAV_PLAN, NAV_STATUS, ROW_OBSERVATION, SIM_TRUTH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber
from navcore.vehicle import PROFILES

LOOPBACK = "127.0.0.1"
PERIOD_S = 0.1
WAIT_MS = 200
SHOWN: dict[str, type[Any]] = {
    NAV_STATUS.name: NavStatus,
    NAV_PLAN.name: MissionPlan,
    GNSS_FIX.name: GnssFix,
    ROW_OBSERVATION.name: RowObservation,
    CAMERA_VIEW.name: CameraView,
    SIM_TRUTH.name: SimTruth,
}


def main() -> None:
    """Show what comes until SIGTERM; nothing of this is needed to drive or to stop."""
    parser = argparse.ArgumentParser(prog="scene", description="The 3D view of the station.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--port", type=int, required=True, help="loopback port to listen on")
    parser.add_argument("--data", type=Path, required=True, help="the station's data folder")
    parser.add_argument("--vehicle", default="paper_a", choices=sorted(PROFILES))
    arguments = parser.parse_args()
    ended: list[int] = []
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda caught, _: ended.append(caught))
    give_way(5)
    logging.getLogger("websockets").setLevel(logging.CRITICAL)  # the station looks in without a word: no failure
    endpoints = Endpoints(arguments.bus)
    supervisor = SupervisorClient(endpoints, arguments.data / "robot")
    farm = FarmWatch(supervisor, arguments.data / "robot")
    server = viser.ViserServer(host=LOOPBACK, port=arguments.port, label="Rowpilot", verbose=False)
    server.gui.configure_theme(show_logo=False, show_share_button=False)
    server.gui.main_panel.minimize()
    server.scene.configure_default_lights(cast_shadow=False)  # dear to draw where there is no graphics card
    view = SceneView(server, PROFILES[arguments.vehicle])
    with Subscriber(endpoints, SHOWN) as subscriber:
        while not ended:
            show_newest(subscriber, view)
            if (shown := farm.news()) is not None:
                view.show_farm(shown.site, shown.trunks, shown.cells)
    supervisor.close()
    server.stop()


def show_newest(subscriber: Subscriber, view: SceneView) -> None:
    """One round: newest of each topic, at most ten times a second."""
    for name, received in subscriber.newest(WAIT_MS).items():
        try:
            view.show(decode(SHOWN[name], received.payload))
        except InputError:  # a message of another version is not shown; everything else is
            continue
    time.sleep(PERIOD_S)


if __name__ == "__main__":
    main()

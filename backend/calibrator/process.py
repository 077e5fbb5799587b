"""Looks at a calibration board for the station: `python -m backend.calibrator.process --help`.

A process of its own, because finding boards and fitting cameras hold an interpreter for longer than a station may be
silent or a tick late. What was taken is on disk, so that it can be ended at any moment and started again.
"""

from __future__ import annotations

import argparse
import signal
import subprocess
from pathlib import Path

import cv2
import msgspec

from backend.calibrator.requests import CalibratorRequest
from backend.calibrator.work import CalibratorWork
from backend.tied import tied
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.session.state import SessionSetup
from navcore.calibration.version_folder import VersionFolder
from navcore.promptness import give_way
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber
from navcore.transport.request import Replier

NICENESS = 3
WAIT_MS = 30
BOARD = "navcore.runtime.board_process"  # the simulated board; by its name, for the station knows no simulator


def main() -> None:
    """Work on the calibration of a folder until SIGTERM."""
    parser = argparse.ArgumentParser(prog="calibrator", description="Looks at a calibration board.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--session", type=Path, required=True, help="folder of the calibration under way")
    parser.add_argument("--versions", type=Path, required=True, help="folder of the versions that are kept")
    parser.add_argument("--rehearsals", type=Path, required=True, help="folder of those found in rehearsals")
    given = parser.parse_args()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)
    give_way(NICENESS)
    folder, endpoints = SessionFolder(given.session), Endpoints(given.bus)
    setup = folder.setup()
    if setup is None:
        return
    board = rehearse(given.bus, setup) if setup.rehearsal else None
    try:
        versions = VersionFolder(kept_in(setup, given.versions, given.rehearsals), setup.robot)
        work(CalibratorWork(setup, folder, versions), endpoints, ended)
    finally:
        if board is not None:
            board.terminate()
            board.wait()


def work(calibrator: CalibratorWork, endpoints: Endpoints, ended: list[int]) -> None:
    """Look and answer in turn."""
    with (
        Replier(endpoints.calibrator_requests) as replier,
        Publisher(endpoints, "calibrator") as publisher,
        Subscriber(endpoints, calibrator.topics(), queue_length=40) as subscriber,
    ):
        while not ended:
            if (question := replier.receive(0)) is not None:
                request = decode(CalibratorRequest, question)
                replier.reply(calibrator.answer(request))
                if not calibrator.is_asked(request):
                    break
            calibrator.look(subscriber, publisher, WAIT_MS)
    calibrator.close()


def kept_in(setup: SessionSetup, versions: Path, rehearsals: Path) -> Path:
    """Nothing that was found in a rehearsal comes where the robot looks."""
    return rehearsals if setup.rehearsal else versions


def rehearse(bus: Path, setup: SessionSetup) -> subprocess.Popen[bytes]:
    """Begin to show a simulated board."""
    command = tied(
        BOARD, f"--bus={bus}", f"--job={setup.job}", f"--camera={setup.camera}",
        f"--board={msgspec.json.encode(setup.board).decode()}",
    )  # fmt: skip
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()

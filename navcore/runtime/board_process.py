"""Simulated pictures and scans of a calibration board: `python -m navcore.runtime.board_process --help`."""

from __future__ import annotations

import argparse
import signal
import time
from pathlib import Path

import cv2
import msgspec

from navcore.calibration.board import Board
from navcore.calibration.calibration_file import numbers_of
from navcore.messages import CalibrationJob, CameraName, LidarScan, RawPicture
from navcore.promptness import give_way
from navcore.runtime.clock import Ticker
from navcore.runtime.raw_pictures import JPEG_QUALITY
from navcore.sim.board_rehearsal import BoardRehearsal, BoardRehearsalParams, RehearsalFrame, told_mount, truth
from navcore.topics import SIM_BOARD, SIM_BOARD_SCAN
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher

FRAME_NS = 200_000_000
NICENESS = 3


def main() -> None:
    """Show the board until SIGTERM."""
    parser = argparse.ArgumentParser(prog="board", description="Holds a simulated board before a simulated camera.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--job", type=CalibrationJob, required=True, help="camera or lidar")
    parser.add_argument("--camera", type=CameraName, default=CameraName.FRONT, help="whose pictures they shall be")
    parser.add_argument("--board", default="{}", help="the board, JSON")
    parser.add_argument("--seed", type=int, default=BoardRehearsalParams().seed, help="of everything random")
    given = parser.parse_args()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    cv2.setNumThreads(1)
    give_way(NICENESS)
    board = msgspec.json.decode(given.board, type=Board)
    frames = BoardRehearsal(given.job, board, BoardRehearsalParams(seed=given.seed)).frames()
    ticker = Ticker(FRAME_NS)
    with Publisher(Endpoints(given.bus), "board") as publisher:
        while not ended:
            ticker.wait()
            publish(publisher, given.camera, next(frames), time.monotonic_ns(), truth(given.job))


def publish(
    publisher: Publisher, camera: CameraName, frame: RehearsalFrame, now_ns: int,
    told: tuple[tuple[str, float], ...],
) -> None:  # fmt: skip
    """A frame of now, with the truth."""
    scan = LidarScan(
        stamp_ns=now_ns, began_ns=now_ns - FRAME_NS, angles=tuple(frame.angles.tolist()),
        distances=tuple(frame.distances.tolist()),
    )  # fmt: skip
    publisher.publish(SIM_BOARD_SCAN.name, scan)
    _, jpeg = cv2.imencode(".jpg", frame.image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
    height, width = frame.image.shape[:2]
    picture = RawPicture(
        stamp_ns=now_ns, camera=camera, width_px=width, height_px=height, T_lidar_camera=numbers_of(told_mount()),
        truth=told,
    )  # fmt: skip
    publisher.publish(SIM_BOARD.name, picture, jpeg.tobytes())


if __name__ == "__main__":
    main()

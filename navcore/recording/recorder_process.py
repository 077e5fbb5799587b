"""The recorder as a process: `python -m navcore.recording.recorder_process --bus DIRECTORY`."""

from __future__ import annotations

import argparse
import signal
import time
from pathlib import Path

from navcore.errors import InputError
from navcore.recording.recorder import Recorder
from navcore.recording.requests import RecorderReply, RecorderRequest
from navcore.topics import RECORDER_STATUS, TOPICS
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber
from navcore.transport.request import Replier

QUEUE_LENGTH = 20_000  # messages: a slow disk may take its time for a minute
BURST = 200
WAIT_MS = 20
STATUS_NS = 1_000_000_000


class RecorderProcess:
    """Sockets and clocks around the recorder."""

    def __init__(self, endpoints: Endpoints, recorder: Recorder) -> None:
        logged = [topic.name for topic in TOPICS.values() if topic.logged]
        self._subscriber = Subscriber(endpoints, logged, QUEUE_LENGTH)
        self._replier = Replier(endpoints.recorder_requests)
        self._publisher = Publisher(endpoints, "recorder")
        self._recorder = recorder
        self._told_ns = 0

    def step(self) -> None:
        """Take what has come, answer what is asked, tell how it stands."""
        wait_ms = WAIT_MS
        for _ in range(BURST):
            received = self._subscriber.receive(wait_ms)
            if received is None:
                break
            self._recorder.take(received, time.monotonic_ns())
            wait_ms = 0
        now_ns = time.monotonic_ns()
        self._recorder.idle(now_ns)
        self._answer(now_ns)
        if now_ns - self._told_ns >= STATUS_NS:
            self._told_ns = now_ns
            self._publisher.publish(RECORDER_STATUS.name, self._recorder.status(now_ns))

    def _answer(self, now_ns: int) -> None:
        question = self._replier.receive(0)
        if question is None:
            return
        try:
            request = decode(RecorderRequest, question)
        except InputError as error:
            self._replier.reply(RecorderReply(accepted=False, recording=False, reason=str(error)))
            return
        self._replier.reply(self._recorder.answer(request, now_ns, time.time_ns()))

    def close(self) -> None:
        """Finish the log."""
        self._recorder.close(time.monotonic_ns())
        self._subscriber.close()
        self._replier.close()
        self._publisher.close()


def main() -> None:
    """Record until SIGTERM."""
    parser = argparse.ArgumentParser(prog="recorder", description="Writes the logs of runs.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    endpoints = Endpoints(parser.parse_args().bus)
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    process = RecorderProcess(endpoints, Recorder())
    while not ended:
        process.step()
    process.close()


if __name__ == "__main__":
    main()

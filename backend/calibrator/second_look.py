"""Finds out why no board is seen: now and then, beside, and on a smaller picture, for it takes half a second."""

from __future__ import annotations

from concurrent.futures import Future, ThreadPoolExecutor

import cv2
import numpy as np

from navcore.calibration.board import Board, Image
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams

NS = 1_000_000_000
PATIENCE_NS = NS  # no board for so long
PAUSE_NS = 2 * NS  # from one look to the next
WIDTH_PX = 640


class SecondLook:
    """For one thread; the look itself is in another one."""

    def __init__(self, board: Board) -> None:
        self._finder = BoardFinder(board, BoardFinderParams())
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="second-look")
        self._future: Future[str] | None = None
        self._seen_ns: int | None = None
        self._looked_ns = 0
        self.why = ""

    def note(self, image: Image | None, stamp_ns: int, *, seen: bool) -> None:
        """A picture (H, W), grey, in which a board was seen or not. `why` tells what is known of it."""
        if self._future is not None and self._future.done():
            self.why, self._future = self._future.result(), None
        if seen or image is None or self._seen_ns is None:
            self._seen_ns, self.why = stamp_ns, ""
        elif (
            self._future is None and stamp_ns - self._seen_ns > PATIENCE_NS and stamp_ns - self._looked_ns > PAUSE_NS
        ):
            self._looked_ns = stamp_ns
            self._future = self._pool.submit(self._look, _smaller(image))

    def close(self) -> None:
        """Do not wait for what is under way."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _look(self, image: Image) -> str:
        found = self._finder.find(image)
        return (
            found if isinstance(found, str) else "The board is hardly seen. Hold it still and nearer, in even light."
        )


def _smaller(image: Image) -> Image:
    scale = WIDTH_PX / image.shape[1]
    if scale >= 1.0:
        return image
    return np.asarray(cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA), dtype=np.uint8)

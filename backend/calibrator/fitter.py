"""Works out the newest poses beside the live picture: it takes up to seconds."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from navcore.calibration.session.job import Fitted, Job
from navcore.calibration.session.state import Taken
from navcore.errors import CalibrationError, InputError

CALM_NS = 2_000_000_000
MOST_NEWER = 5  # poses


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outcome:
    """What came of the poses of a revision: a fit, or every reason why there is none."""

    revision: int
    fitted: Fitted | None = None
    reasons: tuple[str, ...] = ()


class Fitter:
    """One fit at a time, of poses that have not changed for a while: while they come in quickly, of every few."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="fit")
        self._future: Future[Outcome] | None = None
        self._revision, self._changed_ns = 0, 0
        self.outcome = Outcome(revision=-1)

    def hurry(self) -> None:
        """Somebody waits for the newest result."""
        self._changed_ns = 0

    def follow(self, revision: int, poses: Sequence[Taken], now_ns: int) -> bool:
        """Take in what has ended, and begin anew if there is something newer. True if the outcome is another one."""
        changed = self._take_in()
        if revision != self._revision:
            self._revision, self._changed_ns = revision, now_ns
        newer = revision - self.outcome.revision
        calm = now_ns - self._changed_ns > CALM_NS
        if self._future is None and newer and (calm or newer >= MOST_NEWER):
            self._future = self._pool.submit(fit, self._job, revision, tuple(poses))
        return changed

    def close(self) -> None:
        """Do not wait for what is under way."""
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _take_in(self) -> bool:
        if self._future is None or not self._future.done():
            return False
        self.outcome, self._future = self._future.result(), None
        self._job.note(self.outcome.fitted)
        return True


def fit(job: Job, revision: int, poses: Sequence[Taken]) -> Outcome:
    """The fit, or the sentences of why not."""
    try:
        return Outcome(revision=revision, fitted=job.fit(poses))
    except CalibrationError as error:
        return Outcome(revision=revision, reasons=error.reasons)
    except InputError as error:
        return Outcome(revision=revision, reasons=(str(error),))

"""Which sentence ends an epoch, learnt from the epochs before, so that a fix need not wait for the next one."""

from __future__ import annotations

from navcore.drivers.epoch import Epoch


class ClosingKind:
    """Trusts a kind after it has ended `NEEDED` epochs in a row, and never again once something came after it."""

    NEEDED = 3

    def __init__(self) -> None:
        self._kind = ""
        self._seen = 0
        self._wrong: set[str] = set()

    def learn(self, epoch: Epoch) -> None:
        """An epoch is complete."""
        self._seen = self._seen + 1 if epoch.last_kind == self._kind else 1
        self._kind = epoch.last_kind

    def forget(self, kind: str) -> None:
        """More came after this kind."""
        self._wrong.add(kind)
        self._seen = 0

    def ends(self, epoch: Epoch) -> bool:
        """Whether the epoch is complete with its newest part."""
        kind = epoch.last_kind
        return kind == self._kind and self._seen >= self.NEEDED and kind not in self._wrong

"""What became of the pose filter's measurements: counts, the newest of each kind, and the last word."""

from __future__ import annotations

from collections import Counter

from navcore.localization.verdict import Evidence, Verdict

NS = 1e-9


class FilterTally:
    """Attributes:
    accepted, rejected: by kind of evidence; of input that is not sound with the reason.
    relocations: times the pose was moved to where a receiver held to. reason: of the last refusal or move.
    """

    def __init__(self) -> None:
        self.accepted: Counter[str] = Counter()
        self.rejected: Counter[str] = Counter()
        self.relocations = 0
        self.reason = "no position yet"
        self._newest_ns: dict[Evidence, int] = {}

    def refuse(self, evidence: Evidence, reason: str) -> None:
        """Something that never reached the filter."""
        self.rejected[f"{evidence}: {reason}"] += 1
        self.reason = f"{evidence} refused: {reason}"

    def count(self, verdicts: list[Verdict], stamp_ns: int) -> None:
        """What the filter said of one measurement."""
        for verdict in verdicts:
            if verdict.accepted:
                self.accepted[verdict.evidence] += 1
                self._newest_ns[verdict.evidence] = stamp_ns
                self.relocations += bool(verdict.reason)
            else:
                self.rejected[verdict.evidence] += 1
        self.reason = "; ".join(v.reason for v in verdicts if v.reason)

    def age_s(self, now_ns: int, *evidence: Evidence) -> float | None:
        """Of the newest accepted one of these kinds."""
        stamps = [self._newest_ns[e] for e in evidence if e in self._newest_ns]
        return (now_ns - max(stamps)) * NS if stamps else None

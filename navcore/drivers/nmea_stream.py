"""A receiver's byte stream -> one `GnssFix` for each of its epochs."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass, field

from navcore.drivers.capture_clock import CaptureClock, CaptureClockParams
from navcore.drivers.closing_kind import ClosingKind
from navcore.drivers.epoch import BaselineMount, Epoch
from navcore.drivers.epoch_part import EpochPart
from navcore.drivers.fields import Fields
from navcore.drivers.nmea_sentences import NMEA_READERS
from navcore.drivers.receiver_calendar import ReceiverCalendar
from navcore.drivers.sentence import GNSS_TALKERS, Refused, Sentence, read_sentence
from navcore.drivers.sentence_framer import MAX_SENTENCE_BYTES, Line, SentenceFramer
from navcore.drivers.unicore_sentences import read_unicore
from navcore.drivers.vendor_sentences import VENDOR_READERS
from navcore.errors import SentenceError
from navcore.messages import GnssFix

SEVERAL = frozenset({"GSA"})
"""Kinds of which one epoch has more than one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NmeaStreamParams:
    """Parameters of `NmeaStream`.

    Attributes:
        mount: how the antenna baseline lies in the robot.
        clock: how receiver time becomes time of capture.
        quiet_s: silence after which an epoch is complete; shorter than the pause between bursts; 0.005 to 1 s.
        close_early: hand an epoch out at the sentence that ended the epochs before it. False waits for the next
            epoch, which suits files.
        live: refuse epochs that the receiver's clock does not bear out (repeated, or its time jumped). False suits
            files, where all arrives at once.
        earliest_year: an older date is a fault of the receiver (GPS weeks roll over after 19.6 years); 1980 to 2100.
        remembered: how many refusals are kept with their text; counts are never dropped.
    """

    mount: BaselineMount = field(default_factory=BaselineMount)
    clock: CaptureClockParams = field(default_factory=CaptureClockParams)
    quiet_s: float = 0.03
    close_early: bool = True
    live: bool = True
    earliest_year: int = 2010
    remembered: int = 1000


@dataclass(frozen=True, slots=True)
class Refusal:
    """Something that is no evidence.

    Attributes:
        offset: of its first byte in the stream.
        text: its beginning, as printable text.
    """

    reason: Refused
    offset: int
    arrival_ns: int
    text: str


class NmeaStream:
    """Incremental: feed bytes as they arrive, take the epochs that they complete.

    Attributes:
        refused_counts: how often each reason occurred.
        refusals: the newest of them with their text.
        clocks_ns: UTC time of day of the newest fixes handed out, one for each; None where nothing told it.
        unused: valid sentences that say nothing we need, by kind.
        sentences: number of valid sentences.
        lines: number of lines that wanted to be sentences.
    """

    def __init__(self, params: NmeaStreamParams | None = None) -> None:
        self._params = params or NmeaStreamParams()
        self._framer = SentenceFramer()
        self._calendar = ReceiverCalendar()
        self._clock = CaptureClock(self._params.clock)
        self._closing = ClosingKind()
        self._epoch: Epoch | None = None
        self._closed_early: Epoch | None = None
        self._newest_ns: int | None = None
        self.refused_counts: Counter[Refused] = Counter()
        self.refusals: deque[Refusal] = deque(maxlen=self._params.remembered)
        self.clocks_ns: deque[int | None] = deque(maxlen=self._params.remembered)
        self.unused: Counter[str] = Counter()
        self.sentences = 0
        self.lines = 0

    def feed(self, data: bytes, arrival_ns: int) -> list[GnssFix]:
        """Epochs that `data`, which arrived at monotonic `arrival_ns`, completes.

        An empty `data` tells that time has passed: silence completes an epoch.
        """
        fixes = list(self._after_silence(arrival_ns))
        for line in self._framer.feed(data):
            fixes.extend(self._line(line, arrival_ns))
        return fixes

    def flush(self, arrival_ns: int) -> list[GnssFix]:
        """Epochs left at the end of the stream."""
        fixes: list[GnssFix] = []
        for line in self._framer.flush():
            fixes.extend(self._line(line, arrival_ns))
        fixes.extend(self._close())
        return fixes

    def _after_silence(self, now_ns: int) -> Iterator[GnssFix]:
        if self._epoch is not None and now_ns - self._epoch.last_arrival_ns > self._params.quiet_s * 1e9:
            yield from self._close()

    def _line(self, line: Line, arrival_ns: int) -> Iterator[GnssFix]:
        try:
            part = self._part(line)
        except SentenceError as error:
            self._refuse(Refused(str(error)), line, arrival_ns)
            return
        if part is not None:
            yield from self._take(part, line, arrival_ns)

    def _part(self, line: Line) -> EpochPart | None:
        if not line.is_text:
            raise SentenceError(Refused.NOT_TEXT)
        self.lines += 1
        if line.size > MAX_SENTENCE_BYTES:
            raise SentenceError(Refused.TOO_LONG)
        sentence = read_sentence(line.data)
        self.sentences += 1
        part = self._read(sentence)
        if part is None:
            self.unused[sentence.kind] += 1
        return part

    def _read(self, sentence: Sentence) -> EpochPart | None:
        if sentence.talker == "#":
            return read_unicore(sentence, self._params.earliest_year)
        fields = Fields(sentence.fields, self._params.earliest_year)
        if sentence.talker == "P":
            vendor = VENDOR_READERS.get(sentence.kind)
            return None if vendor is None else vendor(fields)
        reader = NMEA_READERS.get(sentence.kind) or VENDOR_READERS.get(sentence.kind)
        if reader is not None and sentence.talker not in GNSS_TALKERS:
            raise SentenceError(Refused.TALKER)
        return None if reader is None else reader(fields)

    def _take(self, part: EpochPart, line: Line, arrival_ns: int) -> Iterator[GnssFix]:
        if self._belongs_to_closed(part):
            if self._closed_early is not None and part.kind in self._closed_early.parts and part.kind not in SEVERAL:
                self._refuse(Refused.DUPLICATE, line, arrival_ns)
            return
        if self._epoch is not None and self._starts_next(part, self._epoch):
            yield from self._close()
        if self._epoch is None:
            self._epoch = Epoch(arrival_ns, line.offset)
        self._epoch.add(part, arrival_ns)
        if self._params.close_early and self._closing.ends(self._epoch):
            self._closed_early = self._epoch
            yield from self._close()

    def _belongs_to_closed(self, part: EpochPart) -> bool:
        """Whether an epoch that was handed out already should have had this: learn that it ends elsewhere."""
        done = self._closed_early
        if done is None or self._epoch is not None:
            return False
        if part.clock_ns is not None and part.day is not None and part.clock_ns == done.clock_ns:
            self._calendar.learn(part.day, part.clock_ns)
        same_time = part.clock_ns is not None and part.clock_ns == done.clock_ns
        untimed_and_new = part.clock_ns is None and part.kind not in done.parts
        if (same_time or untimed_and_new) and part.kind not in done.parts:
            self._closing.forget(done.last_kind)
        return same_time or untimed_and_new or part.kind in SEVERAL

    def _starts_next(self, part: EpochPart, epoch: Epoch) -> bool:
        if part.clock_ns is not None and epoch.clock_ns is not None:
            return part.clock_ns != epoch.clock_ns
        return part.kind in epoch.parts and part.kind not in SEVERAL

    def _close(self) -> Iterator[GnssFix]:
        epoch, self._epoch = self._epoch, None
        if epoch is None:
            return
        self._closing.learn(epoch)
        fix = self._fix(epoch)
        if fix is not None:
            self.clocks_ns.append(epoch.clock_ns)
            yield fix

    def _fix(self, epoch: Epoch) -> GnssFix | None:
        for kind in epoch.drop_disagreeing():
            self._remember(Refusal(Refused.DISAGREES, epoch.offset, epoch.arrival_ns, kind))
        running_ns = self._running_ns(epoch)
        utc_ns = None if running_ns is None else self._calendar.utc_ns(running_ns)
        captured = self._capture(epoch, running_ns)
        if isinstance(captured, Refused):
            text = " + ".join(epoch.parts)
            self._remember(Refusal(captured, epoch.offset, epoch.arrival_ns, text))
            return None
        return epoch.fix(captured, utc_ns, self._params.mount)

    def _running_ns(self, epoch: Epoch) -> int | None:
        for part in epoch.parts.values():
            if part.day is not None and part.clock_ns is not None:
                self._calendar.learn(part.day, part.clock_ns)
        return None if epoch.clock_ns is None else self._calendar.running_ns(epoch.clock_ns)

    def _capture(self, epoch: Epoch, running_ns: int | None) -> int | Refused:
        if running_ns is None or not self._params.live:
            return self._clock.unknown_ns(epoch.arrival_ns)
        if running_ns == self._newest_ns:
            return Refused.DUPLICATE
        if self._is_out_of_order(running_ns):
            return Refused.TIME
        stamp_ns = self._clock.capture_ns(running_ns, epoch.arrival_ns)
        if stamp_ns is None:
            return Refused.CLOCK_JUMP
        self._newest_ns = running_ns
        return stamp_ns

    def _is_out_of_order(self, running_ns: int) -> bool:
        """A little older than the newest: an old packet. Much older: for the clock to judge."""
        if self._newest_ns is None:
            return False
        return 0 < self._newest_ns - running_ns <= self._params.clock.latest_s * 1e9

    def _refuse(self, reason: Refused, line: Line, arrival_ns: int) -> None:
        text = line.data[:120].decode("ascii") if line.is_text else f"{line.size} bytes"
        self._remember(Refusal(reason, line.offset, arrival_ns, text))

    def _remember(self, refusal: Refusal) -> None:
        self.refused_counts[refusal.reason] += 1
        self.refusals.append(refusal)

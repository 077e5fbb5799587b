"""Which source to drive on: a pure function of what is known now and of the mode before.

The table below is the whole policy. Each switch carries the sentence that caused it; its numbers are logged with it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from navcore.messages import NavMode, SegmentKind

# Driven on what the camera sees; along a row; by odometry, where nothing ahead says where the path lies.
ON_CAMERA = frozenset({NavMode.ROW_ENTRY, NavMode.ROW})
ALONG_ROW = frozenset({NavMode.ROW, NavMode.ROW_END})
CARRIED = frozenset({NavMode.ROW_END, NavMode.HEADLAND})


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeSelectorParams:
    """Parameters of `select_mode`.

    Attributes:
        streak: agreeing row observations in a row before the camera is trusted, >= 1.
        lost_s: without one for this long before the entrance, the camera is not trusted any more, s.
        end_zone: distance to the row's end at which the robot drives on by odometry, m.
        seen_end_zone: the same where the camera has seen that end, m.
        again: a row seen to go on for more than this takes the robot back into it, m (hysteresis to `end_zone`).
        clear: distance past the row's end at which the row is left and GNSS may take over, m.
        gnss_std: position 1-sigma at which GNSS may take over, m.
        gnss_streak: good epochs in a row before it does.
    """

    streak: int = 5
    lost_s: float = 1.0
    end_zone: float = 2.5
    seen_end_zone: float = 4.0
    again: float = 5.0
    clear: float = 1.0
    gnss_std: float = 0.12
    gnss_streak: int = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeFacts:
    """What the selector looks at.

    Attributes:
        segment: kind of the planned segment here.
        to_start, to_end: metres ahead at which the row here begins and ends; None away from rows.
        row_streak: consecutive observations that are valid and agree with the expected row.
        row_age_s: age of the last such observation, None if there was none.
        row_follows: the headland leads to another row: its place is known best from the row that is left.
        turn_follows: the straight way out of the row goes over into a turn on the headland.
        looks: the camera shows pictures, whether there is a row in them or not.
        seen_end: distance ahead at which the camera sees the row end, None where it sees none.
        seen_to: distance ahead up to which it sees the row go on, None where it cannot say so.
        gnss_std: 1-sigma of the pose filter's position, m, None without a pose.
        gnss_streak: consecutive good epochs.
    """

    segment: SegmentKind
    to_start: float | None
    to_end: float | None
    row_follows: bool
    turn_follows: bool
    row_streak: int
    row_age_s: float | None
    looks: bool
    seen_end: float | None
    seen_to: float | None
    gnss_std: float | None
    gnss_streak: int


@dataclass(frozen=True, slots=True)
class Switch:
    """One line of the table: from one of `before` to `after` when `when` holds."""

    before: frozenset[NavMode]
    after: NavMode
    when: Callable[[ModeFacts, ModeSelectorParams], bool]
    reason: Callable[[ModeFacts], str]


def _row_trusted(f: ModeFacts, p: ModeSelectorParams) -> bool:
    return f.row_streak >= p.streak


def _near_row(f: ModeFacts) -> bool:
    return f.segment in (SegmentKind.ENTRY, SegmentKind.ROW) and f.to_end is not None and f.to_end > 0.0


def _inside(f: ModeFacts) -> bool:
    return f.to_start is not None and f.to_start <= 0.0 and _near_row(f)


def _lost(f: ModeFacts, p: ModeSelectorParams) -> bool:
    return f.row_age_s is None or f.row_age_s > p.lost_s


def _at_end(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """By the row's end where it is known: the path may slide back over a joint when the row's place is corrected.

    Near the end the last plants leave the picture, so an end that is seen counts from further away, and too few of
    them to make a row are its last ones: a robot that was stopped there would wait for ever.
    """
    if f.to_end is None:
        return f.segment in (SegmentKind.EXIT, SegmentKind.HEADLAND, SegmentKind.ROAD)
    seen = f.seen_end is not None and f.seen_end < p.seen_end_zone and f.to_end < p.again
    last_plants = f.looks and _lost(f, p) and f.to_end < p.again
    return seen or last_plants or f.to_end < p.end_zone


def _row_goes_on(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """Near its end plants must be seen beyond: two false ones make the camera lose the end, but no longer row."""
    if f.segment is not SegmentKind.ROW or f.to_end is None or f.to_end <= p.end_zone:
        return False
    ahead = max(f.to_end, f.seen_to or 0.0) if f.seen_end is None else f.seen_end
    return _row_trusted(f, p) and ahead > p.again


def _gnss_good(f: ModeFacts, p: ModeSelectorParams) -> bool:
    return f.gnss_std is not None and f.gnss_std <= p.gnss_std and f.gnss_streak >= p.gnss_streak


def _left(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """Past the row's end, and no picture of now shows more of the row ahead."""
    passed = f.to_end is None or f.to_end <= -p.clear
    ends_ahead = f.seen_end is not None and f.seen_end > p.clear and not _lost(f, p)
    return passed and not ends_ahead


def _clear(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """In a bend too: the path slides from where it lay on the row to where it is drawn, and never leaves both."""
    here = f.segment in (SegmentKind.EXIT, SegmentKind.HEADLAND, SegmentKind.ROAD)
    return _left(f, p) and not f.row_follows and here


def _turns(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """On the straight before a turn already: sources change where it is driven straight on."""
    return f.segment is SegmentKind.HEADLAND or (f.turn_follows and _left(f, p))


def _metres(value: float | None) -> str:
    return "unknown" if value is None else f"{value:.2f} m"


def _row_ahead(f: ModeFacts) -> str:
    return f"row ahead seen in {f.row_streak} pictures, entrance in {_metres(f.to_start)}"


SWITCHES: tuple[Switch, ...] = (
    Switch(
        frozenset({NavMode.GNSS_PATH, NavMode.HEADLAND}),
        NavMode.ROW,
        lambda f, p: _inside(f) and _row_trusted(f, p),
        lambda f: f"row seen in {f.row_streak} pictures, {_metres(f.to_end)} to its end",
    ),
    Switch(
        frozenset({NavMode.GNSS_PATH}),
        NavMode.ROW_ENTRY,
        lambda f, p: _near_row(f) and _row_trusted(f, p),
        _row_ahead,
    ),
    Switch(
        frozenset({NavMode.ROW_ENTRY}),
        NavMode.ROW,
        lambda f, p: _inside(f) and _row_trusted(f, p),
        lambda f: f"entrance passed, row seen in {f.row_streak} pictures",
    ),
    Switch(
        frozenset({NavMode.ROW_ENTRY}),
        NavMode.GNSS_PATH,
        lambda f, p: not _inside(f) and _lost(f, p) and _gnss_good(f, p),
        lambda f: f"row not seen any more, entrance in {_metres(f.to_start)}",
    ),
    Switch(
        frozenset({NavMode.ROW, NavMode.ROW_ENTRY}),
        NavMode.ROW_END,
        lambda f, p: _at_end(f, p),
        lambda f: f"end of the row in {_metres(f.to_end)}",
    ),
    Switch(
        frozenset({NavMode.ROW_END}),
        NavMode.ROW,
        lambda f, p: _row_goes_on(f, p),
        lambda f: f"the row goes on, {_metres(f.to_end)} to its end",
    ),
    Switch(
        frozenset({NavMode.ROW_END, NavMode.HEADLAND}),
        NavMode.GNSS_PATH,
        lambda f, p: _clear(f, p) and _gnss_good(f, p),
        lambda f: f"row left, GNSS position known to {_metres(f.gnss_std)}",
    ),
    Switch(
        frozenset({NavMode.ROW_END}),
        NavMode.HEADLAND,
        _turns,
        lambda f: f"row left, turning over the headland, position known to {_metres(f.gnss_std)}",
    ),
)


def select_mode(before: NavMode, facts: ModeFacts, params: ModeSelectorParams) -> tuple[NavMode, str | None]:
    """The mode for now, and why it changed (None if it did not)."""
    for switch in SWITCHES:
        if before in switch.before and switch.when(facts, params):
            return switch.after, switch.reason(facts)
    return before, None


def start_reason(gnss_std: float | None) -> str:
    """Why a mission starts on GNSS: nothing else tells where its path lies."""
    return f"mission started, position known to {_metres(gnss_std)}"

"""Which source to drive on: a pure function of what is known now and of the mode before.

The table below is the whole policy. Each switch carries the sentence that caused it; its numbers are logged with it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from navcore.messages import NavMode, SegmentKind
from navcore.mission.mode_facts import ModeFacts, ModeSelectorParams

# Driven on what the camera sees; on the pose filter's pose; along a row; by odometry, where nothing ahead says where
# the path lies.
ON_CAMERA = frozenset({NavMode.ROW_ENTRY, NavMode.ROW})
ON_POSE = frozenset({NavMode.GNSS_PATH, NavMode.MAP})
ALONG_ROW = frozenset({NavMode.ROW, NavMode.ROW_END})
CARRIED = frozenset({NavMode.ROW_END, NavMode.HEADLAND})


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


def _map_good(f: ModeFacts, p: ModeSelectorParams) -> bool:
    fresh = f.map_streak >= p.map_streak and f.map_age_s is not None and f.map_age_s <= p.map_age_s
    return fresh and f.gnss_std is not None and f.gnss_std <= p.map_std


def _row_gone(f: ModeFacts, p: ModeSelectorParams) -> bool:
    """Not seen any more while there is still row ahead, and the map knows the way through or up to it."""
    gone = f.row_age_s is None or f.row_age_s > p.row_gone_s
    return gone and _map_good(f, p) and (f.map_leads or not _inside(f))


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
        frozenset({NavMode.GNSS_PATH, NavMode.HEADLAND, NavMode.MAP}),
        NavMode.ROW,
        lambda f, p: _inside(f) and _row_trusted(f, p),
        lambda f: f"row seen in {f.row_streak} pictures, {_metres(f.to_end)} to its end",
    ),
    Switch(
        frozenset({NavMode.GNSS_PATH, NavMode.MAP}),
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
        frozenset({NavMode.MAP}),
        NavMode.GNSS_PATH,
        lambda f, p: not _inside(f) and _gnss_good(f, p),
        lambda f: f"GNSS position known to {_metres(f.gnss_std)} again",
    ),
    Switch(
        frozenset({NavMode.GNSS_PATH}),
        NavMode.MAP,
        lambda f, p: f.gnss_streak == 0 and not _inside(f) and _map_good(f, p),
        lambda f: f"GNSS without a fix, place on the 3D map known to {_metres(f.gnss_std)}",
    ),
    Switch(
        frozenset({NavMode.ROW, NavMode.ROW_ENTRY}),
        NavMode.MAP,
        _row_gone,
        lambda f: f"row not seen any more, place on the 3D map known to {_metres(f.gnss_std)}",
    ),
    Switch(
        frozenset({NavMode.ROW_END, NavMode.HEADLAND}),
        NavMode.MAP,
        lambda f, p: _clear(f, p) and _map_good(f, p),
        lambda f: f"row left, place on the 3D map known to {_metres(f.gnss_std)}",
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

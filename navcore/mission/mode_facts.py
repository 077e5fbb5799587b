"""What the choice of the source to drive on looks at, and the limits that it holds it to."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.messages import SegmentKind


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
        map_streak: matches on the 3D map in a row before the robot drives on it where everything else is weak.
        map_age_s: age of the newest match up to which it does, s. map_std: position 1-sigma, m.
        row_gone_s: a row not seen for so long is driven on by the map where that is known to lead through it, s.
    """

    streak: int = 5
    lost_s: float = 1.0
    end_zone: float = 2.5
    seen_end_zone: float = 4.0
    again: float = 5.0
    clear: float = 1.0
    gnss_std: float = 0.12
    gnss_streak: int = 5
    map_streak: int = 5
    map_age_s: float = 0.5
    map_std: float = 0.1
    row_gone_s: float = 0.3


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
        map_streak, map_age_s: consecutive matches on the 3D map that are believed, and the age of the newest.
        map_leads: the row here was seen to lie where it is drawn, so that the map leads through it.
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
    map_streak: int = 0
    map_age_s: float | None = None
    map_leads: bool = False

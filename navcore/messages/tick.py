"""What one tick of the navigator consumed, and what it decided."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.chassis.protocol import ChassisState, GuardRequest, MotionCommand
from navcore.messages.camera import CameraRequest, RowObservation
from navcore.messages.map_match import MapMatch
from navcore.messages.request import Reply, Request
from navcore.messages.sensing import GnssFix, ImuSample
from navcore.messages.status import ModeSwitch, NavStatus


@dataclass(frozen=True, slots=True, kw_only=True)
class NavInputs:
    """All that one tick consumed, oldest first. Logged as consumed: replay feeds it to `step()` again."""

    now_ns: int
    chassis: tuple[ChassisState, ...] = ()
    imu: tuple[ImuSample, ...] = ()
    gnss: tuple[GnssFix, ...] = ()
    rows: tuple[RowObservation, ...] = ()
    requests: tuple[Request, ...] = ()
    matches: tuple[MapMatch, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """Outcome of one tick.

    Attributes:
        command: for the guard; None means: send nothing (silence means stop).
        switch: set in the tick in which the mode changed.
        camera: what the row worker should look at; None where no row matters.
        guard_request: sent to the guard before the command: ARM in every tick from a deliberate start until the guard
            is ARMED, DISARM at the end of a run, ACKNOWLEDGE after the operator has acknowledged the guard's latch.
        replies: answers to the requests that this tick consumed.
    """

    stamp_ns: int
    command: MotionCommand | None
    status: NavStatus
    switch: ModeSwitch | None
    camera: CameraRequest | None
    guard_request: GuardRequest | None = None
    replies: tuple[Reply, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class NavPrelude:
    """All that the navigator consumed before the run, since it was new: replay begins with it.

    Attributes:
        config: settings of the robot as JSON.
        datum: (lat_deg, lon_deg, height_m) of the site.
        complete: False if there was too much to keep; then the run cannot be replayed exactly.
    """

    stamp_ns: int
    run_id: str
    config: str
    datum: tuple[float, float, float]
    complete: bool
    inputs: tuple[NavInputs, ...]

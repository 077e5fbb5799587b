"""When a camera's mount has moved, and what the operator is told then."""

from __future__ import annotations

import math

from navcore.mission.events.facts import EventFacts, EventParams


def is_askew(f: EventFacts, p: EventParams) -> bool:
    """It leans to the side against the IMU."""
    return abs(f.askew[0]) > max(math.radians(p.askew_deg), 2.0 * f.askew[1])


def askew_words(f: EventFacts) -> str:
    """By how much, and to which side."""
    side = "right" if f.askew[0] > 0.0 else "left"
    return (
        f"The camera leans {abs(math.degrees(f.askew[0])):.0f} degrees to the {side}: its mount has moved. "
        "The robot allows for it; straighten it."
    )


def is_pitched(f: EventFacts, p: EventParams) -> bool:
    """It looks further up or down than its settings say."""
    m = f.mount
    return m is not None and abs(m.pitch) > max(math.radians(p.pitched_deg), 2.0 * m.pitch_std)


def pitched_words(f: EventFacts) -> str:
    """By how much, and which way."""
    pitch = f.mount.pitch if f.mount else 0.0
    return (
        f"The camera looks {abs(math.degrees(pitch)):.0f} degrees further {'down' if pitch > 0.0 else 'up'} than its "
        "settings say: its mount has moved. Straighten it, or correct its pitch in the settings."
    )


def is_raised(f: EventFacts, p: EventParams) -> bool:
    """It stands higher or lower than its settings say."""
    m = f.mount
    return m is not None and abs(m.height - m.told_height) > max(p.raised, 2.0 * m.height_std)


def raised_words(f: EventFacts) -> str:
    """How high it stands, and how high it should."""
    height, told = (f.mount.height, f.mount.told_height) if f.mount else (0.0, 0.0)
    return (
        f"The camera seems to stand {height:.2f} m high, and its settings say {told:.2f} m: what it sees is further "
        "away or nearer than it seems. Measure it, and correct the settings."
    )


def is_turned(f: EventFacts) -> bool:
    """It looks past the trunks that the LiDAR shows it. A warning only: the LiDAR tells where the rows are."""
    return f.agreement is not None and f.agreement.moved


def turned_words(f: EventFacts) -> str:
    """By how much, to which side, and how surely."""
    yaw, std = (f.agreement.yaw, f.agreement.yaw_std) if f.agreement else (0.0, 0.0)
    return (
        f"The camera looks {abs(math.degrees(yaw)):.1f} degrees (± {math.degrees(std):.1f}) further "
        f"{'left' if yaw > 0.0 else 'right'} than the LiDAR says: a mount has moved. Fix it, and calibrate again."
    )

"""Why a packet, or a turn, of a 3D LiDAR is no evidence."""

from __future__ import annotations

from enum import StrEnum


class Refused(StrEnum):
    """Counted by reason; the text is for the operator. From CLOCK_JUMP on it is a turn that is dropped."""

    FOREIGN = "no packet of this LiDAR"
    SHORT = "cut short on its way"
    OTHER_MODEL = "of another model than is set"
    NO_MODEL = "of a model that nothing has told yet"
    AZIMUTH = "its head does not turn evenly"
    REPEATED = "came twice"
    LATE = "older than the one before"
    CLOCK_JUMP = "its clock jumped"
    SILENCE = "no packets for a while"
    AZIMUTH_BACK = "its head jumped back"
    TORN_TURN = "turn with too many packets lost"

"""Parameters of the pilot."""

from __future__ import annotations

from dataclasses import dataclass, field

from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.mission.along_row import AlongRowParams
from navcore.mission.along_trunks import AlongTrunksParams
from navcore.mission.evidence import RowEvidenceParams
from navcore.mission.mode_facts import ModeSelectorParams


@dataclass(frozen=True, slots=True, kw_only=True)
class PilotParams:
    """Parameters of `Pilot`.

    Attributes:
        arrival: a leg counts as driven this close to its end, m.
        capture: the path counts as reached this close to it, m.
        search: half width of the search for the place on the path, m.
        look_out: the camera is used from this far before a row's entry segment, m.
        drift_std: position 1-sigma at which GNSS tells how odometry drifts while the path is carried by it, m.
        turned_to: by so much the robot may be turned away from the next row that it drives up to, rad, for the camera
            to say where that row lies.
        scanned_share: of its told variance at which a line through scanned plants is taken. It is the best one by all
            of them already, and is to be followed where the row bends, not averaged with earlier ones.
    """

    arrival: float = 0.12
    capture: float = 0.25
    search: float = 3.0
    look_out: float = 4.0
    drift_std: float = 0.05
    turned_to: float = 0.35
    scanned_share: float = 0.03
    anchor: PathAnchorParams = field(default_factory=PathAnchorParams)
    along: AlongRowParams = field(default_factory=AlongRowParams)
    trunks: AlongTrunksParams = field(default_factory=AlongTrunksParams)
    row: RowEvidenceParams = field(default_factory=RowEvidenceParams)
    mode: ModeSelectorParams = field(default_factory=ModeSelectorParams)

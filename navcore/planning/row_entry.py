"""Before a row's entrance: straight, centred, far enough away for the camera to see the row."""

from __future__ import annotations

import numpy as np

from navcore.planning.connection import Option
from navcore.planning.driven_row import DrivenRow
from navcore.planning.params import PlanningParams

# Each metre of the wanted straight run that is missing costs this many metres of way.
_SHORT = 2.5


def entry_options(row: DrivenRow, params: PlanningParams) -> list[Option]:
    """Poses on the row's axis at which the straight run may begin; the key is its length, m."""
    lengths = np.arange(params.least_entry, params.entry_length + 1e-6, 0.5)
    return [
        Option(row.pose(-float(d)), float(d) + _SHORT * (params.entry_length - float(d)), float(d)) for d in lengths
    ]

"""Which labelled objects a detector is asked for, where a rendered set tells enough to choose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

_TOLD = ("visible", "range", "rows_nearer", "bbox")


@dataclass(frozen=True, slots=True, kw_only=True)
class AskRule:
    """Attributes:
    min_visible: share of the object that must be seen, 0 to 1.
    min_height_px: of its box.
    max_range: from the camera, m.
    nearest_rows: of so many rows, of those that are nearest to the camera; what stands in no row is asked for too.
    """

    min_visible: float
    min_height_px: float
    max_range: float
    nearest_rows: int

    def applies(self, annotation: dict[str, Any]) -> bool:
        """Whether the annotation tells enough."""
        return all(name in annotation for name in _TOLD)

    def ignores(self, annotation: dict[str, Any]) -> bool:
        """Whether the annotated object is neither asked for nor a mistake."""
        return bool(
            annotation["visible"] < self.min_visible
            or annotation["bbox"][3] < self.min_height_px
            or annotation["range"] > self.max_range
            or annotation["rows_nearer"] >= self.nearest_rows
        )


# Training asks for a little more than what counts, so that nothing changes just where the counting begins.
TRAINED = AskRule(min_visible=0.3, min_height_px=12.0, max_range=14.0, nearest_rows=4)

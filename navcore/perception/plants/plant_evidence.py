"""How sure it is that an upright is a trunk or a post: by its shape in scans, and by what the camera makes of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantEvidenceParams:
    """Log odds. Ours; set on tuning farms.

    Attributes:
        prior: of an upright that comes first.
        thin, thick: diameters between which trunks and posts lie, m; soft: by so much they may lie outside, m.
        shape, rough: what a fitting diameter adds, and what each 1-sigma of roughness beyond 1.5 takes away, a scan.
        most_shape: shape alone says no more, either way.
        past: what a scan takes away that looks past it, and one that meets it gives back. most_past: of that no more.
        box, blank: what a picture adds that shows it as a trunk or post, and takes away that should and does not.
        most: nothing is surer than that.
    """

    prior: float = -0.5
    thin: float = 0.04
    thick: float = 0.22
    soft: float = 0.02
    shape: float = 0.15
    rough: float = 0.3
    most_shape: float = 1.0
    past: float = 0.5
    most_past: float = 8.0
    box: float = 0.8
    blank: float = 0.25
    most: float = 4.0


class PlantEvidence:
    """In the order of the tracker's plants."""

    def __init__(self, params: PlantEvidenceParams) -> None:
        self._params = params
        self._shape: Floats = np.empty(0)
        self._past: Floats = np.empty(0)
        self._seen: Floats = np.empty(0)

    def sureness(self) -> Floats:
        """(N,) 0 to 1."""
        odds = self._params.prior + self._shape + self._seen - self._past
        return np.asarray(1.0 / (1.0 + np.exp(-odds)), dtype=np.float64)

    def add(self, diameter: Floats, roughness: Floats, cut: Mask) -> None:
        """New uprights."""
        self._shape = np.concatenate((self._shape, self._by_shape(diameter, roughness, cut)))
        self._past = np.concatenate((self._past, np.zeros(len(diameter))))
        self._seen = np.concatenate((self._seen, np.zeros(len(diameter))))

    def met(self, i: Ints, diameter: Floats, roughness: Floats, cut: Mask) -> None:
        """Known ones (K,), met again."""
        most = self._params.most_shape
        self._shape[i] = np.clip(self._shape[i] + self._by_shape(diameter, roughness, cut), -most, most)

    def scan(self, met: Mask, past: Mask) -> None:
        """Which of all of them (N,) a scan meets, and which it looks past."""
        p = self._params
        self._past = np.clip(self._past + p.past * past - p.past * met, 0.0, p.most_past)

    def see(self, boxed: Mask, blank: Mask) -> None:
        """What one picture says of all of them (N,)."""
        p = self._params
        self._seen = np.clip(self._seen + p.box * boxed - p.blank * blank, -p.most, p.most)

    def keep(self, mask: Mask) -> None:
        """Forget the others."""
        self._shape, self._past, self._seen = self._shape[mask], self._past[mask], self._seen[mask]

    def _by_shape(self, diameter: Floats, roughness: Floats, cut: Mask) -> Floats:
        p = self._params
        outside = np.maximum(np.maximum(p.thin - diameter, diameter - p.thick), 0.0) / p.soft
        fits = np.where(cut, 0.0, p.shape * (1.0 - np.minimum(outside, 3.0)))
        return np.asarray(fits - p.rough * np.maximum(roughness - 1.5, 0.0), dtype=np.float64)

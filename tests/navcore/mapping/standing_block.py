"""A small block of posts and trunks as rays see it: what a run of a 3D LiDAR leaves, without a simulator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.trellis.seen_cloud import SeenCloud

Floats = NDArray[np.float64]

POST_RADIUS, TRUNK_RADIUS = 0.05, 0.035
POST_HEIGHT, TRUNK_HEIGHT = 2.2, 1.1
SENSOR_HEIGHT = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class StandingBlock:
    """Lines of posts along x, `width` apart across y, a trunk half way between posts, on a gentle slope.

    Attributes:
        heading: by which all of it is turned about the origin, rad. slope: of the ground along x, m per m.
        margin: of open ground around, m.
    """

    lines: int = 4
    posts: int = 5
    width: float = 6.0
    spacing: float = 6.0
    heading: float = 0.0
    slope: float = 0.02
    margin: float = 12.0

    @property
    def length(self) -> float:
        return (self.posts - 1) * self.spacing

    def turned(self, xy: Floats) -> Floats:
        c, s = np.cos(self.heading), np.sin(self.heading)
        return np.asarray(xy @ np.array(((c, s), (-s, c))))

    def post_places(self) -> Floats:
        """(P, 2), line by line."""
        return self.turned(self._grid(np.asarray(np.arange(self.posts) * self.spacing, dtype=np.float64)))

    def trunk_places(self) -> Floats:
        return self.turned(self._grid(np.asarray((np.arange(self.posts - 1) + 0.5) * self.spacing, dtype=np.float64)))

    def _grid(self, along: NDArray[np.floating[Any]]) -> Floats:
        return np.array([(x, k * self.width) for k in range(self.lines) for x in along])

    def seen(self, *, missing: tuple[int, ...] = (), seed: int = 0, rays: bool = True, leaves: int = 0) -> SeenCloud:
        """One run down each alley. `missing` posts are gone; so many `leaves` hang about the lines."""
        rng = np.random.default_rng(seed)
        posts = [p for k, p in enumerate(self.post_places()) if k not in missing]
        pieces = [self._ground(rng)]
        pieces += [self._shaft(p, POST_RADIUS, POST_HEIGHT, rng) for p in posts]
        pieces += [self._shaft(t, TRUNK_RADIUS, TRUNK_HEIGHT, rng) for t in self.trunk_places()]
        pieces.append(self._leaves(leaves, rng))
        points = np.concatenate([piece[0] for piece in pieces])
        origins = np.concatenate([piece[1] for piece in pieces])
        gone = [self._through(p, rng) for k, p in enumerate(self.post_places()) if k in missing]
        points = np.concatenate([points, *(ends for ends, _ in gone)])
        origins = np.concatenate([origins, *(begins for _, begins in gone)])
        return SeenCloud(points=points, origins=origins if rays else None, name=f"run {seed}")

    def _floor(self, xy: Floats) -> Floats:
        return np.asarray(self.slope * xy[:, 0])

    def _ground(self, rng: np.random.Generator) -> tuple[Floats, Floats]:
        low, high = -self.margin, np.array((self.length, (self.lines - 1) * self.width)) + self.margin
        count = int(np.prod(high - low) * 40)
        xy = self.turned(rng.uniform(low, high, (count, 2)))
        points = np.column_stack((xy, self._floor(xy) + rng.normal(0.0, 0.01, count)))
        return points, points + np.array((0.0, 0.0, SENSOR_HEIGHT))

    def _shaft(self, place: Floats, radius: float, height: float, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Rays from both sides that end on a cylinder; above it they go on."""
        count = 500
        origins = self._origins(place, count, rng)
        away = origins[:, :2] - place
        away /= np.linalg.norm(away, axis=1, keepdims=True)
        across = np.column_stack((-away[:, 1], away[:, 0]))
        u = rng.uniform(-1.0, 1.0, (count, 1))
        xy = place + radius * (u * across + np.sqrt(1.0 - u * u) * away)
        z = self._floor(place[None])[0] + rng.uniform(0.0, 2.4, count)
        over = z - self._floor(place[None])[0] > height
        points = np.column_stack((xy + rng.normal(0.0, 0.01, (count, 2)), z))
        points[over] = origins[over] + 2.2 * (points[over] - origins[over])
        return points, origins

    def _through(self, place: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Rays that pass where a post once stood."""
        origins = self._origins(place, 300, rng)
        z = self._floor(place[None])[0] + rng.uniform(0.2, 2.2, 300)
        ends = np.column_stack((2.0 * place - origins[:, :2], 2.0 * z - origins[:, 2]))
        return ends, origins

    def _origins(self, place: Floats, count: int, rng: np.random.Generator) -> Floats:
        local = self.turned(np.array((place,)))[0] if self.heading == 0.0 else place
        side = np.where(rng.random(count) < 0.5, 1.0, -1.0) * self.width / 2
        offset = self.turned(np.column_stack((rng.uniform(-4.0, 4.0, count), side)))
        xy = local + offset
        return np.column_stack((xy, self._floor(xy) + SENSOR_HEIGHT))

    def _leaves(self, count: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Points about the lines from the fork up, elsewhere in every run."""
        x, line = rng.uniform(0.0, self.length, count), rng.integers(0, self.lines, count)
        xy = self.turned(np.column_stack((x, line * self.width + rng.normal(0.0, 0.3, count))))
        points = np.column_stack((xy, self._floor(xy) + rng.uniform(1.1, 2.6, count)))
        side = self.turned(np.tile((0.0, self.width / 2), (count, 1)))
        return points, np.column_stack((xy + side, self._floor(xy) + SENSOR_HEIGHT))

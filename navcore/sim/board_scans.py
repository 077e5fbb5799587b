"""Scans of a calibration board in a room as a 2D LiDAR takes them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import Board

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardScanParams:
    """The LiDAR of paper B in a room with the person who holds the board.

    Attributes:
        step_deg: between rays; > 0. turns: taken while the board is held; 1 or more.
        range_std: 1-sigma of a distance, m; >= 0. resolution: distances are told in such steps, m; 0 for none.
        lost: share of rays that come back with nothing; 0 to 1.
        room: half width of the square room around the LiDAR, m; > 0.
        person: radius of the person's body that stands a board's width behind the board, m; 0 for none.
    """

    step_deg: float = 0.225
    turns: int = 1
    range_std: float = 0.01
    resolution: float = 0.00025
    lost: float = 0.01
    room: float = 3.0
    person: float = 0.18


class BoardScans:
    """One LiDAR, one board."""

    def __init__(self, board: Board, params: BoardScanParams) -> None:
        self._outline, self._plate, self._params = board.outline(), board.plate, params

    def scan(self, T_lidar_board: Floats, rng: np.random.Generator) -> tuple[Floats, Floats]:
        """Angles (N,), rad, in [0, 2 pi) for each turn, and distances (N,), m, 0 where nothing came back."""
        p = self._params
        rays = round(360.0 / p.step_deg)
        starts = np.arange(p.turns)[:, None] * rng.uniform(0.0, 1.0) / max(p.turns, 1)
        angles = np.radians(p.step_deg) * (np.arange(rays) + starts).ravel()
        distances = self.true_distances(T_lidar_board, angles)
        distances = distances + p.range_std * rng.standard_normal(len(distances))
        if p.resolution > 0.0:
            distances = np.rint(distances / p.resolution) * p.resolution
        return angles, np.where(rng.random(len(angles)) < p.lost, 0.0, distances)

    def true_distances(self, T_lidar_board: Floats, angles: Floats) -> Floats:
        """(N,) to the board, the person or the walls, whatever is nearest, m."""
        rays = np.column_stack((np.cos(angles), np.sin(angles), np.zeros(len(angles))))
        nearest = self._params.room / np.maximum(np.abs(rays[:, 0]), np.abs(rays[:, 1]))
        if self._params.person > 0.0:
            nearest = np.minimum(nearest, self._to_person(T_lidar_board, rays))
        return np.asarray(np.minimum(nearest, self._to_board(T_lidar_board, rays)))

    def _to_board(self, T: Floats, rays: Floats) -> Floats:
        normal = T[:3, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            distances = (normal @ T[:3, 3]) / (rays @ normal)
            on_board = (distances[:, None] * rays - T[:3, 3]) @ T[:3, :2]
        inside = np.all(np.abs(on_board) <= np.array(self._plate) / 2.0, axis=1) & (distances > 0.0)
        return np.where(inside, distances, math.inf)

    def _to_person(self, T: Floats, rays: Floats) -> Floats:
        """A round body behind the board."""
        middle, radius = T[:2, 3], self._params.person
        away = float(np.linalg.norm(middle))
        body = middle * (away + self._plate[0] + radius) / away
        along = rays[:, :2] @ body
        beside2 = body @ body - along**2
        hit = (beside2 < radius**2) & (along > 0.0)
        return np.where(hit, along - np.sqrt(np.maximum(radius**2 - beside2, 0.0)), math.inf)

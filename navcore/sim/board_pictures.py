"""Pictures of a calibration board as a real camera would take them: perspective, lens, blur, uneven light, noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numba import njit
from numpy.typing import NDArray

from navcore.calibration.board import TEXELS, Board
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

# Samples of a pixel, each way.
SAMPLES = 4
PAPER, INK, WALL = 0.92, 0.08, 0.45


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardPictureParams:
    """How unkind the picture is.

    Attributes:
        blur_px: 1-sigma of the optics' and sensor's spread, px; 0.3 to 10, the smallest in a sharp picture about 0.6.
        noise: 1-sigma of the grey values, of 255; >= 0.
        light: grey value of white in full light; 30 to 255.
        gradient: how much darker the picture is at its dark end, share; 0 to 0.9. It lies along a random direction.
    """

    blur_px: float = 0.7
    noise: float = 3.0
    light: float = 215.0
    gradient: float = 0.4


class BoardPictures:
    """One camera, one board."""

    def __init__(self, camera: Intrinsics, lens: Lens, board: Board, params: BoardPictureParams) -> None:
        """Raises InputError if the lens does not hold over the whole picture."""
        self._camera, self._board, self._params = camera, board, params
        v, u = np.mgrid[0 : camera.height_px, 0 : camera.width_px].reshape(2, -1).astype(np.float64)
        straight = lens.straighten(camera.rays(np.column_stack((u, v))))
        self._rays = straight.reshape(camera.height_px, camera.width_px, 2)
        self._texture = board.texture().astype(np.float64) / 255.0 * (PAPER - INK) + INK

    def render(self, T_camera_board: Floats, rng: np.random.Generator) -> Image:
        """The picture (H, W, 3), BGR, of the board at that pose (4, 4)."""
        return self.exposed(self.lit(T_camera_board, rng), rng)

    def lit(self, T_camera_board: Floats, rng: np.random.Generator) -> Floats:
        """What falls on the sensor (H, W), grey values: the slow part of a picture, the same while it is held."""
        c = self._camera
        albedo = np.full((c.height_px, c.width_px), WALL)
        # From rays to the board's plane: the inverse homography of columns x, y and the origin.
        H_board_ray = np.asarray(np.linalg.inv(T_camera_board[:3, [0, 1, 3]]), dtype=np.float64)
        _paint(albedo, self._rays, H_board_ray, self._texture, np.array(self._board.plate), self._board.square)
        return np.asarray(cv2.GaussianBlur(albedo * self._light(rng), (0, 0), self._params.blur_px), dtype=np.float64)

    def exposed(self, lit: Floats, rng: np.random.Generator) -> Image:
        """The picture (H, W, 3), BGR, of that light, with noise."""
        grey = np.clip(np.rint(lit + self._params.noise * rng.standard_normal(lit.shape)), 0, 255).astype(np.uint8)
        return np.repeat(grey[:, :, None], 3, axis=2)

    def _light(self, rng: np.random.Generator) -> Floats:
        """Grey value of white over the picture (H, W)."""
        c, direction = self._camera, rng.uniform(-math.pi, math.pi)
        v, u = np.mgrid[0 : c.height_px, 0 : c.width_px]
        along = (u / c.width_px - 0.5) * math.cos(direction) + (v / c.height_px - 0.5) * math.sin(direction)
        share = 1.0 - self._params.gradient * (0.5 + along / math.sqrt(2.0))
        return np.asarray(self._params.light * share, dtype=np.float64)


@njit(cache=True)
def _paint(
    albedo: Floats, rays: Floats, H: Floats, texture: Floats, plate: Floats, square: float
) -> None:  # fmt: skip
    """Mean albedo of each pixel that the plate covers, from SAMPLES x SAMPLES rays in it."""
    high, wide = albedo.shape
    for v in range(high):
        for u in range(wide):
            if not _near(rays[v, u], H, plate, square):
                continue
            right, below = rays[v, min(u + 1, wide - 1)], rays[min(v + 1, high - 1), u]
            left, above = rays[v, max(u - 1, 0)], rays[max(v - 1, 0), u]
            du = (right - left) / (min(u + 1, wide - 1) - max(u - 1, 0))
            dv = (below - above) / (min(v + 1, high - 1) - max(v - 1, 0))
            total = 0.0
            for j in range(SAMPLES):
                for i in range(SAMPLES):
                    a, b = (i + 0.5) / SAMPLES - 0.5, (j + 0.5) / SAMPLES - 0.5
                    x = rays[v, u, 0] + a * du[0] + b * dv[0]
                    y = rays[v, u, 1] + a * du[1] + b * dv[1]
                    total += _albedo(x, y, H, texture, plate, square)
            albedo[v, u] = total / (SAMPLES * SAMPLES)


@njit(cache=True)
def _near(ray: Floats, H: Floats, plate: Floats, square: float) -> bool:
    """Whether the ray's pixel may touch the plate."""
    x, y, w = _on_plane(ray[0], ray[1], H)
    return bool(w > 0.0 and abs(x) < plate[0] / 2 + square and abs(y) < plate[1] / 2 + square)


@njit(cache=True)
def _on_plane(x: float, y: float, H: Floats) -> tuple[float, float, float]:
    w = H[2, 0] * x + H[2, 1] * y + H[2, 2]
    if w <= 1e-12:
        return 0.0, 0.0, -1.0
    return (H[0, 0] * x + H[0, 1] * y + H[0, 2]) / w, (H[1, 0] * x + H[1, 1] * y + H[1, 2]) / w, w


@njit(cache=True)
def _albedo(x: float, y: float, H: Floats, texture: Floats, plate: Floats, square: float) -> float:
    bx, by, w = _on_plane(x, y, H)
    if w <= 0.0 or abs(bx) > plate[0] / 2 or abs(by) > plate[1] / 2:
        return WALL
    column = math.floor(bx / square * TEXELS + texture.shape[1] / 2)
    row = math.floor(by / square * TEXELS + texture.shape[0] / 2)
    if 0 <= row < texture.shape[0] and 0 <= column < texture.shape[1]:
        return float(texture[row, column])
    return PAPER

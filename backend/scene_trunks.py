"""Mapped trunks in the 3D view, each as thick as it was measured. Frame: `map`, z up."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from navcore.maps.site_map import Row
from navcore.maps.trunk_map import TrunkMap, trunks_of_row

Floats = NDArray[np.float32]
HEIGHT = 1.2  # m, for the eye: a 2D LiDAR sees none
SIDES = 10
COLOUR = (165, 85, 31)


def show_trunks(scene: SceneApi, trunk_map: TrunkMap) -> None:
    """Draw them in the place of those shown before."""
    scene.remove_by_name("/mapped_trunks")
    if not trunk_map.trunks:
        return
    vertices, faces = cylinder()
    turns = np.tile(np.array((1.0, 0.0, 0.0, 0.0), np.float32), (len(trunk_map.trunks), 1))
    scene.add_batched_meshes_simple(
        "/mapped_trunks", vertices, faces, turns, places(trunk_map), batched_scales=sizes(trunk_map),
        batched_colors=COLOUR, cast_shadow=False, receive_shadow=False,
    )  # fmt: skip


def places(trunk_map: TrunkMap) -> Floats:
    """(N, 3) feet."""
    return np.array([(t.x, t.y, 0.0) for t in trunk_map.trunks], np.float32).reshape(-1, 3)


def sizes(trunk_map: TrunkMap) -> Floats:
    """(N, 3) what a cylinder of radius and height 1 is stretched by."""
    return np.array([(t.diameter / 2.0, t.diameter / 2.0, HEIGHT) for t in trunk_map.trunks], np.float32).reshape(
        -1, 3
    )


def unmapped(rows: tuple[Row, ...], trunk_map: TrunkMap) -> tuple[Row, ...]:
    """Rows of which no trunk is known: only there the drawn spacing says where plants stand."""
    return tuple(row for row in rows if not trunks_of_row(trunk_map, row))


def cylinder() -> tuple[Floats, NDArray[np.uint32]]:
    """Vertices (2 SIDES + 1, 3) and faces (3 SIDES, 3) of a mantle and a lid, radius and height 1, foot at 0."""
    angles = 2.0 * math.pi / SIDES * np.arange(SIDES)
    ring = np.column_stack((np.cos(angles), np.sin(angles)))
    foot, head = (np.column_stack((ring, np.full(SIDES, z))) for z in (0.0, 1.0))
    k = np.arange(SIDES)
    after = (k + 1) % SIDES
    mantle = np.concatenate(
        (np.column_stack((k, after, k + SIDES)), np.column_stack((after, after + SIDES, k + SIDES)))
    )
    lid = np.column_stack((k + SIDES, after + SIDES, np.full(SIDES, 2 * SIDES)))
    vertices = np.concatenate((foot, head, ((0.0, 0.0, 1.0),))).astype(np.float32)
    return vertices, np.concatenate((mantle, lid)).astype(np.uint32)

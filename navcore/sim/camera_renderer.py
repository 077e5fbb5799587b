"""The simulated camera: what it sees of an orchard from the robot's true pose."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera, rotation_from_rpy
from navcore.messages import SimTruth
from navcore.sim.camera_labels import LabelParams, RenderedObject, label_objects, rows_nearer
from navcore.sim.camera_light import LightParams
from navcore.sim.corridor_ground import Corridor, ground_mask
from navcore.sim.orchard import Orchard
from navcore.sim.render.buffers import View, new_layers, new_queue
from navcore.sim.render.canopy import leaf_cards
from navcore.sim.render.ground import Ground, GroundTint, build_ground
from navcore.sim.render.ground_laying import lay_ground
from navcore.sim.render.lighting import Lighting, build_tables, daylight, ground_noise, vector, with_lamp
from navcore.sim.render.planting import planted
from navcore.sim.render.polygon import rasterise
from navcore.sim.render.primitives import Chunks, into_chunks
from navcore.sim.render.shade import shade
from navcore.sim.render.shadow import Shadow, ShadowMap
from navcore.sim.render.tessellate import tessellate
from navcore.sim.textures.atlas import Atlas, build_atlas

Picture = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RenderedFrame:
    """A picture (H, W, 3) uint8 blue, green, red, and the truth about it that was asked for.

    Attributes:
        objects: true boxes; none when labels are off.
        ground: (H, W) where it shows the ground of `RenderParams.corridor`; None without one.
    """

    image: Picture
    objects: tuple[RenderedObject, ...]
    ground: NDArray[np.bool_] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class RenderParams:
    """Attributes:
    range: nothing farther is drawn, m, 20 to 300.
    labels: whether to make true boxes. corridor: whose ground to tell.
    """

    range: float = 90.0
    labels: LabelParams | None = None
    corridor: Corridor | None = None


class Scene:
    """An orchard in one light, ready to be drawn by any number of cameras of one thread."""

    def __init__(self, orchard: Orchard, light: LightParams, tint: GroundTint | None = None) -> None:
        wood = planted(orchard, leaf_cards(orchard))
        self.orchard, self.light = orchard, light
        self.tubes = wood.tubes[: len(orchard.trunks) + len(orchard.posts)]
        self.chunks: Chunks = into_chunks(wood)
        self.atlas: Atlas = build_atlas(orchard)
        self.tables, self.lighting = build_tables(light), daylight(light)
        noise = ground_noise(orchard.params.seed)
        self.ground: Ground = build_ground(orchard, noise, tint)
        self._shadows = (
            ShadowMap(self.chunks, self.atlas, np.array(self.lighting.source)) if self.lighting.shadows else None
        )

    def shadow(self, x: float, y: float) -> Shadow:
        """Shadows around a place; an empty map where there is no sun."""
        if self._shadows is not None:
            return self._shadows.around(x, y)
        return Shadow(height=np.zeros(1, np.int16), shear=(0.0, 0.0), centre=(0.0, 0.0))


class CameraRenderer:
    """Renders one camera. The picture depends on the orchard, the light, the truth and the frame's number alone."""

    def __init__(
        self, orchard: Orchard, camera: PinholeCamera, light: LightParams, params: RenderParams | None = None, *,
        scene: Scene | None = None,
    ) -> None:  # fmt: skip
        """`scene` may be shared by cameras of one orchard and sky; each has its own exposure, noise and blur."""
        self._scene = scene or Scene(orchard, light)
        self._camera, self._light, self._params = camera, light, params or RenderParams()
        self._lighting = daylight(light)
        self._layers = new_layers(camera.width_px, camera.height_px)
        self._queue = new_queue(40_000)

    def render(self, truth: SimTruth, frame_index: int) -> RenderedFrame:
        """The picture taken at the robot's true pose, roll and pitch included; the ground is the plane z = 0."""
        scene, layers = self._scene, self._layers
        view = self._view(truth)
        lamp = (view.centre[0], view.centre[1], view.centre[2] - 0.15)
        lighting = with_lamp(self._lighting, self._light, lamp, view.forward)
        self._draw(view, lighting)
        rng = np.random.default_rng((self._light.seed, frame_index))
        picture = np.empty((view.height, view.width, 3), dtype=np.uint8)
        orchard = scene.orchard
        shade(
            view, layers, scene.shadow(truth.x, truth.y), lighting, scene.tables, int(rng.integers(509)),
            int(rng.integers(1021)), (orchard.canopy_bottom_m, orchard.canopy_top_m), picture,
        )  # fmt: skip
        corridor = self._params.corridor
        ground = ground_mask(view, layers, corridor) if corridor else None
        return RenderedFrame(image=self._blurred(picture), objects=self._objects(view), ground=ground)

    def _draw(self, view: View, lighting: Lighting) -> None:
        """All that stands, then the ground, into the layers."""
        scene, layers = self._scene, self._layers
        layers.inverse_depth[:], layers.tag[:] = 0.0, 0
        while (count := tessellate(view, lighting.source, scene.chunks, *self._queue)) < 0:
            self._queue = new_queue(2 * len(self._queue.tint))
        rasterise(
            view, *self._queue, count, *scene.atlas, layers.inverse_depth, layers.albedo, layers.shine, layers.tag
        )
        lay_ground(view, lighting.source, layers, scene.ground, scene.atlas)

    def _view(self, truth: SimTruth) -> View:
        camera = self._camera
        R_map_base = rotation_from_rpy(truth.roll, truth.pitch, truth.yaw)
        centre = R_map_base @ (camera.x, camera.y, camera.z) + (truth.x, truth.y, 0.0)
        right, down, forward = (R_map_base @ camera.R_base_camera()).T
        return View(
            right=vector(right), down=vector(down), forward=vector(forward), centre=vector(centre),
            fx=float(camera.fx), fy=float(camera.fy),
            cx=float(camera.cx), cy=float(camera.cy), width=camera.width_px, height=camera.height_px,
            range=float(self._params.range),
        )  # fmt: skip

    def _blurred(self, picture: Picture) -> Picture:
        if self._light.blur_px <= 0.0:
            return picture
        side = 2 * max(1, round(2 * self._light.blur_px)) + 1
        return np.asarray(cv2.GaussianBlur(picture, (side, side), self._light.blur_px), dtype=np.uint8)

    def _objects(self, view: View) -> tuple[RenderedObject, ...]:
        if self._params.labels is None:
            return ()
        scene, orchard = self._scene, self._scene.orchard
        line = np.concatenate((orchard.trunk_line, orchard.post_line))
        return label_objects(
            view, self._layers.tag >> 4, scene.tubes, len(orchard.trunks),
            rows_nearer(view, line, orchard.plant_lines), self._params.labels,
        )  # fmt: skip

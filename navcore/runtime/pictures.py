"""Where the row worker's pictures come from: real cameras or drawn ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from navcore.drivers.camera_capture import Picture
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName
from navcore.perception.detector import Detector


class Cameras(Protocol):
    """The robot's cameras."""

    @property
    def mounts(self) -> Mapping[CameraName, PinholeCamera]:
        """Intrinsics and mount of each."""

    def detectors(self) -> Mapping[CameraName, Detector]:
        """What finds trunks and posts in each camera's pictures. Raises ModelError if the weights are missing."""

    def take(self, camera: CameraName) -> Picture | None:
        """A new picture, or None if there is none."""

    def raw(self, camera: CameraName) -> Picture | None:
        """A new picture as the lens bends it, or None if there is none."""

    def problem(self, camera: CameraName) -> str:
        """Why a camera gives no pictures, or what is wrong with them; empty when all is well."""

    def close(self) -> None:
        """Let go of them."""
